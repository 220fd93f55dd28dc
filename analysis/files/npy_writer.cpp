#include "analysis/files/npy_writer.hpp"

#include <bit>
#include <filesystem>
#include <ostream>

#include "analysis/files/atomic_file.hpp"
#include "analysis/files/json_writer.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

static_assert(std::endian::native == std::endian::little, "the entries are written as they are in memory, as '<f8'");

}  // namespace

/// The header of https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0: magic, version,
/// the dictionary's length in two bytes, the dictionary, and spaces up to a multiple of 64 bytes.
std::string npy_header(const std::vector<TableAxis>& axes) {
  std::string shape;
  for (const TableAxis& axis : axes) shape += fmt::format("{}{}", shape.empty() ? "" : ", ", axis.size());
  if (axes.size() == 1) shape += ',';  // a Python tuple of one
  std::string dictionary = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", shape);

  constexpr std::size_t prefix = 10;
  while ((prefix + dictionary.size() + 1) % 64 != 0) dictionary += ' ';
  dictionary += '\n';
  std::string header = "\x93NUMPY\x01";
  header += '\0';
  header += static_cast<char>(dictionary.size() % 256);
  header += static_cast<char>(dictionary.size() / 256);
  return header + dictionary;
}

std::string sidecar_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".json").string();
}

void write_npy(const TableDocument& table, const std::string& path) {
  AtomicFile sidecar(sidecar_path(path));
  write_json_description(table, sidecar.stream());

  AtomicFile array(path);
  array.stream() << npy_header(table.axes);
  array.stream().write(reinterpret_cast<const char*>(table.values),
                       static_cast<std::streamsize>(table.size() * sizeof(double)));
  array.finish();
  sidecar.commit();
  array.commit();
}

}  // namespace albedo::analysis
