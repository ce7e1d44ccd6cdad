#include "engine/import/iges/analytic_axis.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/revolution.h"

namespace lamina::engine {

AnalyticFrame analytic_frame(ParameterRecord& record, EntityReader& reader, const Vector3& origin,
                             const Vector3& axis) {
  constexpr int kParametrised = 1;
  AnalyticFrame frame{origin, axis, axis.unitOrthogonal()};
  if (record.entry().form != kParametrised || record.at_end()) return frame;
  const Vector3 given = reader.direction(record, "reference direction");
  const Vector3 across = given - given.dot(axis) * axis;
  if (across.norm() > 1e-6) frame.reference = across.normalized();
  return frame;
}

AxisRange range_along(const AnalyticFrame& frame, const std::vector<Vector3>& cover) {
  if (cover.empty()) return {};
  AxisRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vector3& point : cover) {
    const double height = frame.axis.dot(point - frame.origin);
    range.first = std::min(range.first, height);
    range.last = std::max(range.last, height);
  }
  const double length = range.last - range.first;
  const double room = length > 0.0 ? 0.01 * length : 1.0;
  return {range.first - room, range.last + room};
}

NurbsSurface turned_line(const AnalyticFrame& frame, const AxisRange& range, double first_radius,
                         double last_radius) {
  const Vector3 start = frame.origin + range.first * frame.axis + first_radius * frame.reference;
  const Vector3 end = frame.origin + range.last * frame.axis + last_radius * frame.reference;
  const NurbsCurve line{
      1, {range.first, range.first, range.last, range.last}, {homogeneous(start), homogeneous(end)}};
  return transposed(surface_of_revolution(line, frame.origin, frame.axis, 0.0, 2.0 * std::numbers::pi));
}

}  // namespace lamina::engine
