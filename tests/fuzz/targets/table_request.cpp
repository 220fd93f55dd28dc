#include "analysis/commands/table_request.hpp"

#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(table_request) {
  using namespace albedo;
  std::vector<std::string> words = fuzz::words(input);
  if (words.empty()) return;
  analysis::ModelArguments arguments{.model = words.front(), .parameters = {words.begin() + 1, words.end()}};
  fuzz::accepts<Error>(
      [&] {
        const analysis::TableRequest request = analysis::parse_table_request(arguments);
        fuzz::require(!request.document_axes().empty() && !request.channels.empty(), "a table of no axes");
        fuzz::require(request.axes.size() == request.document_axes().size() + request.fixed_directions().size(),
                      "an axis is lost");
        static_cast<void>(request.fixed_parameters());
        static_cast<void>(request.phi());
      },
      fuzz::Cited::command);
  fuzz::accepts<ParameterError>([&] { analysis::parse_material_request(arguments); }, fuzz::Cited::command);
}
