#include <vector>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/knot_vector.h"
#include "engine/nurbs/restrict.h"

namespace lamina::engine {

/// IGES 5.3, section 4.23. The flags (planar, closed, polynomial, periodic) repeat what the numbers say.
NurbsCurve read_rational_bspline_curve_126(ParameterRecord& record, EntityReader&) {
  const std::size_t count = record.count(1, "upper index of control points") + 1;
  NurbsCurve curve;
  curve.degree = read_degree(record, count, "degree");
  record.skip(4);  // flags
  curve.knots = read_knots(record, count, curve.degree, curve.degree, "knot");
  record.require(4 * count, "control points");
  std::vector<double> weights;
  weights.reserve(count);
  for (std::size_t i = 0; i < count; ++i) weights.push_back(read_weight(record));
  curve.control_points.reserve(count);
  for (const double weight : weights) {
    curve.control_points.push_back(homogeneous(record.vector("control point"), weight));
  }
  const ParameterRange range = read_parameter_range(record, curve.knots, curve.degree);
  return restricted(curve, range.first, range.last);
}

}  // namespace lamina::engine
