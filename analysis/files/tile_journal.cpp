#include "analysis/files/tile_journal.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

#include "analysis/files/atomic_file.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");

using Json = nlohmann::ordered_json;

constexpr std::string_view magic = "albedo journal 1";
constexpr std::size_t prefix_size = magic.size() + 2 * sizeof(std::uint64_t);
constexpr std::size_t record_size = 64;
// Of a head: twice the longest command line, and JSON takes 40 times its text in memory; what reads it goes down by
// recursion.
constexpr std::uint64_t longest_head = 1U << 22U;
constexpr int deepest_nesting = 32;
constexpr std::size_t most_tiles = std::size_t{1} << 40U;

using Words = std::array<std::uint64_t, record_size / sizeof(std::uint64_t)>;

std::uint64_t checksum_of(const Words& words) { return checksum(std::as_bytes(std::span(words).first<7>())); }

std::uint64_t checksum_of(const std::string& text) { return checksum(std::as_bytes(std::span(text))); }

/// Where the records begin, behind a head of this length.
std::uint64_t records_begin(std::uint64_t head_size) {
  return (prefix_size + head_size + record_size - 1) / record_size * record_size;
}

std::string text_of(const JournalHead& head) {
  return Json{{"tiles", head.tiles}, {"command", head.command}, {"computation", head.computation}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);
}

JournalHead read_head(const PlacedFile& file) {
  const auto refuse = [&](const std::string& reason) { return cannot_write(file.path(), reason); };
  const std::uint64_t size = file.size();
  std::array<char, prefix_size> prefix;  // NOLINT(cppcoreguidelines-pro-type-member-init): read before it is used
  if (size < prefix.size()) throw refuse("it is no journal of a table");
  file.read(0, std::as_writable_bytes(std::span(prefix)));
  if (std::string_view(prefix.data(), magic.size()) != magic) throw refuse("it is no journal of a table");
  std::array<std::uint64_t, 2> numbers;  // NOLINT(cppcoreguidelines-pro-type-member-init): copied from the prefix
  std::memcpy(numbers.data(), prefix.data() + magic.size(), sizeof numbers);
  const auto [length, sum] = numbers;
  if (length > longest_head || records_begin(length) > size) throw refuse("the journal is truncated or damaged");
  std::string text(length, '\0');
  file.read(prefix_size, std::as_writable_bytes(std::span(text)));
  if (checksum_of(text) != sum) throw refuse("the journal is damaged: the checksum of its head is wrong");
  JournalHead head;
  const auto check_depth = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest_nesting) throw refuse("the journal's head is nested too deeply");
    return true;
  };
  try {
    const Json json = Json::parse(text, check_depth);
    head = {json.at("command").get<std::string>(), json.at("computation"), json.at("tiles").get<std::size_t>()};
  } catch (const Json::exception&) {
    throw refuse("it is no journal of a table");
  }
  if (head.tiles > most_tiles || size != records_begin(length) + head.tiles * record_size) {
    throw refuse(fmt::format("the journal is truncated or damaged: it has {} bytes", size));
  }
  return head;
}

}  // namespace

void TileJournal::create(const std::string& path, const JournalHead& head) {
  const std::string text = text_of(head);
  const std::array<std::uint64_t, 2> numbers{text.size(), checksum_of(text)};
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << magic;
  out.write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  out << text << std::string(records_begin(text.size()) - prefix_size - text.size(), ' ');
  const std::string none(record_size, '\0');
  for (std::size_t tile = 0; tile < head.tiles; ++tile) out << none;
  file.commit();
}

TileJournal::TileJournal(const std::string& path, Access access) : file_(path, PlacedFile::Mode::reuse) {
  if (access == Access::owned) file_.lock();
  head_ = read_head(file_);
  begin_ = file_.size() - head_.tiles * record_size;
}

std::optional<TileRecord> TileJournal::find(std::size_t tile) const {
  Words words{};
  file_.read(begin_ + tile * record_size, std::as_writable_bytes(std::span(words)));
  if (words[0] != tile + 1 || words[7] != checksum_of(words)) return std::nullopt;
  return TileRecord{.checksum = words[1],
                    .tally = {.worst_error = std::bit_cast<double>(words[2]),
                              .worst_entry = words[3],
                              .unconverged = words[4],
                              .divergent = words[5],
                              .evaluations = std::bit_cast<std::int64_t>(words[6])}};
}

void TileJournal::record(std::size_t tile, const TileRecord& record) {
  const TableTally& tally = record.tally;
  Words words{tile + 1,          record.checksum, std::bit_cast<std::uint64_t>(tally.worst_error), tally.worst_entry,
              tally.unconverged, tally.divergent, std::bit_cast<std::uint64_t>(tally.evaluations), 0};
  words[7] = checksum_of(words);
  file_.write(begin_ + tile * record_size, std::as_bytes(std::span(words)));
  using Clock = std::chrono::steady_clock;
  const auto now = Clock::now().time_since_epoch().count();
  auto before = synchronised_.load();
  if (now - before < Clock::duration(std::chrono::seconds(1)).count()) return;
  if (synchronised_.compare_exchange_strong(before, now)) file_.synchronise();
}

std::size_t TileJournal::count() const {
  std::size_t result = 0;
  for (std::size_t tile = 0; tile < head_.tiles; ++tile) {
    if (find(tile)) ++result;
  }
  return result;
}

std::string difference(const Json& was, const Json& is) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  for (const auto& [key, value] : was.items()) {
    if (!is.contains(key)) {
      add(key + " was " + value.dump() + " and is not given");
    } else if (value.is_object() && is[key].is_object()) {
      if (const std::string inner = difference(value, is[key]); !inner.empty()) add(key + ": " + inner);
    } else if (is[key] != value) {
      add(key + " was " + value.dump() + " and is " + is[key].dump());
    }
  }
  for (const auto& [key, value] : is.items()) {
    if (!was.contains(key)) add(key + " was not given and is " + value.dump());
  }
  // A damaged journal may hold what a terminal obeys.
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return text;
}

}  // namespace albedo::analysis
