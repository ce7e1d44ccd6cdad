#include "engine/import/trim/surface_inverse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lamina::engine {
namespace {

/// Breaks of a direction with some parameters between them.
std::vector<double> grid_lines(const Knots& knots, int degree) {
  const std::vector<double> breaks = break_points(knots, degree);
  constexpr int kEnough = 64;
  const int pieces =
      std::clamp(kEnough / static_cast<int>(breaks.size()), 1, std::max(2, std::min(8, 2 * degree)));
  std::vector<double> lines;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (int k = 0; k < pieces; ++k) lines.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / pieces);
  }
  lines.push_back(breaks.back());
  return lines;
}

double widest_gap(const std::vector<double>& lines) {
  double widest = 0.0;
  for (std::size_t i = 1; i < lines.size(); ++i) widest = std::max(widest, lines[i] - lines[i - 1]);
  return widest;
}

double wrapped(double value, double first, double last, double period) {
  if (period > 0.0 && (value < first || value > last)) value -= period * std::floor((value - first) / period);
  return std::clamp(value, first, last);
}

}  // namespace

SurfaceInverse::SurfaceInverse(const NurbsSurface& surface, const SurfaceTopology& topology)
    : surface_(surface),
      topology_(topology),
      period_u_(topology.period_u),
      period_v_(topology.period_v),
      size_(topology.size) {}

void SurfaceInverse::make_grid() const {
  // Of a side that shrinks to a pole every point is the same: starts lie beside it.
  const auto beside_pole = [&](std::vector<double> lines, Side first, Side last) {
    constexpr double kPart = 0.3;
    if (topology_.poles[static_cast<std::size_t>(first)]) lines.front() += kPart * (lines[1] - lines[0]);
    if (topology_.poles[static_cast<std::size_t>(last)])
      lines.back() -= kPart * (lines.back() - lines[lines.size() - 2]);
    return lines;
  };
  const std::vector<double> us =
      beside_pole(grid_lines(surface_.knots_u, surface_.degree_u), Side::kFirstU, Side::kLastU);
  const std::vector<double> vs =
      beside_pole(grid_lines(surface_.knots_v, surface_.degree_v), Side::kFirstV, Side::kLastV);
  spacing_ = {widest_gap(us), widest_gap(vs)};
  grid_.reserve(us.size() * vs.size());
  for (const double u : us) {
    const NurbsCurve across = isoparametric_curve(surface_, u);
    for (const double v : vs) grid_.push_back({{u, v}, evaluate(across, v)});
  }
}

Vector2 SurfaceInverse::inside(const Vector2& at) const {
  return {wrapped(at.x(), surface_.first_u(), surface_.last_u(), period_u_),
          wrapped(at.y(), surface_.first_v(), surface_.last_v(), period_v_)};
}

Vector2 SurfaceInverse::kept_inside(const Vector2& at) const {
  return {period_u_ > 0.0 ? at.x() : std::clamp(at.x(), surface_.first_u(), surface_.last_u()),
          period_v_ > 0.0 ? at.y() : std::clamp(at.y(), surface_.first_v(), surface_.last_v())};
}

Vector3 SurfaceInverse::point(const Vector2& at) const {
  const Vector2 wrapped_at = inside(at);
  return evaluate(surface_, wrapped_at.x(), wrapped_at.y());
}

double SurfaceInverse::step_length(const Vector2& at, const Vector2& by) const {
  const Vector2 wrapped_at = inside(at);
  const SurfaceDerivatives d = evaluate_derivatives(surface_, wrapped_at.x(), wrapped_at.y());
  return (by.x() * d.du + by.y() * d.dv).norm();
}

Vector2 SurfaceInverse::moved_near(Vector2 at, const Vector2& other) const {
  if (period_u_ > 0.0) at.x() -= period_u_ * std::round((at.x() - other.x()) / period_u_);
  if (period_v_ > 0.0) at.y() -= period_v_ * std::round((at.y() - other.y()) / period_v_);
  return at;
}

