#include "engine/import/trim/parameter_loop.h"

#include <algorithm>
#include <cmath>

#include "engine/import/trim/fitted_path.h"
#include "engine/nurbs/reverse.h"

namespace lamina::engine {
namespace {

/// Chains curves of the parameter plane.
class LoopChain {
 public:
  explicit LoopChain(const LoopGround& ground) : ground_(ground) {}

  bool is_empty() const { return loop_.curves.empty(); }
  Vector2 end() const { return parameter_end(loop_.curves.back()); }
  Vector2 start() const { return parameter_start(loop_.curves.front()); }

  /// Appends a curve; a gap is closed or bridged.
  void append(NurbsCurve curve) {
    if (!is_empty()) connect(parameter_start(curve));
    if (!is_empty() && parameter_start(curve) != end()) set_start(curve, end());
    loop_.curves.push_back(std::move(curve));
  }

  /// Where the loop goes along the side of a pole: how far whole periods must move `next`, so that what is
  /// inside stays to the left.
  Vector2 past_pole(Side side, const Vector2& next) const {
    Vector2 result = next;
    const bool along_u = side == Side::kFirstV || side == Side::kLastV;
    const double period = along_u ? ground_.topology.period_u : ground_.topology.period_v;
    if (period == 0.0) return result;
    const Eigen::Index axis = along_u ? 0 : 1;
    const double forwards = side == Side::kFirstV || side == Side::kLastU ? 1.0 : -1.0;
    // Between a little more than nothing and a whole period, in the direction of travel.
    constexpr double kRounding = 1e-6;
    double way = forwards * (next[axis] - end()[axis]);
    way -= period * std::floor(way / period);
    if (way < kRounding * period) way += period;
    result[axis] = end()[axis] + forwards * way;
    return result;
  }

  /// Goes straight to a point without counting it as a gap.
  void go_to(const Vector2& point) {
    if (point != end()) loop_.curves.push_back(parameter_line(end(), point));
  }

  void note_distance(double distance) { loop_.largest_distance = std::max(loop_.largest_distance, distance); }

  ParameterLoop closed() {
    if (is_empty()) return {};
    const Vector2 way = end() - start();
    const auto turns = [](double length, double period) {
      return period > 0.0 ? static_cast<int>(std::lround(length / period)) : 0;
    };
    const auto& topology = ground_.topology;
    loop_.turns_u = turns(way.x(), topology.period_u);
    loop_.turns_v = turns(way.y(), topology.period_v);
    const Vector2 target =
        start() + Vector2(loop_.turns_u * topology.period_u, loop_.turns_v * topology.period_v);
    connect(target);
    if (end() != target) {
      NurbsCurve& last = loop_.curves.back();
      last.control_points.back() = Vector4(target.x(), target.y(), 0.0, 1.0) * last.control_points.back().w();
    }
    return std::move(loop_);
  }

 private:
  static void set_start(NurbsCurve& curve, const Vector2& point) {
    curve.control_points.front() = Vector4(point.x(), point.y(), 0.0, 1.0) * curve.control_points.front().w();
  }

  /// Bridges the gap from the end to `point` unless it is small both in space and as parameters.
  void connect(const Vector2& point) {
    constexpr double kSmallPart = 1e-4;
    const Vector2 by = point - end();
    if (by.isZero(0.0)) return;
    const NurbsSurface& s = ground_.surface;
    const double length = (ground_.inverse.point(point) - ground_.inverse.point(end())).norm();
    loop_.largest_gap = std::max(loop_.largest_gap, length);
    const bool is_small_part = std::abs(by.x()) <= kSmallPart * (s.last_u() - s.first_u()) &&
                               std::abs(by.y()) <= kSmallPart * (s.last_v() - s.first_v());
    if (length <= ground_.tolerance && is_small_part) return;
    loop_.curves.push_back(parameter_line(end(), point));
  }

