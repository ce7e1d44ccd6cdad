#include <algorithm>

#include <fmt/format.h>

#include "engine/import/iges/cubic_fit.h"
#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/restrict.h"

namespace lamina::engine {
namespace {

constexpr int kConstant = 1;
constexpr int kLinear = 2;
constexpr int kByParameter = 2;
constexpr std::size_t kMostPoints = 4096;

/// Direction of travel by points close by, which corners and straight pieces bear as well.
Vector3 tangent(const NurbsCurve& curve, double t) {
  const double step = 1e-6 * (curve.last_parameter() - curve.first_parameter());
  const double before = std::max(t - step, curve.first_parameter());
  const double after = std::min(t + step, curve.last_parameter());
  return (evaluate(curve, after) - evaluate(curve, before)).normalized();
}

}  // namespace

/// IGES 5.3, section 4.25: a plane curve moved to its side, by the same distance everywhere or by one that
/// grows evenly with the parameter. Approximated.
NurbsCurve read_offset_curve_130(ParameterRecord& record, EntityReader& reader) {
  const NurbsCurve base = reader.curve(record, "base curve");
  const int kind = record.integer("offset flag");
  record.skip(2);  // a curve that gives the distance, its coordinate
  const int taper = record.integer_or(0, "taper flag");
  if (kind != kConstant && !(kind == kLinear && taper == kByParameter))
    record.fail("only offsets of one distance, or linear in the parameter, can be read");
  const double first_distance = record.real_or(0.0, "distance");
  const double first_at = record.real_or(base.first_parameter(), "parameter");
  const double second_distance = record.real_or(first_distance, "distance");
  const double second_at = record.real_or(base.last_parameter(), "parameter");
  const Vector3 normal = record.vector("normal");
  if (!(normal.norm() > 0.0)) record.fail("the normal has no length");
  double first = record.real_or(base.first_parameter(), "start parameter");
  double last = record.real_or(base.last_parameter(), "end parameter");
  if (!(first < last)) {
    first = base.first_parameter();
    last = base.last_parameter();
  }
  const NurbsCurve piece =
      restricted(base, std::max(first, base.first_parameter()), std::min(last, base.last_parameter()));
  const auto distance_at = [&](double t) {
    if (kind == kConstant || !(second_at > first_at)) return first_distance;
    return first_distance + (second_distance - first_distance) * (t - first_at) / (second_at - first_at);
  };
  const auto point = [&](double t) {
    return Vector3(evaluate(piece, t) + distance_at(t) * normal.normalized().cross(tangent(piece, t)));
  };
  Box3 box;
  for (const Vector4& p : piece.control_points) box.extend(cartesian(p));
  const double size = box.diagonal().norm();
  const CubicFit<NurbsCurve> fit =
      fit_cubics(point, break_points(piece.knots, piece.degree), reader.trim_tolerance(size), kMostPoints);
  record.note(Tolerance::kOffsetApproximated, fmt::format("within {:.2g} file units", fit.error));
  return fit.fitted;
}

}  // namespace lamina::engine
