#include "engine/import/trim/trimmed_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/import/trim/loop_polygon.h"
#include "engine/import/trim/winding_loops.h"
#include "engine/nurbs/restrict.h"
#include "engine/nurbs/reverse.h"

namespace lamina::engine {
namespace {

void reverse(std::vector<NurbsCurve>& curves) {
  std::reverse(curves.begin(), curves.end());
  for (NurbsCurve& curve : curves) curve = reversed(curve);
}

/// u and v exchanged; run through backwards, so that what was inside stays to the left.
ParameterLoop transposed(ParameterLoop loop) {
  for (NurbsCurve& curve : loop.curves) {
    for (Vector4& point : curve.control_points) std::swap(point.x(), point.y());
  }
  reverse(loop.curves);
  std::swap(loop.turns_u, loop.turns_v);
  loop.turns_u = -loop.turns_u;
  loop.turns_v = -loop.turns_v;
  return loop;
}

/// Box around the control points of loops.
Box2 box_of(const std::vector<NurbsCurve>& curves) {
  Box2 box;
  for (const NurbsCurve& curve : curves) {
    for (const Vector4& point : curve.control_points) box.extend(Vector2(cartesian(point).head<2>()));
  }
  return box;
}

/// A surface and the loops on it while they are laid out.
struct Layout {
  NurbsSurface surface;
  SurfaceTopology topology;
  std::vector<ParameterLoop> loops;

  Layout exchanged() && {
    Layout result{lamina::engine::transposed(surface), topology, {}};
    std::swap(result.topology.period_u, result.topology.period_v);
    std::swap(result.topology.poles[0], result.topology.poles[2]);
    std::swap(result.topology.poles[1], result.topology.poles[3]);
    for (ParameterLoop& loop : loops) result.loops.push_back(transposed(std::move(loop)));
    return result;
  }
};

/// Moves loops by periods in u to the domain, and the seam to where none crosses it. False where there is no
/// such place.
bool fit_in_u(Layout& layout) {
  constexpr double kRounding = 1e-9;
  const double period = layout.topology.period_u;
  if (period == 0.0) return true;
  const double first = layout.surface.first_u();
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  std::vector<Box2> boxes;
  const auto largest_first = [](const Box2& a, const Box2& b) { return a.sizes().x() > b.sizes().x(); };
  for (const ParameterLoop& loop : layout.loops) boxes.push_back(box_of(loop.curves));
  if (boxes.empty()) return true;
  // The widest loop says where the window of one period lies, the others are moved into it.
  const Box2 widest = *std::min_element(boxes.begin(), boxes.end(), largest_first);
  const double window = widest.sizes().x() >= period * (1.0 - 1e-6) || widest.min().x() < first ||
                                widest.max().x() > first + period
                            ? widest.min().x()
                            : first;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double middle = boxes[i].center().x();
    const double by = -period * std::floor((middle - window) / period);
    if (by != 0.0) {
      for (NurbsCurve& curve : layout.loops[i].curves) curve = moved(std::move(curve), {by, 0.0});
    }
    low = std::min(low, boxes[i].min().x() + by);
    high = std::max(high, boxes[i].max().x() + by);
  }
  if (high - low > period * (1.0 + 1e-6)) return false;
  double shift = -period * std::floor((low - first) / period + kRounding);
  low += shift;
  high += shift;
  for (ParameterLoop& loop : layout.loops) {
    for (NurbsCurve& curve : loop.curves) curve = moved(std::move(curve), {shift, 0.0});
  }
  if (low > first + kRounding * period && high > first + period * (1.0 + kRounding)) {
    layout.surface = with_seam_at_u(layout.surface, low);
  }
  return true;
}

/// Whether each curve of the only loop runs along one side of the box, within the tolerance.
bool is_whole_box(const Layout& layout, const Box2& box, double tolerance) {
  if (layout.loops.size() != 1) return false;
  const NurbsSurface& surface = layout.surface;
  const auto step_length = [&surface](const Vector2& at, const Vector2& by) {
    const double u = std::clamp(at.x(), surface.first_u(), surface.last_u());
    const double v = std::clamp(at.y(), surface.first_v(), surface.last_v());
    const SurfaceDerivatives d = evaluate_derivatives(surface, u, v);
    return (by.x() * d.du + by.y() * d.dv).norm();
  };
  for (const NurbsCurve& curve : layout.loops.front().curves) {
    bool along_some_side = false;
    for (const int side : {0, 1, 2, 3}) {
      const Eigen::Index axis = side / 2;
      const double value = side % 2 == 0 ? box.min()[axis] : box.max()[axis];
      along_some_side =
          along_some_side ||
          std::all_of(curve.control_points.begin(), curve.control_points.end(), [&](const Vector4& p) {
            const Vector2 at = cartesian(p).head<2>();
            Vector2 by = Vector2::Zero();
            by[axis] = value - at[axis];
            return by[axis] == 0.0 ||
                   (std::abs(by[axis]) <= 1e-3 * box.sizes()[axis] && step_length(at, by) <= tolerance);
          });
    }
    if (!along_some_side) return false;
  }
  return true;
}

/// Turns each loop as the number of loops around it asks.
void orient(std::vector<ParameterLoop>& loops) {
  std::vector<Loop> polygons;
  polygons.reserve(loops.size());
  for (const ParameterLoop& loop : loops) polygons.push_back(loop_polygon(loop.curves));
  for (std::size_t i = 0; i < loops.size(); ++i) {
    std::size_t around = 0;
    for (std::size_t k = 0; k < loops.size(); ++k) {
      // Loops may touch: most of some points decide.
      if (k == i) continue;
      std::size_t inside = 0;
      const std::size_t step = std::max<std::size_t>(1, polygons[i].size() / 9);
      std::size_t asked = 0;
      for (std::size_t p = 0; p < polygons[i].size(); p += step, ++asked)
        inside += is_inside(polygons[k], polygons[i][p]) ? 1U : 0U;
      if (2 * inside > asked) ++around;
    }
    const bool should_be_counter_clockwise = around % 2 == 0;
    if ((signed_area(polygons[i]) > 0.0) != should_be_counter_clockwise) reverse(loops[i].curves);
  }
}

/// Loops may reach a little beyond the surface that they cut: straight pieces are brought back to its sides.
/// Of others the control points may lie outside while the curve does not: these stay.
void clamp_to_domain(std::vector<ParameterLoop>& loops, const NurbsSurface& surface) {
  for (ParameterLoop& loop : loops) {
    for (NurbsCurve& curve : loop.curves) {
      for (Vector4& point : curve.control_points) {
        const bool is_end = &point == &curve.control_points.front() || &point == &curve.control_points.back();
        if (curve.degree > 1 && !is_end) continue;
        const Vector2 at = cartesian(point).head<2>();
        point.x() = point.w() * std::clamp(at.x(), surface.first_u(), surface.last_u());
        point.y() = point.w() * std::clamp(at.y(), surface.first_v(), surface.last_v());
      }
    }
  }
}

/// Cuts the surface down to `box`, with the sides of the domain kept that are as near as rounding.
NurbsSurface cut_down(const NurbsSurface& surface, const Box2& box) {
  const auto part = [](double low, double high, double first, double last) {
    const double rounding = 1e-9 * (last - first);
    return std::pair{low < first + rounding ? first : low, high > last - rounding ? last : high};
  };
  const auto [first_u, last_u] = part(box.min().x(), box.max().x(), surface.first_u(), surface.last_u());
  const auto [first_v, last_v] = part(box.min().y(), box.max().y(), surface.first_v(), surface.last_v());
  if (!(first_u < last_u && first_v < last_v)) return surface;
  return restricted(surface, first_u, last_u, first_v, last_v);
}

}  // namespace

