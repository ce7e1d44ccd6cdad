#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/reverse.h"
#include "engine/nurbs/ruled.h"

namespace lamina::engine {
namespace {

constexpr int kEqualArcLength = 0;

/// Lengths from the start to points at equal steps of the parameter, by chords.
std::vector<double> chord_lengths(const NurbsCurve& curve, std::size_t steps) {
  std::vector<double> lengths{0.0};
  const double first = curve.first_parameter();
  const double range = curve.last_parameter() - first;
  Vector3 previous = evaluate(curve, first);
  for (std::size_t i = 1; i <= steps; ++i) {
    const Vector3 point =
        evaluate(curve, first + range * static_cast<double>(i) / static_cast<double>(steps));
    lengths.push_back(lengths.back() + (point - previous).norm());
    previous = point;
  }
  return lengths;
}

/// Diagonal of the box around the control points.
double control_size(const NurbsCurve& curve) {
  Box3 box;
  for (const Vector4& point : curve.control_points) box.extend(cartesian(point));
  return box.diagonal().norm();
}

/// How far equal parameters of two rails are from equal parts of their lengths, as a length on the longer
/// one.
double shift_between(const NurbsCurve& first, const NurbsCurve& second) {
  const bool both_straight = first.control_points.size() == 2 && second.control_points.size() == 2;
  const bool both_uniform = first.control_points.front().w() == first.control_points.back().w() &&
                            second.control_points.front().w() == second.control_points.back().w();
  if (both_straight && both_uniform) return 0.0;
  const std::size_t steps = std::min<std::size_t>(512, 8 * std::max(first.knots.size(), second.knots.size()));
  const std::vector<double> a = chord_lengths(first, steps);
  const std::vector<double> b = chord_lengths(second, steps);
  if (a.back() == 0.0 || b.back() == 0.0) return 0.0;  // all lines meet in one point
  double shift = 0.0;
  for (std::size_t i = 0; i <= steps; ++i)
    shift = std::max(shift, std::abs(a[i] / a.back() - b[i] / b.back()));
  return shift * std::max(a.back(), b.back());
}

}  // namespace

/// IGES 5.3, section 4.18: straight lines between two rails, at equal parts of their lengths (form 0) or of
/// their parameter ranges (form 1). The second rail is run through backwards where the direction flag says
/// so. Lines are always joined at equal NURBS parameter: for form 1 that is exact but between arcs and other
/// curves, for form 0 where the rails run alike; the shift along the rails is reported otherwise.
NurbsSurface read_ruled_surface_118(ParameterRecord& record, EntityReader& reader) {
  const NurbsCurve first = reader.curve(record, "first rail");
  NurbsCurve second = reader.curve(record, "second rail");
  if (record.integer_or(0, "direction flag") == 1) second = reversed(second);
  if (record.entry().form == kEqualArcLength) {
    const double shift = shift_between(first, second);
    const double size = std::max(control_size(first), control_size(second));
    if (shift > std::max(1e-6 * size, reader.same_point_distance(size))) {
      record.note(Tolerance::kRuledByParameter, fmt::format("shifted by up to {:.3g} file units", shift));
    }
  }
  const auto degree = static_cast<std::size_t>(std::max(first.degree, second.degree));
  reader.spend(record, 2 * degree * (first.control_points.size() + second.control_points.size()));
  return ruled_surface(first, second);
}

}  // namespace lamina::engine
