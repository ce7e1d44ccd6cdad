#include <algorithm>
#include <array>
#include <vector>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/spline_breaks.h"
#include "engine/nurbs/power_basis.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kCoefficients = 4;
constexpr std::size_t kValuesPerPatch = 3 * kCoefficients * kCoefficients;

/// Coefficient [l][k] of s^k t^l, s and t counted from the lower corner of the patch.
using Patch = std::array<std::array<Vector3, kCoefficients>, kCoefficients>;

Patch read_patch(ParameterRecord& record) {
  Patch patch;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (auto& power_of_t : patch) {
      for (Vector3& coefficient : power_of_t) coefficient[axis] = record.real("coefficient");
    }
  }
  return patch;
}

/// Highest powers that occur, at least 1.
struct Degrees {
  std::size_t u = 1;
  std::size_t v = 1;
};

Degrees degrees_of(const std::vector<Patch>& patches) {
  Degrees degrees;
  for (const Patch& patch : patches) {
    for (std::size_t l = 0; l < kCoefficients; ++l) {
      for (std::size_t k = 0; k < kCoefficients; ++k) {
        if (patch[l][k].isZero(0.0)) continue;
        degrees.u = std::max(degrees.u, k);
        degrees.v = std::max(degrees.v, l);
      }
    }
  }
  return degrees;
}

/// Bezier points of a patch, [i][j] with i along u.
std::vector<std::vector<Vector3>> bezier_points(const Patch& patch, Degrees degrees, double length_u,
                                                double length_v) {
  std::vector<std::vector<Vector3>> along_v(degrees.u + 1);  // [k][j]: powers of s, Bezier points in t
  for (std::size_t k = 0; k <= degrees.u; ++k) {
    std::vector<Vector3> coefficients;
    for (std::size_t l = 0; l <= degrees.v; ++l) coefficients.push_back(patch[l][k]);
    along_v[k] = bezier_from_power(coefficients, length_v);
  }
  std::vector<std::vector<Vector3>> points(degrees.u + 1, std::vector<Vector3>(degrees.v + 1));
  for (std::size_t j = 0; j <= degrees.v; ++j) {
    std::vector<Vector3> coefficients;
    for (std::size_t k = 0; k <= degrees.u; ++k) coefficients.push_back(along_v[k][j]);
    const std::vector<Vector3> column = bezier_from_power(coefficients, length_u);
    for (std::size_t i = 0; i <= degrees.u; ++i) points[i][j] = column[i];
  }
  return points;
}

}  // namespace

/// IGES 5.3, section 4.15: a grid of bicubic patches. The list of patches holds one more in each direction
/// than there are; those beyond the last are fill and are passed over. The spline and patch types say only
/// how they came about.
NurbsSurface read_parametric_spline_surface_114(ParameterRecord& record, EntityReader& reader) {
  record.skip(2);  // spline type, patch type
  const std::size_t count_u = record.count(1, "number of patches in u");
  const std::size_t count_v = record.count(1, "number of patches in v");
  record.require(count_u * count_v,
                 "numbers of patches");  // neither product overflows: both counts are of this file
  record.require(count_u * count_v * kValuesPerPatch, "numbers of patches");
  const std::vector<double> breaks_u = read_break_points(record, count_u, "u break point");
  const std::vector<double> breaks_v = read_break_points(record, count_v, "v break point");
  std::vector<Patch> patches;  // v fastest
  for (std::size_t i = 0; i < count_u; ++i) {
    for (std::size_t j = 0; j < count_v; ++j) patches.push_back(read_patch(record));
    if (i + 1 < count_u) record.skip(kValuesPerPatch);
  }

  const Degrees degrees = degrees_of(patches);
  NurbsSurface surface;
  surface.degree_u = static_cast<int>(degrees.u);
  surface.degree_v = static_cast<int>(degrees.v);
  surface.knots_u = bezier_knots(breaks_u, degrees.u);
  surface.knots_v = bezier_knots(breaks_v, degrees.v);
  surface.net.count_u = count_u * degrees.u + 1;
  surface.net.count_v = count_v * degrees.v + 1;
  // Points on a border belong to two or four patches: their mean is taken.
  surface.net.points.assign(surface.net.count_u * surface.net.count_v, Vector4::Zero());
  Box3 box;
  double largest_gap = 0.0;
  for (std::size_t i = 0; i < count_u; ++i) {
    for (std::size_t j = 0; j < count_v; ++j) {
      const auto points = bezier_points(patches[i * count_v + j], degrees, breaks_u[i + 1] - breaks_u[i],
                                        breaks_v[j + 1] - breaks_v[j]);
      for (std::size_t k = 0; k <= degrees.u; ++k) {
        for (std::size_t l = 0; l <= degrees.v; ++l) {
          Vector4& sum = surface.net.at(i * degrees.u + k, j * degrees.v + l);
          if (sum.w() > 0.0) largest_gap = std::max(largest_gap, (cartesian(sum) - points[k][l]).norm());
          sum += homogeneous(points[k][l]);
          box.extend(points[k][l]);
        }
      }
    }
  }
  for (Vector4& sum : surface.net.points) sum /= sum.w();
  reader.check_gap(record, "patches", largest_gap, box.diagonal().norm());
  return surface;
}

}  // namespace lamina::engine
