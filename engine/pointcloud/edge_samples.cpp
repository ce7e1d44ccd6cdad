#include "engine/pointcloud/edge_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/bspline_basis.h"
#include "engine/geometry/segment_distance.h"
#include "engine/model.h"

namespace lamina::engine {
namespace {

constexpr int kDeepestHalving = 12;
constexpr double kPartOfSpan = 0.25;
constexpr int kMostParabolas = 8;
constexpr double kSameParameter = 1e-6;

/// Greatest length of a chord along one direction of a surface.
double longest_along(const Knots& knots, int degree) {
  if (degree == 1) return std::numeric_limits<double>::infinity();
  const std::vector<double> breaks = break_points(knots, degree);
  return kPartOfSpan * (breaks.back() - breaks.front()) / static_cast<double>(breaks.size() - 1);
}

/// How far from its chord a Bezier segment gets, in parts of the distance of its inner control points: what
/// the inner Bernstein polynomials sum up to at most, in the middle; all of it where weights shift that.
double inner_share(const BezierChain& curve) {
  const double weight = curve.control_points.front().w();
  const bool is_rational = std::any_of(curve.control_points.begin(), curve.control_points.end(),
                                       [&](const Vector4& point) { return point.w() != weight; });
  return is_rational ? 1.0 : 1.0 - std::pow(0.5, curve.degree - 1);
}

/// Halves Bezier segments until their control points show that they are near their chords.
class Sampler {
 public:
  Sampler(const NurbsSurface& surface, const BezierChain& curve, double tolerance)
      : surface_(surface),
        curve_(curve),
        order_(static_cast<std::size_t>(curve.degree) + 1),
        furthest_(tolerance / std::max(inner_share(curve), 0.5)),
        longest_(longest_along(surface.knots_u, surface.degree_u),
                 longest_along(surface.knots_v, surface.degree_v)) {
    nets_.resize(order_ * (2 * kDeepestHalving + 3));
  }

  std::vector<EdgeSample> samples() {
    const std::size_t step = order_ - 1;
    add(curve_.breaks.front(), curve_.control_points.front());
    for (std::size_t k = 0; k + 1 < curve_.breaks.size(); ++k) {
      std::copy_n(curve_.control_points.begin() + static_cast<std::ptrdiff_t>(k * step), order_,
                  nets_.begin());
      halve(0, curve_.breaks[k], curve_.breaks[k + 1], 0);
    }
    add_turning_points();
    return std::move(samples_);
  }

 private:
  static Vector2 place(const Vector4& point) { return point.head<2>() / point.w(); }

  void add(double t, const Vector4& point) { samples_.push_back(lifted(t, place(point))); }

  EdgeSample lifted(double t, const Vector2& at) const { return {t, at, evaluate(surface_, at.x(), at.y())}; }

  void add_turning_points() {
    const auto turns = [](const EdgeSample& a, const EdgeSample& b, const EdgeSample& c) {
      const double before = b.position.z() - a.position.z();
      const double after = c.position.z() - b.position.z();
      return before * after < 0.0 && std::min(std::abs(before), std::abs(after)) > kModelTolerance;
    };
    std::vector<EdgeSample> all;
    all.reserve(samples_.size());
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      const EdgeSample& sample = samples_[k];
      const bool inner = k > 0 && k + 1 < samples_.size();
      if (!inner || !turns(samples_[k - 1], sample, samples_[k + 1])) {
        all.push_back(sample);
        continue;
      }
      const EdgeSample turn = turning_point(samples_[k - 1], sample, samples_[k + 1]);
      if (turn.t < sample.t) all.push_back(turn);
      all.push_back(sample);
      if (turn.t > sample.t) all.push_back(turn);
    }
    samples_ = std::move(all);
  }

  /// The curve's highest or lowest point around `b`, by successive parabolas (Brent, Algorithms for
  /// Minimization Without Derivatives, chapter 5).
  EdgeSample turning_point(EdgeSample a, EdgeSample b, EdgeSample c) const {
    const double sign = b.position.z() > a.position.z() ? 1.0 : -1.0;
    const auto height = [&](const EdgeSample& sample) { return sign * sample.position.z(); };
    for (int step = 0; step < kMostParabolas; ++step) {
      const double p = (b.t - a.t) * (height(b) - height(c));
      const double q = (b.t - c.t) * (height(b) - height(a));
      const double t = b.t - 0.5 * ((b.t - a.t) * p - (b.t - c.t) * q) / (p - q);
      if (!(t > a.t && t < c.t) || std::abs(t - b.t) <= kSameParameter * (c.t - a.t)) break;
      const EdgeSample next = lifted(t, evaluate(curve_, t).head<2>());
      const bool higher = height(next) >= height(b);
      // The highest of the four stays in the middle.
      EdgeSample& replaced = (t < b.t) == higher ? c : a;
      replaced = higher ? b : next;
      if (higher) b = next;
    }
    return b;
  }

  bool is_chord(const Vector4* net) const {
    const Vector2 a = place(net[0]);
    const Vector2 b = place(net[order_ - 1]);
    if (std::abs(b.x() - a.x()) > longest_.x() || std::abs(b.y() - a.y()) > longest_.y()) return false;
    return std::all_of(net + 1, net + order_ - 1, [&](const Vector4& point) {
      return squared_distance(place(point), a, b) <= furthest_ * furthest_;
    });
  }

  /// The control net at `first` of `nets_`, of the curve from `low` to `high`; what lies behind it is free.
  void halve(std::size_t first, double low, double high, int depth) {
    if (depth == kDeepestHalving || is_chord(&nets_[first])) {
      add(high, nets_[first + order_ - 1]);
      return;
    }
    // The upper half lies below the lower one, so that it outlives the visit to it.
    Vector4* const upper = &nets_[first + order_];
    Vector4* const lower = upper + order_;
    std::copy_n(&nets_[first], order_, upper);
    for (std::size_t k = 0; k < order_; ++k) {
      lower[k] = upper[0];
      for (std::size_t j = 0; j + 1 + k < order_; ++j) upper[j] = 0.5 * (upper[j] + upper[j + 1]);
    }
    const double middle = 0.5 * (low + high);
    halve(first + 2 * order_, low, middle, depth + 1);
    halve(first + order_, middle, high, depth + 1);
  }

  const NurbsSurface& surface_;
  const BezierChain& curve_;
  std::size_t order_;
  double furthest_;  ///< that an inner control point may be from the chord
  Vector2 longest_;
  std::vector<Vector4> nets_;
  std::vector<EdgeSample> samples_;
};

}  // namespace

std::vector<EdgeSample> edge_samples(const NurbsSurface& surface, const BezierChain& curve,
                                     double tolerance) {
  return Sampler(surface, curve, tolerance).samples();
}

}  // namespace lamina::engine
