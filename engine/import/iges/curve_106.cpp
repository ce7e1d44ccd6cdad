#include <cmath>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.6: points, here as the straight line through them all, on [0, number of pieces]. Form
/// 63 closes on its first point.
NurbsCurve read_copious_data_106(ParameterRecord& record, EntityReader&) {
  constexpr int kPlanar = 1;
  constexpr int kWithVectors = 3;
  constexpr int kClosedForm = 63;
  const int kind = record.integer("interpretation flag");
  if (kind < kPlanar || kind > kWithVectors) record.fail("the interpretation flag must be 1, 2 or 3");
  const std::size_t count = record.count(2, "number of points");
  const double plane = kind == kPlanar ? record.real("plane") : 0.0;
  record.require(count * (kind == kPlanar ? 2 : 3), "points");
  NurbsCurve curve;
  for (std::size_t i = 0; i < count; ++i) {
    Vector3 point(0.0, 0.0, plane);
    if (kind == kPlanar) {
      point.head<2>() = record.planar_vector("point");
    } else {
      point = record.vector("point");
      if (kind == kWithVectors) record.skip(3);
    }
    curve.control_points.push_back(homogeneous(point));
  }
  if (record.entry().form == kClosedForm && curve.control_points.front() != curve.control_points.back())
    curve.control_points.push_back(curve.control_points.front());
  curve.knots.push_back(0.0);
  for (std::size_t i = 0; i < curve.control_points.size(); ++i) curve.knots.push_back(static_cast<double>(i));
  curve.knots.push_back(curve.knots.back());
  return curve;
}

}  // namespace lamina::engine