  const LoopGround& ground_;
  ParameterLoop loop_;
};

/// Knots where a curve may have a corner, and its ends.
std::vector<double> corner_breaks(const NurbsCurve& curve) {
  std::vector<double> breaks;
  for (const double knot : break_points(curve.knots, curve.degree)) {
    const bool is_end = knot <= curve.first_parameter() || knot >= curve.last_parameter();
    if (is_end || std::count(curve.knots.begin(), curve.knots.end(), knot) >= curve.degree)
      breaks.push_back(knot);
  }
  return breaks;
}

/// One curve in space, projected: a table of feet along it, between which further ones are found.
class ProjectedEdge {
 public:
  ProjectedEdge(const NurbsCurve& edge, const LoopGround& ground)
      : edge_(edge),
        ground_(ground),
        first_(edge.first_parameter()),
        last_(edge.last_parameter()),
        start_pole_(ground.topology.pole_at(evaluate(edge, first_), pole_tolerance())),
        end_pole_(ground.topology.pole_at(evaluate(edge, last_), pole_tolerance())) {}

  std::optional<Side> start_pole() const { return start_pole_; }

  /// Finds the feet; the first one near `hint` where there is one.
  void find_feet(const Vector2* hint) {
    // Close to a pole the feet are as good as anywhere but on it.
    constexpr double kOffPole = 1e-3;
    const double range = last_ - first_;
    const double begin = start_pole_ ? first_ + kOffPole * range : first_;
    const double end = end_pole_ ? last_ - kOffPole * range : last_;
    const std::size_t spans = break_points(edge_.knots, edge_.degree).size() - 1;
    const std::size_t steps =
        edge_.degree == 1 && spans == 1 ? 8 : std::clamp<std::size_t>(6 * spans, 12, 96);
    for (std::size_t i = 0; i <= steps; ++i) {
      const double t =
          i == steps ? end : begin + (end - begin) * static_cast<double>(i) / static_cast<double>(steps);
      const Vector3 point = evaluate(edge_, t);
      SurfaceInverse::Foot foot;
      if (i == 0) {
        foot = hint != nullptr ? ground_.inverse.nearest(point, *hint) : ground_.inverse.nearest(point);
      } else if (i == 1) {
        foot = ground_.inverse.nearest(point, feet_.back(), trusted_);
      } else {
        foot = ground_.inverse.nearest(point, 2.0 * feet_.back() - feet_[i - 2], trusted_);
      }
      // What lies farther was looked for everywhere.
      if (foot.distance > trusted_) trusted_ = kTrust * foot.distance;
      largest_distance = std::max(largest_distance, foot.distance);
      parameters_.push_back(t);
      feet_.push_back(foot.at);
    }
  }

  Vector2 start() const { return start_pole_ ? on_side(*start_pole_, feet_.front()) : feet_.front(); }

  void move(const Vector2& by) {
    for (Vector2& foot : feet_) foot += by;
  }

  Vector2 at(double t) const {
    if (t <= parameters_.front()) return mixed(first_, start(), parameters_.front(), feet_.front(), t);
    if (t >= parameters_.back()) {
      const Vector2 end = end_pole_ ? on_side(*end_pole_, feet_.back()) : feet_.back();
      return mixed(parameters_.back(), feet_.back(), last_, end, t);
    }
    const auto after = std::upper_bound(parameters_.begin(), parameters_.end(), t) - parameters_.begin();
    const auto i = static_cast<std::size_t>(after) - 1;
    if (t == parameters_[i]) return feet_[i];
    const Vector2 hint = mixed(parameters_[i], feet_[i], parameters_[i + 1], feet_[i + 1], t);
    return ground_.inverse.nearest(evaluate(edge_, t), hint, trusted_).at;
  }

  double largest_distance = 0.0;

 private:
  /// An edge that lies off the surface does so all along: feet up to this many times farther than one that
  /// was looked for everywhere are as good.
  static constexpr double kTrust = 1.5;

  double pole_tolerance() const { return std::max(ground_.tolerance, 1e-6 * ground_.topology.size); }

  static Vector2 mixed(double t0, const Vector2& a, double t1, const Vector2& b, double t) {
    return t1 > t0 ? Vector2(a + (t - t0) / (t1 - t0) * (b - a)) : b;
  }

  Vector2 on_side(Side side, Vector2 at) const {
    const NurbsSurface& s = ground_.surface;
    if (side == Side::kFirstU) at.x() = s.first_u();
    if (side == Side::kLastU) at.x() = s.last_u();
    if (side == Side::kFirstV) at.y() = s.first_v();
    if (side == Side::kLastV) at.y() = s.last_v();
    return at;
  }

