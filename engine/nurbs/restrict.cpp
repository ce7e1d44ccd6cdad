#include "engine/nurbs/restrict.h"

#include <algorithm>
#include <cassert>

#include "engine/nurbs/knot_insertion.h"

namespace lamina::engine {
namespace {

bool is_clamped(const Knots& knots, int degree) {
  const auto p = static_cast<std::size_t>(degree);
  return knots.front() == knots[p] && knots.back() == knots[knots.size() - 1 - p];
}

/// What must be inserted so that `ends` have the multiplicity of the degree.
std::vector<double> missing_knots(const Knots& knots, int degree, std::initializer_list<double> ends) {
  std::vector<double> missing;
  for (const double end : ends) {
    for (auto k = std::count(knots.begin(), knots.end(), end); k < degree; ++k) missing.push_back(end);
  }
  return missing;
}

NurbsSurface restricted_u(const NurbsSurface& surface, double first, double last) {
  if (is_clamped(surface.knots_u, surface.degree_u) && first == surface.first_u() &&
      last == surface.last_u()) {
    return surface;
  }
  NurbsSurface result = surface;
  std::vector<NurbsCurve> columns;
  for (std::size_t j = 0; j < surface.net.count_v; ++j) {
    NurbsCurve column{surface.degree_u, surface.knots_u, {}};
    for (std::size_t i = 0; i < surface.net.count_u; ++i)
      column.control_points.push_back(surface.net.at(i, j));
    columns.push_back(restricted(column, first, last));
  }
  result.knots_u = columns.front().knots;
  result.net.count_u = columns.front().control_points.size();
  result.net.points.clear();
  for (std::size_t i = 0; i < result.net.count_u; ++i) {
    for (const NurbsCurve& column : columns) result.net.points.push_back(column.control_points[i]);
  }
  return result;
}

}  // namespace

NurbsCurve restricted(const NurbsCurve& curve, double first, double last) {
  assert(curve.first_parameter() <= first && first < last && last <= curve.last_parameter());
  const NurbsCurve whole = is_clamped(curve.knots, curve.degree) ? curve : clamped(curve);
  if (first == whole.first_parameter() && last == whole.last_parameter()) return whole;
  const NurbsCurve cut = insert_knots(whole, missing_knots(whole.knots, whole.degree, {first, last}));
  const auto p = static_cast<std::ptrdiff_t>(curve.degree);
  // The last p repeats of `first` and the first p of `last`, one more at each end.
  const auto begin = std::upper_bound(cut.knots.begin(), cut.knots.end(), first) - p;
  const auto end = std::lower_bound(cut.knots.begin(), cut.knots.end(), last) + p;
  NurbsCurve result;
  result.degree = curve.degree;
  result.knots.push_back(first);
  result.knots.insert(result.knots.end(), begin, end);
  result.knots.push_back(last);
  const auto count = (end - begin) + 2 - p - 1;
  const auto offset = cut.control_points.begin() + (begin - cut.knots.begin() - 1);
  result.control_points.assign(offset, offset + count);
  return result;
}

NurbsSurface restricted(const NurbsSurface& surface, double first_u, double last_u, double first_v,
                        double last_v) {
  const NurbsSurface in_u = restricted_u(surface, first_u, last_u);
  if (is_clamped(in_u.knots_v, in_u.degree_v) && first_v == in_u.first_v() && last_v == in_u.last_v())
    return in_u;
  return transposed(restricted_u(transposed(in_u), first_v, last_v));
}

}  // namespace lamina::engine
