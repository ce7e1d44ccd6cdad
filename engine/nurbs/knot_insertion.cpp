#include "engine/nurbs/knot_insertion.h"

#include <algorithm>
#include <cassert>

namespace lamina::engine {
namespace {

/// Inserts `knot`, which lies in the domain, once: the row of control points grows by one (Boehm; The NURBS
/// Book, equation 5.15).
void insert_once(Knots& knots, int degree, std::vector<Vector4>& row, double knot) {
  const auto p = static_cast<std::size_t>(degree);
  const auto after =
      static_cast<std::size_t>(std::upper_bound(knots.begin(), knots.end(), knot) - knots.begin());
  assert(after < knots.size());  // else the end had full multiplicity already
  const std::size_t span = after - 1;
  std::vector<Vector4> grown;
  grown.reserve(row.size() + 1);
  for (std::size_t i = 0; i <= row.size(); ++i) {
    if (i + p <= span) {
      grown.push_back(row[i]);
    } else if (knots[i] >= knot) {
      grown.push_back(row[i - 1]);
    } else {
      const double ratio = (knot - knots[i]) / (knots[i + p] - knots[i]);
      grown.emplace_back(ratio * row[i] + (1.0 - ratio) * row[i - 1]);
    }
  }
  row = std::move(grown);
  knots.insert(knots.begin() + static_cast<std::ptrdiff_t>(after), knot);
}

/// The knots missing for multiplicity degree + 1 at both ends of the domain.
std::vector<double> missing_end_knots(const Knots& knots, int degree) {
  const double first = knots[static_cast<std::size_t>(degree)];
  const double last = knots[knots.size() - 1 - static_cast<std::size_t>(degree)];
  std::vector<double> missing;
  for (const double end : {first, last}) {
    const auto present = std::count(knots.begin(), knots.end(), end);
    for (auto k = present; k < degree + 1; ++k) missing.push_back(end);
  }
  return missing;
}

NurbsSurface insert_knots_u(const NurbsSurface& surface, const std::vector<double>& inserted) {
  if (inserted.empty()) return surface;
  // Columns share the knot vector: each is a curve along u.
  NurbsSurface result = surface;
  result.net.count_u = surface.net.count_u + inserted.size();
  result.net.points.assign(result.net.count_u * surface.net.count_v, Vector4::Zero());
  for (std::size_t j = 0; j < surface.net.count_v; ++j) {
    NurbsCurve column{surface.degree_u, surface.knots_u, {}};
    column.control_points.reserve(result.net.count_u);
    for (std::size_t i = 0; i < surface.net.count_u; ++i)
      column.control_points.push_back(surface.net.at(i, j));
    column = insert_knots(column, inserted);
    for (std::size_t i = 0; i < result.net.count_u; ++i) result.net.at(i, j) = column.control_points[i];
    result.knots_u = std::move(column.knots);
  }
  return result;
}

/// Cuts what lies outside the domain once the ends have full multiplicity.
NurbsCurve trimmed_to_domain(const NurbsCurve& curve) {
  const double first = curve.first_parameter();
  const double last = curve.last_parameter();
  const auto begin = std::lower_bound(curve.knots.begin(), curve.knots.end(), first);
  const auto end = std::upper_bound(curve.knots.begin(), curve.knots.end(), last);
  // More than degree + 1 repeats carry no shape: keep the inner ones.
  const auto repeats = [](auto from, auto to, double value) { return std::count(from, to, value); };
  const auto order = curve.degree + 1;
  const auto kept_begin = begin + (repeats(begin, end, first) - order);
  const auto kept_end = end - (repeats(begin, end, last) - order);
  NurbsCurve result;
  result.degree = curve.degree;
  result.knots.assign(kept_begin, kept_end);
  const auto offset = kept_begin - curve.knots.begin();
  const auto count = static_cast<std::ptrdiff_t>(result.knots.size()) - order;
  result.control_points.assign(curve.control_points.begin() + offset,
                               curve.control_points.begin() + offset + count);
  return result;
}

NurbsSurface clamped_u(const NurbsSurface& surface) {
  NurbsSurface result = surface;
  std::vector<std::vector<Vector4>> columns;
  for (std::size_t j = 0; j < surface.net.count_v; ++j) {
    NurbsCurve column{surface.degree_u, surface.knots_u, {}};
    for (std::size_t i = 0; i < surface.net.count_u; ++i)
      column.control_points.push_back(surface.net.at(i, j));
    column = clamped(column);
    result.knots_u = column.knots;
    columns.push_back(std::move(column.control_points));
  }
  result.net.count_u = columns.front().size();
  result.net.points.clear();
  for (std::size_t i = 0; i < result.net.count_u; ++i) {
    for (const auto& column : columns) result.net.points.push_back(column[i]);
  }
  return result;
}

}  // namespace

NurbsCurve insert_knots(const NurbsCurve& curve, const std::vector<double>& inserted) {
  assert(std::is_sorted(inserted.begin(), inserted.end()));
  NurbsCurve result = curve;
  for (const double knot : inserted) insert_once(result.knots, result.degree, result.control_points, knot);
  return result;
}

NurbsSurface insert_knots(const NurbsSurface& surface, const std::vector<double>& inserted_u,
                          const std::vector<double>& inserted_v) {
  const NurbsSurface in_u = insert_knots_u(surface, inserted_u);
  if (inserted_v.empty()) return in_u;
  return transposed(insert_knots_u(transposed(in_u), inserted_v));
}

NurbsCurve clamped(const NurbsCurve& curve) {
  return trimmed_to_domain(insert_knots(curve, missing_end_knots(curve.knots, curve.degree)));
}

NurbsSurface clamped(const NurbsSurface& surface) {
  return transposed(clamped_u(transposed(clamped_u(surface))));
}

}  // namespace lamina::engine
