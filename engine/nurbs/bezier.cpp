#include "engine/nurbs/bezier.h"

#include <algorithm>
#include <cassert>

#include "engine/geometry/bspline_basis.h"
#include "engine/nurbs/curve.h"
#include "engine/nurbs/knot_insertion.h"

namespace lamina::engine {
namespace {

/// What must be inserted so that every inner knot has the multiplicity of the degree.
std::vector<double> knots_to_full_multiplicity(const Knots& knots, int degree) {
  std::vector<double> inserted;
  const std::vector<double> breaks = break_points(knots, degree);
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    for (auto k = std::count(knots.begin(), knots.end(), breaks[i]); k < degree; ++k)
      inserted.push_back(breaks[i]);
  }
  return inserted;
}

/// For each non-zero span the index of its first control point, once every inner knot has at least full
/// multiplicity. A knot repeated more often than that (a break in the surface) moves the next start on.
std::vector<std::size_t> first_control_points(const Knots& knots, int degree) {
  std::vector<std::size_t> firsts;
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t span = p; span + p + 1 < knots.size(); ++span) {
    if (knots[span] < knots[span + 1]) firsts.push_back(span - p);
  }
  return firsts;
}

BezierPatch cut(const NurbsSurface& surface, std::size_t first_u, std::size_t first_v) {
  BezierPatch patch;
  patch.degree_u = surface.degree_u;
  patch.degree_v = surface.degree_v;
  patch.net.count_u = static_cast<std::size_t>(surface.degree_u) + 1;
  patch.net.count_v = static_cast<std::size_t>(surface.degree_v) + 1;
  patch.net.points.reserve(patch.net.count_u * patch.net.count_v);
  for (std::size_t i = 0; i < patch.net.count_u; ++i) {
    for (std::size_t j = 0; j < patch.net.count_v; ++j) {
      patch.net.points.push_back(surface.net.at(first_u + i, first_v + j));
    }
  }
  return patch;
}

/// de Casteljau at 1/2 along one line of control points, `stride` apart from `start`.
void halve_line(ControlNet& low, ControlNet& high, std::size_t start, std::size_t stride, std::size_t count) {
  for (std::size_t level = 0; level < count; ++level) {
    high.points[start + (count - 1 - level) * stride] = low.points[start + (count - 1) * stride];
    for (std::size_t k = count - 1; k > level; --k) {
      low.points[start + k * stride] =
          0.5 * (low.points[start + k * stride] + low.points[start + (k - 1) * stride]);
    }
  }
}

}  // namespace

Vector3 evaluate(const BezierPatch& patch, double u, double v) {
  const std::vector<double> basis_u = bernstein(patch.degree_u, u);
  const std::vector<double> basis_v = bernstein(patch.degree_v, v);
  Vector4 sum = Vector4::Zero();
  for (std::size_t i = 0; i < basis_u.size(); ++i) {
    for (std::size_t j = 0; j < basis_v.size(); ++j) sum += basis_u[i] * basis_v[j] * patch.net.at(i, j);
  }
  return cartesian(sum);
}

std::vector<BezierPatch> bezier_patches(const NurbsSurface& surface) {
  const NurbsSurface full =
      insert_knots(surface, knots_to_full_multiplicity(surface.knots_u, surface.degree_u),
                   knots_to_full_multiplicity(surface.knots_v, surface.degree_v));
  const auto firsts_u = first_control_points(full.knots_u, full.degree_u);
  const auto firsts_v = first_control_points(full.knots_v, full.degree_v);
  std::vector<BezierPatch> patches;
  patches.reserve(firsts_u.size() * firsts_v.size());
  for (const std::size_t first_u : firsts_u) {
    for (const std::size_t first_v : firsts_v) patches.push_back(cut(full, first_u, first_v));
  }
  return patches;
}

std::pair<BezierPatch, BezierPatch> halves_in_u(const BezierPatch& patch) {
  std::pair<BezierPatch, BezierPatch> halves{patch, patch};
  for (std::size_t j = 0; j < patch.net.count_v; ++j) {
    halve_line(halves.first.net, halves.second.net, j, patch.net.count_v, patch.net.count_u);
  }
  return halves;
}

std::pair<BezierPatch, BezierPatch> halves_in_v(const BezierPatch& patch) {
  std::pair<BezierPatch, BezierPatch> halves{patch, patch};
  for (std::size_t i = 0; i < patch.net.count_u; ++i) {
    halve_line(halves.first.net, halves.second.net, i * patch.net.count_v, 1, patch.net.count_v);
  }
  return halves;
}

}  // namespace lamina::engine
