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

/// Coefficients of 1, s, s^2, s^3, s counted from the start of the segment.
using Segment = std::array<Vector3, kCoefficients>;

Segment read_segment(ParameterRecord& record) {
  Segment segment;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (Vector3& coefficient : segment) coefficient[axis] = record.real("coefficient");
  }
  return segment;
}

/// The highest power that occurs, at least 1.
std::size_t degree_of(const std::vector<Segment>& segments) {
  std::size_t degree = 1;
  for (const Segment& segment : segments) {
    for (std::size_t k = degree + 1; k < kCoefficients; ++k) {
      if (!segment[k].isZero(0.0)) degree = k;
    }
  }
  return degree;
}

}  // namespace

/// IGES 5.3, section 4.14: piecewise polynomials of at most the third degree, one per interval between break
/// points. The spline type says only how they came about. The derivatives at the end, which follow, repeat
/// what is known.
NurbsCurve read_parametric_spline_curve_112(ParameterRecord& record, EntityReader& reader) {
  record.skip(3);  // spline type, continuity, dimension
  const std::size_t count = record.count(1, "number of segments");
  record.require(count * 3 * kCoefficients, "number of segments");
  const std::vector<double> breaks = read_break_points(record, count, "break point");
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < count; ++i) segments.push_back(read_segment(record));

  const std::size_t degree = degree_of(segments);
  NurbsCurve curve;
  curve.degree = static_cast<int>(degree);
  curve.knots = bezier_knots(breaks, degree);
  Box3 box;
  double largest_gap = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto coefficients = segments[i].begin();
    const auto points = bezier_from_power(
        {coefficients, coefficients + static_cast<std::ptrdiff_t>(degree) + 1}, breaks[i + 1] - breaks[i]);
    for (std::size_t k = 0; k < points.size(); ++k) {
      box.extend(points[k]);
      if (k > 0 || i == 0) {
        curve.control_points.push_back(homogeneous(points[k]));
      } else {
        Vector4& joint = curve.control_points.back();
        largest_gap = std::max(largest_gap, (cartesian(joint) - points[k]).norm());
        joint = 0.5 * (joint + homogeneous(points[k]));
      }
    }
  }
  reader.check_gap(record, "segments", largest_gap, box.diagonal().norm());
  return curve;
}

}  // namespace lamina::engine
