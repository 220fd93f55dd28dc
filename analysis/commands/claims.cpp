#include <iostream>
#include <memory>

#include "albedo/core/errors.hpp"
#include "analysis/claims/claims.hpp"
#include "analysis/claims/claims_report.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/text/progress.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

struct Arguments {
  std::vector<Paper> papers;
  int threads = 0;
  bool json = false, markdown = false;
};

int run(const Arguments& arguments, const std::string& command_line) {
  if (arguments.json && arguments.markdown)
    throw ParameterError("--json and --markdown would both use standard output");
  const std::vector<Claim> claims = claims_of(arguments.papers);
  std::vector<Finding> findings;
  {
    ProgressBar progress;
    findings = check_claims(claims, arguments.threads, library_model,
                            [&progress](std::size_t done, std::size_t total) { progress.update(done, total); });
  }
  if (arguments.json) {
    nlohmann::ordered_json object = begin_provenance(command_line);
    object["claims"] = claims_json(claims, findings);
    std::cout << json_text(object) << '\n';
  } else if (arguments.markdown) {
    print_markdown(std::cout, claims, findings, command_line);
  } else {
    print_claims(std::cout, claims, findings);
  }
  return exit_code::done;
}

}  // namespace

Command add_claims(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app = program.subcommand("claims", "what four papers claim of these models, and whether it holds");
  add_choices(app, "--paper", all_papers, arguments->papers, "only these; default: all");
  add_integer(app, "--threads", arguments->threads, 1, 1024, "default: one a core");
  app.flag("--json", arguments->json, "print one JSON object, with all numbers and their errors");
  app.flag("--markdown", arguments->markdown, "print a page in Markdown");
  app.footer(
      "Verdicts: 'holds', 'holds if' (the condition follows), 'fails' (the worst case and the smallest change that\n"
      "repairs it follow) and 'undecided', where some number missed its tolerance. All of them are computed from the\n"
      "models as they are; the exit code is 0 whatever they are.\n"
      "Example: what does Kurt's paper claim that isn't so?\n"
      "  albedo claims --paper kurt");
  return {app, [arguments](const std::string& command_line) { return run(*arguments, command_line); }};
}

}  // namespace albedo::analysis
