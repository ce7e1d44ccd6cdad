#include "engine/nurbs/join.h"

#include <algorithm>
#include <cassert>

#include "engine/nurbs/bezier_chain.h"
#include "engine/nurbs/degree_elevation.h"

namespace lamina::engine {
namespace {

/// Appends `next`, whose parameters and weights are moved so that they go on where `chain` ends.
void append(BezierChain& chain, const BezierChain& next) {
  const double shift = chain.breaks.back() - next.breaks.front();
  for (std::size_t i = 1; i < next.breaks.size(); ++i) chain.breaks.push_back(next.breaks[i] + shift);
  const Vector4 end = chain.control_points.back();
  // All homogeneous points times one factor are the same curve.
  const double factor = end.w() / next.control_points.front().w();
  chain.control_points.back() = 0.5 * (end + factor * next.control_points.front());
  for (std::size_t i = 1; i < next.control_points.size(); ++i) {
    chain.control_points.emplace_back(factor * next.control_points[i]);
  }
}

}  // namespace

NurbsCurve joined(const std::vector<NurbsCurve>& pieces) {
  assert(!pieces.empty());
  int degree = 1;
  for (const NurbsCurve& piece : pieces) degree = std::max(degree, piece.degree);
  BezierChain chain = elevated(bezier_chain(pieces.front()), degree);
  const double origin = chain.breaks.front();
  for (double& knot : chain.breaks) knot -= origin;
  for (std::size_t i = 1; i < pieces.size(); ++i) append(chain, elevated(bezier_chain(pieces[i]), degree));
  return to_curve(chain);
}

}  // namespace lamina::engine
