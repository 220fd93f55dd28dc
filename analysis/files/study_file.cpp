#include "analysis/files/study_file.hpp"

#include "albedo/core/errors.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {

bool is_json_path(const std::string& path) {
  if (path == "-") return false;
  const std::string ending = ending_of(path);
  if (ending == ".csv" || ending == ".json") return ending == ".json";
  throw ParameterError("output: '" + path + "' must end in .csv or .json");
}

void check_study_path(const std::string& path) {
  static_cast<void>(is_json_path(path));
  AtomicFile::check(path);
}

void write_provenance(const nlohmann::ordered_json& provenance, std::ostream& out) {
  using Json = nlohmann::ordered_json;
  for (const auto& [key, item] : provenance.items()) {
    out << "# " << comment_text(key) << ": " << comment_text(item.is_string() ? item : Json(json_text(item))) << '\n';
  }
}

}  // namespace albedo::analysis
