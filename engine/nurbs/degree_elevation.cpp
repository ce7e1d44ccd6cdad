#include "engine/nurbs/degree_elevation.h"

#include <cassert>

namespace lamina::engine {
namespace {

BezierChain elevated_once(const BezierChain& chain) {
  const auto p = static_cast<std::size_t>(chain.degree);
  BezierChain result;
  result.degree = chain.degree + 1;
  result.breaks = chain.breaks;
  result.control_points.reserve((chain.breaks.size() - 1) * (p + 1) + 1);
  result.control_points.push_back(chain.control_points.front());
  for (std::size_t first = 0; first + p < chain.control_points.size(); first += p) {
    for (std::size_t k = 1; k <= p; ++k) {
      const double ratio = static_cast<double>(k) / static_cast<double>(p + 1);
      result.control_points.emplace_back(ratio * chain.control_points[first + k - 1] +
                                         (1.0 - ratio) * chain.control_points[first + k]);
    }
    result.control_points.push_back(chain.control_points[first + p]);
  }
  return result;
}

}  // namespace

BezierChain elevated(const BezierChain& chain, int degree) {
  assert(degree >= chain.degree);
  BezierChain result = chain;
  while (result.degree < degree) result = elevated_once(result);
  return result;
}

}  // namespace lamina::engine
