#include "fuzz/unfinished_table.hpp"

/// The input is a list of edits, 4 bytes each, of the two files of an unfinished table: what, place (2 bytes), value.
/// Bit 0 of what: the journal, or else the .part; bits 1 and 2: set a byte, set it too, cut off, append; bit 3: set the
/// journal's checksums right in the end.
ALBEDO_FUZZ_TARGET(resume) {
  using namespace albedo;
  static const fuzz::UnfinishedTable table;
  std::string part = table.part(), journal = table.journal();
  bool repair = false;
  for (; input.size() >= 4; input.remove_prefix(4)) {
    const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(input[i])}; };
    std::string& file = (byte(0) & 1) != 0 ? journal : part;
    const std::size_t place = (byte(1) | byte(2) << 8) % (file.size() + 1);
    const std::size_t action = byte(0) >> 1 & 3;
    repair = repair || (byte(0) & 8) != 0;
    if (action < 2) {
      if (place < file.size()) file[place] = input[3];
    } else if (action == 2) {
      file.resize(place);
    } else {
      file.append(byte(1), input[3]);
    }
  }
  table.resume(part, repair ? fuzz::repaired(std::move(journal)) : journal);
}
