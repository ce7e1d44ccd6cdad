#include "engine/import/iges/entity_table.h"

#include <algorithm>
#include <array>

namespace lamina::engine {
namespace {

/// By ascending number. A new entity is one file and one row here (and its declaration in entity_readers.h).
constexpr auto kEntityTypes = std::to_array<EntityType>({
    {.number = 0, .name = "null"},
    {.number = 100, .name = "circular arc", .read_curve = read_circular_arc_100},
    {.number = 102, .name = "composite curve", .read_curve = read_composite_curve_102},
    {.number = 104, .name = "conic arc", .read_curve = read_conic_arc_104},
    {.number = 106, .name = "copious data", .read_curve = read_copious_data_106},
    {.number = 108, .name = "plane", .read_unbounded = read_plane_108, .read_faces = read_bounded_plane_108},
    {.number = 110, .name = "line", .read_curve = read_line_110},
    {.number = 112, .name = "parametric spline curve", .read_curve = read_parametric_spline_curve_112},
    {.number = 114, .name = "parametric spline surface", .read_surface = read_parametric_spline_surface_114},
    {.number = 116, .name = "point", .read_curve = read_point_116},
    {.number = 118, .name = "ruled surface", .read_surface = read_ruled_surface_118},
    {.number = 120, .name = "surface of revolution", .read_surface = read_surface_of_revolution_120},
    {.number = 122, .name = "tabulated cylinder", .read_surface = read_tabulated_cylinder_122},
    {.number = 123, .name = "direction"},
    {.number = 124, .name = "transformation matrix"},
    {.number = 126, .name = "rational B-spline curve", .read_curve = read_rational_bspline_curve_126},
    {.number = 128, .name = "rational B-spline surface", .read_surface = read_rational_bspline_surface_128},
    {.number = 130, .name = "offset curve", .read_curve = read_offset_curve_130},
    {.number = 140, .name = "offset surface", .read_surface = read_offset_surface_140, .owned = {.first = 5}},
    {.number = 141, .name = "boundary"},
    {.number = 142, .name = "curve on a parametric surface"},
    {.number = 143, .name = "bounded surface", .read_faces = read_bounded_surface_143, .owned = {.first = 2}},
    {.number = 144, .name = "trimmed surface", .read_faces = read_trimmed_surface_144, .owned = {.first = 1}},
    {.number = 186,
     .name = "manifold solid B-rep",
     .read_faces = read_solid_186,
     .owned = {.first = 4, .counted_by = 3, .stride = 2, .alone = 1}},
    {.number = 190, .name = "plane surface", .read_unbounded = read_plane_surface_190},
    {.number = 192,
     .name = "right circular cylindrical surface",
     .read_unbounded = read_cylindrical_surface_192},
    {.number = 194, .name = "right circular conical surface", .read_unbounded = read_conical_surface_194},
    {.number = 196, .name = "spherical surface", .read_surface = read_spherical_surface_196},
    {.number = 198, .name = "toroidal surface", .read_surface = read_toroidal_surface_198},
    {.number = 212, .name = "general note"},
    {.number = 308, .name = "subfigure definition", .owned = {.first = 4, .counted_by = 3}},
    {.number = 314, .name = "color definition"},
    {.number = 402, .name = "associativity"},
    {.number = 404, .name = "drawing"},
    {.number = 406, .name = "property"},
    {.number = 408, .name = "subfigure instance", .read_faces = read_subfigure_instance_408},
    {.number = 410, .name = "view"},
    {.number = 416, .name = "external reference"},
    {.number = 502, .name = "vertex list"},
    {.number = 504, .name = "edge list"},
    {.number = 508, .name = "loop"},
    {.number = 510, .name = "face", .read_faces = read_face_510, .owned = {.first = 1}},
    {.number = 514,
     .name = "shell",
     .read_faces = read_shell_514,
     .owned = {.first = 2, .counted_by = 1, .stride = 2}},
});

static_assert(std::is_sorted(kEntityTypes.begin(), kEntityTypes.end(),
                             [](const EntityType& a, const EntityType& b) { return a.number < b.number; }));

}  // namespace

const EntityType* find_entity_type(int number) {
  const auto row = std::lower_bound(kEntityTypes.begin(), kEntityTypes.end(), number,
                                    [](const EntityType& type, int wanted) { return type.number < wanted; });
  return row != kEntityTypes.end() && row->number == number ? &*row : nullptr;
}

std::string_view entity_name(int number) {
  const EntityType* type = find_entity_type(number);
  return type != nullptr ? type->name : "unknown entity";
}

}  // namespace lamina::engine
