#include "analysis/claims/claims_report.hpp"

#include <algorithm>
#include <utility>

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// What was found, with names for its parts: at least one.
std::vector<std::string> paragraphs(const Finding& finding) {
  std::vector<std::string> all;
  if (!finding.condition.empty()) all.push_back("if: " + finding.condition);
  all.push_back(finding.found);
  if (!finding.worst.empty()) all.push_back("worst: " + finding.worst);
  if (!finding.repair.empty()) all.push_back("repair: " + finding.repair);
  return all;
}

/// Lines of at most `width` characters, broken at spaces; a longer word has one of its own.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && line.size() + 1 + word.size() > width) lines.push_back(std::exchange(line, ""));
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  lines.push_back(line);
  return lines;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

/// | ends a cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '_' || c == '<') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace

void print_claims(std::ostream& out, const std::vector<Claim>& claims, const std::vector<Finding>& findings) {
  constexpr std::size_t id_width = 4, verdict_width = 10, claim_width = 38, finding_width = 62;
  constexpr std::size_t first_columns = id_width + verdict_width + claim_width + 4;
  static_assert(first_columns + finding_width <= 120);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (i == 0 || claims[i].paper != claims[i - 1].paper) {
      out << (i > 0 ? "\n" : "") << title_of(claims[i].paper) << '\n';
    }
    const std::vector<std::string> left = wrapped(claims[i].statement + " (" + claims[i].where + ")", claim_width);
    std::vector<std::string> right;
    for (const std::string& paragraph : paragraphs(findings[i])) {
      const std::vector<std::string> lines = wrapped(paragraph, finding_width);
      right.insert(right.end(), lines.begin(), lines.end());
    }
    for (std::size_t line = 0; line < std::max(left.size(), right.size()); ++line) {
      std::string text = line > 0 ? padded("", id_width + verdict_width + 2)
                                  : padded(claims[i].id, id_width + 1) +
                                        padded(std::string(to_string(findings[i].verdict)), verdict_width + 1);
      text += padded(line < left.size() ? left[line] : "", claim_width) + "  ";
      if (line < right.size()) text += right[line];
      text.erase(text.find_last_not_of(' ') + 1);
      out << text << '\n';
    }
  }
}

Json claims_json(const std::vector<Claim>& claims, const std::vector<Finding>& findings) {
  Json all = Json::array();
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const Finding& finding = findings[i];
    Json quantities = Json::array();
    for (const Quantity& one : finding.quantities) {
      quantities.push_back({{"name", one.name}, {"value", one.value}, {"error", one.error}});
    }
    all.push_back({{"id", claims[i].id},
                   {"paper", name_of(claims[i].paper)},
                   {"where", claims[i].where},
                   {"claim", claims[i].statement},
                   {"verdict", to_string(finding.verdict)},
                   {"found", finding.found},
                   {"condition", finding.condition},
                   {"worst", finding.worst},
                   {"repair", finding.repair},
                   {"quantities", quantities}});
  }
  return all;
}

void print_markdown(std::ostream& out, const std::vector<Claim>& claims, const std::vector<Finding>& findings,
                    const std::string& command) {
  out << "# What the papers claim, and whether it holds\n\n"
         "Every verdict is computed by `albedo claims`; this page is the output of `"
      << command
      << "`, not to be edited.\n"
         "`albedo claims --json` has all numbers with their errors.\n";
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (i == 0 || claims[i].paper != claims[i - 1].paper) {
      out << "\n## " << title_of(claims[i].paper) << "\n\n| | claim | verdict | |\n|---|---|---|---|\n";
    }
    std::string finding;
    for (const std::string& paragraph : paragraphs(findings[i])) {
      finding += (finding.empty() ? "" : "<br>") + cell(paragraph);
    }
    out << "| " << claims[i].id << " | " << cell(claims[i].statement) << " (" << cell(claims[i].where) << ") | **"
        << to_string(findings[i].verdict) << "** | " << finding << " |\n";
  }
}

}  // namespace albedo::analysis
