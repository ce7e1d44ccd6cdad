#pragma once

#include "engine/geometry/vector.h"
#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

/// One reader per entity type, each in the file of its name. A reader takes the parameters from the record
/// and gives the curve or surface in the entity's own definition space, file units, clamped; whoever calls it
/// applies the transformation of the directory entry. All throw ImportError.
namespace lamina::engine {

class EntityReader;
class ParameterRecord;

NurbsCurve read_circular_arc_100(ParameterRecord& record, EntityReader& reader);
NurbsCurve read_composite_curve_102(ParameterRecord& record, EntityReader& reader);
NurbsCurve read_conic_arc_104(ParameterRecord& record, EntityReader& reader);
NurbsCurve read_line_110(ParameterRecord& record, EntityReader& reader);
NurbsCurve read_parametric_spline_curve_112(ParameterRecord& record, EntityReader& reader);
NurbsCurve read_point_116(ParameterRecord& record, EntityReader& reader);
NurbsCurve read_rational_bspline_curve_126(ParameterRecord& record, EntityReader& reader);

Eigen::Affine3d read_transformation_matrix_124(ParameterRecord& record);

NurbsSurface read_parametric_spline_surface_114(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_ruled_surface_118(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_surface_of_revolution_120(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_rational_bspline_surface_128(ParameterRecord& record, EntityReader& reader);

}  // namespace lamina::engine
