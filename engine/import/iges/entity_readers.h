#pragma once

#include <vector>

#include "engine/geometry/vector.h"
#include "engine/import/trim/trimmed_patch.h"
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
NurbsCurve read_copious_data_106(ParameterRecord& record, EntityReader& reader);
NurbsCurve read_offset_curve_130(ParameterRecord& record, EntityReader& reader);

Eigen::Affine3d read_transformation_matrix_124(ParameterRecord& record);

NurbsSurface read_parametric_spline_surface_114(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_ruled_surface_118(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_surface_of_revolution_120(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_tabulated_cylinder_122(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_rational_bspline_surface_128(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_offset_surface_140(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_spherical_surface_196(ParameterRecord& record, EntityReader& reader);
NurbsSurface read_toroidal_surface_198(ParameterRecord& record, EntityReader& reader);

/// Surfaces without an end: made as large as needed to reach around `cover`, points of the definition space.
NurbsSurface read_plane_108(ParameterRecord& record, EntityReader& reader, const std::vector<Vector3>& cover);
NurbsSurface read_plane_surface_190(ParameterRecord& record, EntityReader& reader,
                                    const std::vector<Vector3>& cover);
NurbsSurface read_cylindrical_surface_192(ParameterRecord& record, EntityReader& reader,
                                          const std::vector<Vector3>& cover);
NurbsSurface read_conical_surface_194(ParameterRecord& record, EntityReader& reader,
                                      const std::vector<Vector3>& cover);

/// Faces, trimmed where they are cut. Faces whose loops enclose nothing are left out and noted.
std::vector<TrimmedPatch> read_bounded_plane_108(ParameterRecord& record, EntityReader& reader);
std::vector<TrimmedPatch> read_bounded_surface_143(ParameterRecord& record, EntityReader& reader);
std::vector<TrimmedPatch> read_trimmed_surface_144(ParameterRecord& record, EntityReader& reader);
std::vector<TrimmedPatch> read_solid_186(ParameterRecord& record, EntityReader& reader);
std::vector<TrimmedPatch> read_subfigure_instance_408(ParameterRecord& record, EntityReader& reader);
std::vector<TrimmedPatch> read_face_510(ParameterRecord& record, EntityReader& reader);
std::vector<TrimmedPatch> read_shell_514(ParameterRecord& record, EntityReader& reader);

}  // namespace lamina::engine
