#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "albedo/core/errors.hpp"
#include "albedo/version.hpp"
#include "peers/report.hpp"

namespace albedo::peers {
namespace {

enum ExitCode { done = 0, internal_error = 1, usage = 2, missed_target = 3, write_failed = 4 };

constexpr const char* description =
    "The battery's integrals by gauss and by the rules of cubature, GSL and Boost, in one run and one thread: the "
    "time\n"
    "each rule needs until its true error, against a reference in 113 bits, is really below the target.";

constexpr const char* footer =
    "Rules are timed in turns with gauss. Lobe coordinates and work spaces are made before the peers' time begins; of\n"
    "gauss the whole call counts, but for quadrature nodes, which are made when an order is first used.\n\n"
    "Example: albedo-peers --quick --json peers.json\n\n"
    "Exit codes: 0 done, 2 usage, 3 done but gauss missed a target, 4 could not write.";

std::vector<Peer> all_peers() {
  std::vector<Peer> all;
  for (const auto& list : {cubature_peers, gsl_peers, boost_peers, block_kronrod_peers}) {
    std::vector<Peer> some = list();
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

/// Opened before the work, so that a run isn't lost to a misspelt folder.
std::ofstream opened(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw WriteError("cannot write '" + path + "'");
  return file;
}

int compare(bool quick, const std::string& json, const MeasureOptions& options) {
  std::ofstream file;
  if (!json.empty()) file = opened(json);
  Machine machine = Machine::look();
  const Battery battery = quick ? quick_battery() : whole_battery();
  std::vector<Peer> peers = all_peers();
  if (quick) std::erase_if(peers, [](const Peer& peer) { return peer.threaded; });  // a tenth of a second a call
  const bool progress = isatty(STDERR_FILENO) != 0;
  std::vector<CaseResult> results;
  for (const Material& material : battery.materials) {
    for (const double theta : battery.thetas) {
      if (progress) {
        std::cerr << '\r' << results.size() + 1 << " of " << battery.materials.size() * battery.thetas.size()
                  << std::flush;
      }
      results.push_back(measure(material, theta, battery.targets, peers, options));
    }
  }
  if (progress) std::cerr << '\r' << std::string(20, ' ') << '\r';
  machine.load_after = Machine::look().load_before;
  print_report(std::cout, results, peers, machine);
  if (!std::cout.flush()) throw WriteError("cannot write standard output");
  if (!json.empty() && !(file << json_report(results, options, machine).dump(1) << '\n' << std::flush))
    throw WriteError("cannot write '" + json + "'");
  const bool right = std::ranges::all_of(
      results, [](const CaseResult& result) { return std::ranges::all_of(result.targets, is_right); });
  return right ? done : missed_target;
}

int parse_repeats(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > 1001)
    throw ParameterError("--repeats is '" + text + "' and must be a whole number within [1, 1001]");
  return value;
}

int run(int argc, char** argv) {
  CLI::App program(description, "albedo-peers");
  program.footer(footer);
  program.set_version_flag("--version", "albedo-peers " + std::string(version));
  MeasureOptions options;
  bool quick = false;
  std::string json;
  program.add_flag("--quick", quick, "one material a model, three angles, smaller budgets, without naive_monte_carlo");
  program.add_option("--json", json, "write every result to this file")->type_name("FILE");
  program
      .add_option_function<std::string>(
          "--repeats", [&](const std::string& text) { options.repeats = parse_repeats(text); },
          "turns in which a rule and gauss are timed; fewer for what takes long")
      ->type_name("N")
      ->default_str(std::to_string(options.repeats));
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return program.exit(asked);
  }
  if (quick) {
    options.repeats = std::min(options.repeats, 5);
    options.pair_seconds = 0.005;
    options.budget = 50'000;
    options.monte_carlo_calls = 20'000;
  }
  return compare(quick, json, options);
}

int complain(const std::string& message, int code) {
  std::cerr << "albedo-peers: " << message << '\n';
  return code;
}

}  // namespace
}  // namespace albedo::peers

/// The one translator of exceptions to exit codes.
int main(int argc, char** argv) {
  using namespace albedo::peers;
  try {
    return run(argc, argv);
  } catch (const albedo::WriteError& error) {
    return complain(error.what(), write_failed);
  } catch (const albedo::ParameterError& error) {
    return complain(error.what(), usage);
  } catch (const CLI::Error& error) {
    return complain(error.what(), usage);
  } catch (const std::exception& error) {
    return complain("internal error: " + std::string(error.what()), internal_error);
  }
}
