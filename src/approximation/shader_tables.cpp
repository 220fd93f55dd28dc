#include "albedo/shader_tables.hpp"

#include <algorithm>
#include <cmath>

#include "albedo/combinators/balanced.hpp"
#include "albedo/combinators/compensated.hpp"
#include "albedo/combinators/pumped.hpp"
#include "albedo/combinators/sum.hpp"
#include "core/text.hpp"
#include "numerics/larger.hpp"

namespace albedo {
namespace {

/// The matte part of a coupled model is m(L) m(V).
double matte_factor(const Model& coupled, double cos_theta) {
  const Model& matte = *dynamic_cast<const SumModel&>(coupled).parts().back().model;
  const Direction l = Direction::from_cosine(cos_theta);
  return std::sqrt(brdf<double>(matte, l, l));
}

}  // namespace

std::vector<ShaderFunction> shader_functions(std::unique_ptr<Model> model, const Corrections& corrections) {
  std::vector<ShaderFunction> functions;
  if (corrections.pump.times > 0) {
    auto pumped = std::make_unique<PumpedModel>(std::move(model), corrections.pump);
    for (int k = 0; k < corrections.pump.times; ++k) {
      functions.push_back({fmt::format("1/a_{}", k), [divisor = pumped->divisor(), k](double cos_theta) {
                             return std::exp(-divisor->log_albedo(k, -std::log(cos_theta)));
                           }});
    }
    model = std::move(pumped);
  }
  if (corrections.correct == Correction::none) return functions;
  Corrections last = corrections;
  last.pump.times = 0;
  const std::shared_ptr<const Model> corrected = last.applied_to(std::move(model));
  switch (corrections.correct) {
    case Correction::balance:
      functions.push_back({"1/s", [corrected](double cos_theta) {
                             const auto& balanced = dynamic_cast<const BalancedModel&>(*corrected);
                             return std::exp(-balanced.balance().log_s(cos_theta));
                           }});
      break;
    case Correction::multiscatter:
      functions.push_back({"m", [corrected](double cos_theta) { return matte_factor(*corrected, cos_theta); }});
      break;
    default:
      functions.push_back({"1/a", [corrected](double cos_theta) {
                             return 1 / dynamic_cast<const CompensatedModel&>(*corrected).albedo().upper(cos_theta);
                           }});
  }
  return functions;
}

double shader_node(std::size_t i, std::size_t size) {
  const double root = static_cast<double>(i) / static_cast<double>(size - 1);
  return root * root;
}

ShaderTable tabulate(const std::vector<ShaderFunction>& functions, std::size_t size, double largest_error) {
  constexpr std::size_t least = 64, most = 65536;
  const bool is_chosen = size > 0;
  for (ShaderTable table{.size = is_chosen ? size : least};; table = {.size = 2 * table.size}) {
    for (const auto& [name, value] : functions) {
      const std::size_t begin = table.values.size();
      for (std::size_t i = 0; i < table.size; ++i) table.values.push_back(value(shader_node(i, table.size)));
      const double scale =
          std::abs(*std::max_element(table.values.begin() + static_cast<std::ptrdiff_t>(begin), table.values.end()));
      for (std::size_t i = 0; i + 1 < table.size; ++i) {
        const double between = (table.values[begin + i] + table.values[begin + i + 1]) / 2;
        const double exact = value(shader_node(2 * i + 1, 2 * table.size - 1));
        keep_larger(table.error, scale == 0 ? std::abs(between - exact) : std::abs(between - exact) / scale);
      }
    }
    if (is_chosen || table.error <= largest_error || table.size >= most) return table;
  }
}

}  // namespace albedo
