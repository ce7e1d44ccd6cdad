#include <vector>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/knot_vector.h"
#include "engine/nurbs/restrict.h"

namespace lamina::engine {

/// IGES 5.3, section 4.24. The flags (closed, polynomial, periodic) repeat what the numbers say.
NurbsSurface read_rational_bspline_surface_128(ParameterRecord& record, EntityReader&) {
  const std::size_t count_u = record.count(1, "upper index of control points in u") + 1;
  const std::size_t count_v = record.count(1, "upper index of control points in v") + 1;
  NurbsSurface surface;
  surface.degree_u = read_degree(record, count_u, "degree in u");
  surface.degree_v = read_degree(record, count_v, "degree in v");
  record.skip(5);  // flags
  // Across a knot of multiplicity degree + 1 a surface may break in two: it is cut there anyway.
  surface.knots_u = read_knots(record, count_u, surface.degree_u, surface.degree_u + 1, "u knot");
  surface.knots_v = read_knots(record, count_v, surface.degree_v, surface.degree_v + 1, "v knot");
  const std::size_t count = count_u * count_v;  // no overflow: both are below the number of the file's bytes
  record.require(count, "control points");
  record.require(4 * count, "control points");

  surface.net.count_u = count_u;
  surface.net.count_v = count_v;
  surface.net.points.resize(count);
  for (std::size_t j = 0; j < count_v; ++j) {  // the file runs fastest along u
    for (std::size_t i = 0; i < count_u; ++i) surface.net.at(i, j).w() = read_weight(record);
  }
  for (std::size_t j = 0; j < count_v; ++j) {
    for (std::size_t i = 0; i < count_u; ++i) {
      Vector4& point = surface.net.at(i, j);
      point = homogeneous(record.vector("control point"), point.w());
    }
  }
  const ParameterRange u = read_parameter_range(record, surface.knots_u, surface.degree_u);
  const ParameterRange v = read_parameter_range(record, surface.knots_v, surface.degree_v);
  return restricted(surface, u.first, u.last, v.first, v.last);
}

}  // namespace lamina::engine
