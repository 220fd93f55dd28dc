// How fast tables fill, and how far that would scale.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "albedo/albedo.hpp"
#include "albedo/table_source.hpp"
#include "analysis/files/placed_file.hpp"
#include "analysis/files/ranks.hpp"
#include "analysis/text/text.hpp"
#include "scaling/simulation.hpp"

namespace albedo::bench {
namespace {

using Json = nlohmann::ordered_json;

/// The processor time of this thread: what others do meanwhile isn't in it.
double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

TableAxis axis(const std::string& name, double from, double to, std::size_t count) {
  TableAxis result{name, std::vector<double>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    result.values[i] = std::lerp(from, to, static_cast<double>(i) / static_cast<double>(count - 1));
  }
  return result;
}

struct TimedTable {
  std::string model;
  std::vector<TableAxis> axes;
};

/// Tables of a usual kind: a roughness or an exponent, and directions.
std::vector<TimedTable> timed_tables() {
  const TableAxis cosines = axis("cos_theta", 0.02, 1, 64), azimuths = axis("phi", 0, 90, 16);
  std::vector<TimedTable> tables;
  tables.push_back({"lambert", {cosines}});
  tables.push_back({"phong", {axis("n", 1, 1000, 64), cosines}});
  tables.push_back({"ward", {axis("alpha", 0.05, 1, 64), cosines}});
  tables.push_back({"ward", {axis("alpha_x", 0.05, 1, 16), axis("alpha_y", 0.05, 1, 16), cosines, azimuths}});
  tables.push_back({"cook_torrance", {axis("m", 0.05, 0.6, 64), cosines}});
  tables.push_back({"ashikhmin_shirley", {axis("n", 1, 1000, 64), cosines}});
  tables.push_back({"ggx", {axis("alpha", 0.05, 1, 64), cosines}});
  tables.push_back({"ggx", {axis("alpha_x", 0.05, 1, 16), axis("alpha_y", 0.05, 1, 16), cosines, azimuths}});
  return tables;
}

TableOptions with_tolerance(double tolerance) {
  return {.albedo = {.tolerance = tolerance}, .threads = 1, .verified_cells = 0};
}

/// Entries a second of one core, at random entries.
double entries_a_second(const TimedTable& table, double tolerance, std::size_t count) {
  const TableSource source(table.model, {}, table.axes, with_tolerance(tolerance));
  TableSource::Worker worker(source);
  std::mt19937_64 random(1);
  std::vector<double> entry(1);
  worker.fill(0, entry);  // nodes of rules are made once
  const double begin = processor_seconds();
  for (std::size_t i = 0; i < count; ++i) worker.fill(random() % source.size(), entry);
  return static_cast<double>(count) / (processor_seconds() - begin);
}

/// The seconds of tiles of the table that a renderer's team wants: ggx over α_x × α_y × f0 × cosθ × φ, 64 values each.
/// Of a tile's 16384 entries some are computed, chosen at random, and stand for all.
std::vector<double> tile_seconds(std::size_t tiles, std::size_t entries) {
  constexpr std::size_t size = 16384;
  const TableSource source("ggx", {},
                           {axis("alpha_x", 0.05, 1, 64), axis("alpha_y", 0.05, 1, 64), axis("f0", 0.02, 1, 64),
                            axis("cos_theta", 0.02, 1, 64), axis("phi", 0, 90, 64)},
                           with_tolerance(1e-6));
  TableSource::Worker worker(source);
  std::mt19937_64 random(2);
  std::vector<double> entry(1), seconds;
  for (std::size_t i = 0; i < tiles; ++i) {
    const std::size_t first = random() % (source.size() / size) * size;
    const double begin = processor_seconds();
    for (std::size_t k = 0; k < entries; ++k) worker.fill(first + random() % size, entry);
    seconds.push_back((processor_seconds() - begin) * static_cast<double>(size) / static_cast<double>(entries));
  }
  return seconds;
}

/// The seconds of writing a tile of 16384 entries to its place and to the disk.
std::vector<double> write_seconds(std::size_t count) {
  const std::string path = "albedo-scaling-" + std::to_string(::getpid());
  std::vector<double> seconds;
  {
    const std::vector<std::byte> tile(16384 * sizeof(double), std::byte{1});
    analysis::PlacedFile file(path, analysis::PlacedFile::Mode::create);
    file.reserve(count * tile.size());
    for (std::size_t i = 0; i < count; ++i) {
      const double begin = wall_seconds();
      file.write(i * tile.size(), tile);
      file.synchronise();
      seconds.push_back(wall_seconds() - begin);
    }
  }
  std::filesystem::remove(path);
  return seconds;
}

/// Claims a second of all ranks together, each of one thread that does nothing else.
double claims_a_second(analysis::Ranks& ranks, std::size_t count) {
  const std::unique_ptr<analysis::TileClaims> claims = ranks.claims(count);
  const double begin = wall_seconds();
  while (claims->next()) {
  }
  static_cast<void>(ranks.gather(""));
  return static_cast<double>(count) / (wall_seconds() - begin);
}

/// A table of all tiles, drawn from the measured ones.
std::vector<double> drawn(const std::vector<double>& measured, std::size_t count, double share) {
  std::mt19937_64 random(3);
  std::vector<double> tiles(count);
  for (double& tile : tiles) tile = share * measured[random() % measured.size()];
  return tiles;
}

Json simulated(const std::vector<double>& tiles, double write) {
  Json rows = Json::array();
  struct Tiling {
    std::size_t count;
    double share;  // of a tile of 16384
  };
  for (const Tiling& tiling : {Tiling{65'536, 1}, Tiling{1'048'576, 1.0 / 16}}) {
    const std::vector<double> all = drawn(tiles, tiling.count, tiling.share);
    for (const std::size_t cores : {1'000U, 3'000U, 10'000U, 30'000U, 100'000U}) {
      // A round trip over InfiniBand, an atomic operation of its adapter: of the order that their makers publish.
      const SimulatedFill fill = simulate(all, cores, {.round_trip = 5e-6, .service = 1e-6, .write = write});
      rows.push_back({{"tiles", tiling.count},
                      {"cores", cores},
                      {"seconds", fill.seconds},
                      {"efficiency", fill.efficiency},
                      {"idle_end", fill.idle_end},
                      {"waiting", fill.waiting},
                      {"writing", fill.writing},
                      {"gigabytes_a_second", std::pow(64.0, 5) * 8e-9 / fill.seconds}});
    }
  }
  return rows;
}

std::string axes_text(const TimedTable& table) {
  std::string text;
  for (const TableAxis& a : table.axes) text += (text.empty() ? "" : " × ") + a.name;
  return text;
}

std::string whole(double value) { return std::to_string(std::llround(value)); }

std::string seconds_text(double value) { return number_text(value, 3) + " s"; }

std::string percent(double share) { return number_text(std::round(1000 * share) / 10, 4) + " %"; }

int run(int argc, char** argv) {
  CLI::App app("How fast tables fill, and how far that would scale; prints Markdown.");
  bool is_quick = false, claims_only = false;
  app.add_flag("--quick", is_quick, "few samples");
  app.add_flag("--claims", claims_only, "only how many tiles a second can be claimed; mpirun may start several of it");
  CLI11_PARSE(app, argc, argv);

  const std::size_t many = is_quick ? 1 : 100;
  if (claims_only) {
    const auto ranks = analysis::join_ranks();
    const double rate = claims_a_second(*ranks, 10'000 * many);
    if (ranks->is_first()) std::cout << ranks->size() << " ranks: " << whole(rate) << " claims a second\n";
    return 0;
  }
  std::cout << "| model | axes | 1e-4 | 1e-6 | 1e-8 |\n|---|---|---|---|---|\n";
  for (const TimedTable& table : timed_tables()) {
    std::cout << "| " << table.model << " | " << axes_text(table);
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      std::cout << " | " << whole(entries_a_second(table, tolerance, 50 * many)) << std::flush;
    }
    std::cout << " |\n";
  }

  const std::vector<double> tiles = tile_seconds(is_quick ? 4 : 200, is_quick ? 8 : 256);
  const double mean = std::reduce(tiles.begin(), tiles.end()) / static_cast<double>(tiles.size());
  std::cout << "\nA tile of ggx over 64^5 at 1e-6: mean " << seconds_text(mean) << ", median "
            << seconds_text(quantile(tiles, 0.5)) << ", 95 % " << seconds_text(quantile(tiles, 0.95)) << ", longest "
            << seconds_text(quantile(tiles, 1)) << '\n';
  const std::vector<double> writes = write_seconds(2 * many);
  const double write = quantile(writes, 0.5);
  std::cout << "Writing it: median " << seconds_text(write) << ", 95 % " << seconds_text(quantile(writes, 0.95)) << ", "
            << whole(16384 * 8e-6 * static_cast<double>(writes.size()) / std::reduce(writes.begin(), writes.end()))
            << " MB/s"
            << "\n\n";
  std::cout << "| tiles | cores | seconds | efficiency | idle at the end | claiming | writing | GB/s |\n"
               "|---|---|---|---|---|---|---|---|\n";
  for (const Json& row : simulated(tiles, write)) {
    std::cout << "| " << row["tiles"] << " | " << row["cores"] << " | " << number_text(row["seconds"], 3);
    for (const char* const share : {"efficiency", "idle_end", "waiting", "writing"}) {
      std::cout << " | " << percent(row[share]);
    }
    std::cout << " | " << number_text(row["gigabytes_a_second"], 3) << " |\n";
  }
  return 0;
}

}  // namespace
}  // namespace albedo::bench

int main(int argc, char** argv) {
  try {
    return albedo::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "albedo-scaling: " << error.what() << '\n';
    return 1;
  }
}
