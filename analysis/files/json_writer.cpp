#include "analysis/files/json_writer.hpp"

#include <cmath>

#include "analysis/files/atomic_file.hpp"

namespace albedo::analysis {
namespace {

/// A text or a whole item on one line. Text that is not UTF-8 (a command line may hold any byte) gets U+FFFD there.
std::string json_text(const nlohmann::ordered_json& item) {
  return item.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  std::string text;
  append_number(text, value);
  return text;
}

/// Writes "[", items 0 to size - 1 as `write_item` does, and "]".
template <class WriteItem>
void write_array(std::ostream& out, std::size_t size, const char* separator, WriteItem write_item) {
  out << '[';
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0) out << separator;
    write_item(i);
  }
  out << ']';
}

void write_axis(const TableAxis& axis, std::ostream& out) {
  out << R"({"name": )" << json_text(axis.name) << R"(, "unit": )" << json_text(axis.unit);
  out << (axis.is_categorical() ? R"(, "labels": )" : R"(, "values": )");
  write_array(out, axis.size(), ", ", [&](std::size_t i) {
    out << (axis.is_categorical() ? json_text(axis.labels[i]) : json_number(axis.values[i]));
  });
  out << '}';
}

/// The members of the description, without the braces around them.
void write_description(const TableDocument& table, std::ostream& out) {
  const std::vector<TableAxis>& axes = table.axes;
  out << R"("provenance": )" << json_text(table.provenance) << ",\n\"axes\": ";
  write_array(out, axes.size(), ",\n  ", [&](std::size_t i) { write_axis(axes[i], out); });
  out << ",\n\"shape\": ";
  write_array(out, axes.size(), ", ", [&](std::size_t i) { out << axes[i].size(); });
}

/// Writes the entries from `next` on that belong to one place on the axes before `axis`; returns the first one behind.
const double* write_nested(const TableDocument& table, std::size_t axis, const double* next, std::ostream& out) {
  if (axis == table.axes.size()) {
    out << json_number(*next);
    return next + 1;
  }
  const bool is_last = axis + 1 == table.axes.size();
  write_array(out, table.axes[axis].size(), is_last ? ", " : ",\n",
              [&](std::size_t) { next = write_nested(table, axis + 1, next, out); });
  return next;
}

}  // namespace

void write_json_description(const TableDocument& table, std::ostream& out) {
  out << '{';
  write_description(table, out);
  out << "}\n";
}

void write_json(const TableDocument& table, const std::string& path) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << '{';
  write_description(table, out);
  out << ",\n\"" << table.quantity << "\": ";
  write_nested(table, 0, table.values, out);
  if (table.errors != nullptr) {
    out << ",\n\"error\": ";
    write_nested(table, 0, table.errors, out);
  }
  out << "}\n";
  file.commit();
}

}  // namespace albedo::analysis
