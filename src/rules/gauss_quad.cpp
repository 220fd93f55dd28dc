#include "rules/gauss_quad.hpp"

#include "rules/make_nodes.hpp"
#include "rules/product_rule.hpp"

namespace albedo {

template Nodes<Quad> make_nodes(AxisKind, int, int);
template EstimateIn<Quad> gauss(const Integrand<Quad>&, const RuleOptions&);

}  // namespace albedo
