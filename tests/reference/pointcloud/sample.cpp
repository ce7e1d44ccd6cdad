#include "tests/reference/pointcloud/sample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/bspline_basis.h"
#include "engine/nurbs/curve.h"
#include "tests/reference/pointcloud/decompose.h"

namespace lamina::reference {
namespace {

/// A quad is never quartered more often than this: by then its parameters are closer than doubles can tell
/// well, and only a surface that is torn apart at one parameter gets there.
constexpr int kDeepestQuad = 40;

struct ParametricQuad {
  double u0, u1, v0, v1;
  Vector3 p00, p10, p01, p11;  ///< points at (u0, v0), (u1, v0), (u0, v1), (u1, v1)
};

bool within(const ParametricQuad& quad, double epsilon) {
  const double limit = epsilon * epsilon;
  return (quad.p00 - quad.p10).squaredNorm() <= limit && (quad.p00 - quad.p01).squaredNorm() <= limit &&
         (quad.p11 - quad.p10).squaredNorm() <= limit && (quad.p11 - quad.p01).squaredNorm() <= limit &&
         (quad.p00 - quad.p11).squaredNorm() <= limit && (quad.p10 - quad.p01).squaredNorm() <= limit;
}

void quarter(const BezierPatch& patch, const ParametricQuad& quad, double epsilon, int depth,
             std::vector<Vector3>& points) {
  if (within(quad, epsilon) || depth == kDeepestQuad) return;
  const double u = 0.5 * (quad.u0 + quad.u1);
  const double v = 0.5 * (quad.v0 + quad.v1);
  const Vector3 bottom = evaluate(patch, u, quad.v0);
  const Vector3 top = evaluate(patch, u, quad.v1);
  const Vector3 left = evaluate(patch, quad.u0, v);
  const Vector3 right = evaluate(patch, quad.u1, v);
  const Vector3 middle = evaluate(patch, u, v);
  points.insert(points.end(), {bottom, top, left, right, middle});
  quarter(patch, {quad.u0, u, quad.v0, v, quad.p00, bottom, left, middle}, epsilon, depth + 1, points);
  quarter(patch, {u, quad.u1, quad.v0, v, bottom, quad.p10, middle, right}, epsilon, depth + 1, points);
  quarter(patch, {quad.u0, u, v, quad.v1, left, middle, quad.p01, top}, epsilon, depth + 1, points);
  quarter(patch, {u, quad.u1, v, quad.v1, middle, right, top, quad.p11}, epsilon, depth + 1, points);
}

std::size_t intervals(double extent, const SampleOptions& options) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(extent * options.oversampling / options.epsilon)));
}

/// Bernstein values at count + 1 even parameters: one row per parameter.
std::vector<std::vector<double>> bernstein_table(int degree, std::size_t count) {
  std::vector<std::vector<double>> table;
  table.reserve(count + 1);
  for (std::size_t k = 0; k <= count; ++k) {
    table.push_back(bernstein(degree, static_cast<double>(k) / static_cast<double>(count)));
  }
  return table;
}

/// Points on the even grid, v fastest. The grid structure saves work: the net is blended along u once per
/// grid row.
std::vector<Vector3> sample_grid(const BezierPatch& patch, std::size_t count_u, std::size_t count_v) {
  const auto table_u = bernstein_table(patch.degree_u, count_u);
  const auto table_v = bernstein_table(patch.degree_v, count_v);
  std::vector<Vector3> points;
  points.reserve((count_u + 1) * (count_v + 1));
  std::vector<Vector4> row(patch.net.count_v);
  for (const std::vector<double>& basis_u : table_u) {
    for (std::size_t j = 0; j < row.size(); ++j) {
      row[j] = basis_u[0] * patch.net.at(0, j);
      for (std::size_t i = 1; i < basis_u.size(); ++i) row[j] += basis_u[i] * patch.net.at(i, j);
    }
    for (const std::vector<double>& basis_v : table_v) {
      Vector4 sum = basis_v[0] * row[0];
      for (std::size_t j = 1; j < row.size(); ++j) sum += basis_v[j] * row[j];
      points.push_back(cartesian(sum));
    }
  }
  return points;
}

}  // namespace

std::vector<Vector3> sample(const BezierPatch& patch, const SampleOptions& options) {
  const Extent extent = net_extent(patch.net);
  const std::size_t count_u = intervals(extent.u, options);
  const std::size_t count_v = intervals(extent.v, options);
  std::vector<Vector3> points = sample_grid(patch, count_u, count_v);
  const auto parameter = [](std::size_t k, std::size_t count) {
    return static_cast<double>(k) / static_cast<double>(count);
  };
  for (std::size_t i = 0; i < count_u; ++i) {
    for (std::size_t j = 0; j < count_v; ++j) {
      const std::size_t corner = i * (count_v + 1) + j;
      const ParametricQuad quad{parameter(i, count_u), parameter(i + 1, count_u),
                                parameter(j, count_v), parameter(j + 1, count_v),
                                points[corner],        points[corner + count_v + 1],
                                points[corner + 1],    points[corner + count_v + 2]};
      quarter(patch, quad, options.epsilon, 0, points);
    }
  }
  return points;
}

}  // namespace lamina::reference