std::optional<TrimmedPatch> trimmed_patch(const NurbsSurface& surface, const SurfaceTopology& topology,
                                          std::vector<ParameterLoop> loops, bool whole_outside,
                                          double tolerance) {
  loops.erase(std::remove_if(loops.begin(), loops.end(),
                             [](const ParameterLoop& loop) { return loop.curves.empty(); }),
              loops.end());
  if (loops.empty()) return TrimmedPatch{surface, {}};
  const bool turns_in_v =
      std::any_of(loops.begin(), loops.end(), [](const ParameterLoop& l) { return l.turns_v != 0; });
  const bool turns_in_u =
      std::any_of(loops.begin(), loops.end(), [](const ParameterLoop& l) { return l.turns_u != 0; });
  if (turns_in_u && turns_in_v) return std::nullopt;

  Layout layout{surface, topology, std::move(loops)};
  if (turns_in_v) layout = std::move(layout).exchanged();
  if (turns_in_u || turns_in_v) {
    auto bounded = without_turns_in_u(layout.surface, layout.topology, std::move(layout.loops));
    if (!bounded) return std::nullopt;
    layout.loops = std::move(*bounded);
  }
  if (turns_in_v) layout = std::move(layout).exchanged();
  if (whole_outside) {
    const Vector2 a(surface.first_u(), surface.first_v());
    const Vector2 c(surface.last_u(), surface.last_v());
    const Vector2 b(c.x(), a.y());
    const Vector2 d(a.x(), c.y());
    layout.loops.push_back(
        {{parameter_line(a, b), parameter_line(b, c), parameter_line(c, d), parameter_line(d, a)}});
  }
  if (!fit_in_u(layout)) return std::nullopt;
  layout = std::move(layout).exchanged();
  if (!fit_in_u(layout)) return std::nullopt;
  layout = std::move(layout).exchanged();

  clamp_to_domain(layout.loops, layout.surface);
  Box2 box;
  for (const ParameterLoop& loop : layout.loops) box.extend(box_of(loop.curves));
  if (!(box.sizes().minCoeff() > 0.0)) return std::nullopt;
  const bool untrimmed = is_whole_box(layout, box, tolerance);
  TrimmedPatch patch;
  patch.nurbs = cut_down(layout.surface, box);
  if (untrimmed) return patch;
  orient(layout.loops);
  for (ParameterLoop& loop : layout.loops) patch.trim.push_back({std::move(loop.curves)});
  return patch;
}

}  // namespace lamina::engine