/// Minimises the distance: a Gauss-Newton step, with second derivatives where these keep it a descent.
SurfaceInverse::Foot SurfaceInverse::refined(const Vector3& point, Vector2 at) const {
  constexpr int kSteps = 30;
  const double range_u = surface_.last_u() - surface_.first_u();
  const double range_v = surface_.last_v() - surface_.first_v();
  // On a pole every direction along its side looks the same: start a little inside.
  const auto off_pole = [&](double value, double first, double last, Side first_side, Side last_side) {
    constexpr double kPart = 1e-4;
    const double range = last - first;
    const double low = topology_.poles[static_cast<std::size_t>(first_side)] ? first + kPart * range : value;
    const double high = topology_.poles[static_cast<std::size_t>(last_side)] ? last - kPart * range : value;
    return std::min(std::max(value, low), high);
  };
  at.x() = off_pole(at.x(), surface_.first_u(), surface_.last_u(), Side::kFirstU, Side::kLastU);
  at.y() = off_pole(at.y(), surface_.first_v(), surface_.last_v(), Side::kFirstV, Side::kLastV);
  at = kept_inside(at);
  Foot best{at, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < kSteps; ++i) {
    const Vector2 wrapped_at = inside(at);
    const SurfaceDerivatives d = evaluate_derivatives(surface_, wrapped_at.x(), wrapped_at.y());
    const Vector3 r = d.point - point;
    const double distance = r.norm();
    const bool is_best = distance < best.distance;
    if (is_best) best = {at, distance};
    const Vector2 gradient(r.dot(d.du), r.dot(d.dv));
    const double floor = 1e-14 * size_;
    if (distance <= floor) break;
    double uu = d.du.squaredNorm() + r.dot(d.duu);
    double uv = d.du.dot(d.dv) + r.dot(d.duv);
    double vv = d.dv.squaredNorm() + r.dot(d.dvv);
    const bool is_newton = uu > 0.0 && vv > 0.0 && uu * vv - uv * uv > 1e-12 * uu * vv;
    if (!is_newton) {
      uu = d.du.squaredNorm();
      uv = d.du.dot(d.dv);
      vv = d.dv.squaredNorm();
      const double damping = 1e-12 * (uu + vv);
      uu += damping;
      vv += damping;
    }
    // At a side of the domain only steps inwards, or along it, are of use.
    const auto is_blocked = [](double value, double first, double last, double period, double slope) {
      return period == 0.0 && ((value <= first && slope > 0.0) || (value >= last && slope < 0.0));
    };
    const bool stop_u = is_blocked(at.x(), surface_.first_u(), surface_.last_u(), period_u_, gradient.x());
    const bool stop_v = is_blocked(at.y(), surface_.first_v(), surface_.last_v(), period_v_, gradient.y());
    Vector2 step = Vector2::Zero();
    const double determinant = uu * vv - uv * uv;
    if (stop_u && stop_v) break;
    if (stop_u) {
      if (vv > 0.0) step.y() = -gradient.y() / vv;
    } else if (stop_v) {
      if (uu > 0.0) step.x() = -gradient.x() / uu;
    } else if (determinant > 0.0) {
      step =
          Vector2(uv * gradient.y() - vv * gradient.x(), uv * gradient.x() - uu * gradient.y()) / determinant;
    } else {
      break;
    }
    step.x() = std::clamp(step.x(), -0.25 * range_u, 0.25 * range_u);
    step.y() = std::clamp(step.y(), -0.25 * range_v, 0.25 * range_v);
    const Vector2 next = kept_inside(at + step);
    const Vector2 taken = next - at;
    at = next;
    // After a full step of Newton's method the error is of the order of its square.
    const double small = is_newton && taken == step ? 1e-7 : 1e-15;
    if (std::abs(taken.x()) <= small * range_u && std::abs(taken.y()) <= small * range_v) {
      if (is_best) best.at = at;
      break;
    }
  }
  return best;
}

SurfaceInverse::Foot SurfaceInverse::nearest(const Vector3& point) const {
  constexpr std::size_t kStarts = 3;
  std::array<std::pair<double, const GridPoint*>, kStarts> starts;
  starts.fill({std::numeric_limits<double>::infinity(), nullptr});
  if (grid_.empty()) make_grid();
  for (const GridPoint& candidate : grid_) {
    const double squared = (candidate.point - point).squaredNorm();
    if (squared >= starts.back().first) continue;
    starts.back() = {squared, &candidate};
    for (std::size_t i = kStarts - 1; i > 0 && starts[i].first < starts[i - 1].first; --i)
      std::swap(starts[i], starts[i - 1]);
  }
  Foot best{Vector2::Zero(), std::numeric_limits<double>::infinity()};
  for (const auto& [squared, start] : starts) {
    if (start == nullptr) continue;
    // From beside a foot the way leads there.
    const Vector2 away = (start->at - best.at).cwiseAbs();
    if (away.x() <= spacing_.x() && away.y() <= spacing_.y() && std::isfinite(best.distance)) continue;
    const Foot foot = refined(point, start->at);
    if (foot.distance < best.distance) best = foot;
    if (best.distance <= 1e-10 * size_) break;
  }
  best.at = inside(best.at);
  return best;
}

SurfaceInverse::Foot SurfaceInverse::nearest(const Vector3& point, const Vector2& hint,
                                             double trusted) const {
  constexpr double kNear = 1e-7;
  Foot foot = refined(point, hint);
  if (foot.distance > std::max(trusted, kNear * size_)) {
    const Foot other = nearest(point);
    if (other.distance < 0.5 * foot.distance) foot = other;
  }
  foot.at = moved_near(foot.at, hint);
  return foot;
}

}  // namespace lamina::engine