  const NurbsCurve& edge_;
  const LoopGround& ground_;
  double first_;
  double last_;
  std::optional<Side> start_pole_;
  std::optional<Side> end_pole_;
  std::vector<double> parameters_;
  std::vector<Vector2> feet_;
  double trusted_ = 0.0;
};

bool has_length(const NurbsCurve& edge, double tolerance) {
  const Vector3 start = cartesian(edge.control_points.front());
  return std::any_of(edge.control_points.begin(), edge.control_points.end(),
                     [&](const Vector4& point) { return (cartesian(point) - start).norm() > tolerance; });
}

}  // namespace

Vector2 parameter_start(const NurbsCurve& parameter_curve) {
  return cartesian(parameter_curve.control_points.front()).head<2>();
}

Vector2 parameter_end(const NurbsCurve& parameter_curve) {
  return cartesian(parameter_curve.control_points.back()).head<2>();
}

NurbsCurve parameter_line(const Vector2& start, const Vector2& end) {
  return {1, {0.0, 0.0, 1.0, 1.0}, {{start.x(), start.y(), 0.0, 1.0}, {end.x(), end.y(), 0.0, 1.0}}};
}

NurbsCurve moved(NurbsCurve parameter_curve, const Vector2& by) {
  for (Vector4& point : parameter_curve.control_points) point.head<2>() += point.w() * by;
  return parameter_curve;
}

ParameterLoop chained_loop(const std::vector<NurbsCurve>& curves, const LoopGround& ground) {
  LoopChain chain(ground);
  const auto gap = [&](const Vector2& a, const Vector2& b) {
    return (ground.inverse.point(a) - ground.inverse.point(b)).norm();
  };
  for (std::size_t i = 0; i < curves.size(); ++i) {
    NurbsCurve curve = curves[i];
    for (Vector4& point : curve.control_points) point.z() = 0.0;
    if (chain.is_empty()) {
      // The first one may have to be turned round, too.
      if (i + 1 < curves.size()) {
        const auto nearest_end = [&](const Vector2& from) {
          return std::min(gap(from, parameter_start(curves[i + 1])), gap(from, parameter_end(curves[i + 1])));
        };
        const double as_given = nearest_end(parameter_end(curve));
        if (as_given > ground.tolerance && 10.0 * nearest_end(parameter_start(curve)) < as_given)
          curve = reversed(curve);
      }
      chain.append(std::move(curve));
      continue;
    }
    const double as_given = gap(chain.end(), parameter_start(curve));
    if (as_given > ground.tolerance && 10.0 * gap(chain.end(), parameter_end(curve)) < as_given)
      curve = reversed(curve);
    // On a pole the parameter along its side is free to jump.
    if (!ground.topology.pole_at(ground.inverse.point(chain.end()), ground.tolerance)) {
      const Vector2 start = parameter_start(curve);
      const Vector2 by = ground.inverse.moved_near(start, chain.end()) - start;
      if (!by.isZero(0.0)) curve = moved(std::move(curve), by);
    }
    chain.append(std::move(curve));
  }
  return chain.closed();
}

ParameterLoop projected_loop(const std::vector<NurbsCurve>& edges, const LoopGround& ground) {
  LoopChain chain(ground);
  std::optional<Side> first_pole;
  for (const NurbsCurve& edge : edges) {
    if (!has_length(edge, ground.tolerance)) continue;
    ProjectedEdge projected(edge, ground);
    const bool follows = !chain.is_empty() && !projected.start_pole();
    const Vector2 hint = chain.is_empty() ? Vector2::Zero() : chain.end();
    projected.find_feet(follows ? &hint : nullptr);
    if (chain.is_empty()) {
      first_pole = projected.start_pole();
    } else if (projected.start_pole()) {
      const Vector2 start = chain.past_pole(*projected.start_pole(), projected.start());
      projected.move(start - projected.start());
      chain.go_to(projected.start());
    }
    chain.note_distance(projected.largest_distance);
    chain.append(
        fitted_path([&](double t) { return projected.at(t); }, corner_breaks(edge),
                    [&](const Vector2& at, const Vector2& by) { return ground.inverse.step_length(at, by); },
                    ground.tolerance));
  }
  if (!chain.is_empty() && first_pole) chain.go_to(chain.past_pole(*first_pole, chain.start()));
  return chain.closed();
}

}  // namespace lamina::engine
