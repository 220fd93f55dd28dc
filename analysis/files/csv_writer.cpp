#include "analysis/files/csv_writer.hpp"

#include <ostream>
#include <vector>

#include "analysis/files/atomic_file.hpp"

namespace albedo::analysis {
namespace {

void write_header(const TableDocument& table, std::ostream& out) {
  for (const auto& [key, item] : table.provenance.items()) out << "# " << key << ": " << comment_text(item) << '\n';
  for (const TableAxis& axis : table.axes) {
    if (!axis.unit.empty()) out << "# unit of " << comment_text(axis.name) << ": " << comment_text(axis.unit) << '\n';
  }
  for (const TableAxis& axis : table.axes) out << csv_field(axis.name) << ',';
  out << table.quantity << (table.errors != nullptr ? ",error\n" : "\n");
}

/// The place of the current entry; only the fields that change from one entry to the next are written anew.
class Place {
 public:
  explicit Place(const std::vector<TableAxis>& axes) : axes_(axes), index_(axes.size(), 0) {
    for (const TableAxis& axis : axes_) fields_.push_back(csv_field(axis_text(axis, 0)));
  }

  void append_to(std::string& line) const {
    for (const std::string& field : fields_) line.append(field).push_back(',');
  }

  void advance() {
    for (std::size_t i = axes_.size(); i-- > 0;) {
      index_[i] = (index_[i] + 1) % axes_[i].size();
      fields_[i] = csv_field(axis_text(axes_[i], index_[i]));
      if (index_[i] != 0) return;
    }
  }

 private:
  const std::vector<TableAxis>& axes_;
  std::vector<std::size_t> index_;
  std::vector<std::string> fields_;
};

void write_entries(const TableDocument& table, std::ostream& out) {
  const std::size_t size = table.size();
  if (size == 0) return;
  Place place(table.axes);
  std::string line;
  for (std::size_t i = 0; i < size; ++i) {
    line.clear();
    place.append_to(line);
    append_number(line, table.values[i]);
    if (table.errors != nullptr) append_number(line += ',', table.errors[i]);
    out << (line += '\n');
    place.advance();
  }
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos && !text.starts_with('#')) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted += '"';
}

void write_csv(const TableDocument& table, const std::string& path) {
  AtomicFile file(path);
  write_header(table, file.stream());
  write_entries(table, file.stream());
  file.commit();
}

}  // namespace albedo::analysis
