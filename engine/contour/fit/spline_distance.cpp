#include "engine/contour/fit/spline_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/basis_window.h"
#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kPlacesPerSpan = 10;
constexpr int kHeadingsPerSpan = 8;
/// The cosine of the angle by which the curve's direction may differ from the chain's.
constexpr double kLeastHeading = 0.5;
/// A slip moves the foot point by second order; what it leaves is far below any tolerance once it is this
/// part of the way between two samples.
constexpr double kSmallSlip = 0.05;

/// Direction of the chain that far along; `node` is advanced to the one before.
Vector2 tangent_at(const WalkedChain& walk, double walked, std::size_t& node) {
  while (node + 2 < walk.walked.size() && walk.walked[node + 1] <= walked) ++node;
  const double part = std::clamp((walked - walk.walked[node]) / walk.lengths[node], 0.0, 1.0);
  return ((1.0 - part) * walk.chain.tangents[node] + part * walk.chain.tangents[node + 1]).normalized();
}

/// Whether each span of the curve runs the way of the chain: one that darts out between two places of the
/// chain and back again is near all of them.
template <int kDegree>
std::vector<bool> spans_running_along(const PlanarCurve& curve, const std::vector<FitSample>& samples,
                                      const WalkedChain& walk) {
  constexpr auto kCount = static_cast<std::size_t>(kDegree);
  std::vector<bool> along(curve.control_points.size() - kCount, true);
  std::size_t sample = 0;
  std::size_t node = 0;
  for (std::size_t span = kCount; span < curve.control_points.size(); ++span) {
    const SpanBasis<kDegree> basis(curve.knots, span);
    for (int k = 0; k < kHeadingsPerSpan; ++k) {
      const double t =
          curve.knots[span] + (k + 0.5) / kHeadingsPerSpan * (curve.knots[span + 1] - curve.knots[span]);
      while (sample + 2 < samples.size() && samples[sample + 1].parameter <= t) ++sample;
      const FitSample& left = samples[sample];
      const FitSample& right = samples[sample + 1];
      const double gap = right.parameter - left.parameter;
      const double part = gap > 0.0 ? std::clamp((t - left.parameter) / gap, 0.0, 1.0) : 0.0;
      const Vector2 tangent = tangent_at(walk, left.walked + part * (right.walked - left.walked), node);
      const BasisWindow window = basis.at(t);
      Vector2 derivative = Vector2::Zero();
      for (std::size_t r = 0; r <= kCount; ++r)
        derivative += window.slope[r] * curve.control_points[window.first + r];
      if (!(derivative.dot(tangent) >= kLeastHeading * derivative.norm())) along[span - kCount] = false;
    }
  }
  return along;
}

template <int kDegree>
std::vector<double> span_distances_of_degree(const PlanarCurve& curve, const std::vector<FitSample>& samples,
                                             const WalkedChain& walk) {
  constexpr auto kCount = static_cast<std::size_t>(kDegree);
  const std::size_t spans = curve.control_points.size() - kCount;
  const std::size_t parts = (kPlacesPerSpan * spans + walk.segments() - 1) / walk.segments();
  std::vector<double> distances(spans, 0.0);
  std::size_t sample = 0;
  std::size_t span = kCount;
  SpanBasis<kDegree> basis(curve.knots, span);
  double foot = curve.knots.front();  // of the place before
  double foot_walked = 0.0;
  for_each_place(walk, 1, parts, [&](const Vector2& place, const Vector2& tangent, double walked) {
    // The parameters of the samples on either side give a first guess.
    while (sample + 2 < samples.size() && samples[sample + 1].walked <= walked) ++sample;
    const FitSample& left = samples[sample];
    const FitSample& right = samples[sample + 1];
    double t = left.parameter +
               (walked - left.walked) / (right.walked - left.walked) * (right.parameter - left.parameter);
    double distance = 0.0;
    double heading = 1.0;
    double way = 0.0;  // along the curve from the foot point before
    for (int newton = 0; newton < 4; ++newton) {
      const std::size_t before = span;
      while (span > kCount && t < curve.knots[span]) --span;
      while (span + 1 < curve.control_points.size() && t >= curve.knots[span + 1]) ++span;
      if (span != before) basis = SpanBasis<kDegree>(curve.knots, span);
      const BasisWindow window = basis.at(t);
      Vector2 gap = -place;
      Vector2 derivative = Vector2::Zero();
      for (std::size_t r = 0; r <= kCount; ++r) {
        gap += window.value[r] * curve.control_points[window.first + r];
        derivative += window.slope[r] * curve.control_points[window.first + r];
      }
      const double speed = derivative.norm();
      const double slip = gap.dot(derivative) / speed;
      distance = std::abs(cross(derivative, gap)) / speed;
      heading = derivative.dot(tangent) / speed;
      way = (t - slip / speed - foot) * speed;
      if (!(std::abs(slip) > kSmallSlip * (right.walked - left.walked))) break;
      distance = gap.norm();
      t = std::clamp(t - slip / speed, curve.knots.front(), curve.knots.back());
    }
    // Near every place is not enough: the curve must run along them, or it could stray in between.
    const double step = walked - foot_walked;
    if (!(heading >= kLeastHeading && way >= 0.3 * step && way <= 3.0 * step))
      distance = std::numeric_limits<double>::infinity();
    distances[span - kCount] = std::max(distances[span - kCount], distance);
    foot = t;
    foot_walked = walked;
  });
  const std::vector<bool> along = spans_running_along<kDegree>(curve, samples, walk);
  for (std::size_t k = 0; k < spans; ++k) {
    if (!along[k]) distances[k] = std::numeric_limits<double>::infinity();
  }
  return distances;
}

}  // namespace

std::vector<double> span_distances(const PlanarCurve& curve, const std::vector<FitSample>& samples,
                                   const WalkedChain& walk) {
  return with_degree(curve.degree,
                     [&](auto degree) { return span_distances_of_degree<degree>(curve, samples, walk); });
}

}  // namespace lamina::engine
