#include "engine/import/iges/entity_table.h"

#include <algorithm>
#include <array>

namespace lamina::engine {
namespace {

/// By ascending number. A new entity is one file and one row here (and its declaration in entity_readers.h).
constexpr auto kEntityTypes = std::to_array<EntityType>({
    {0, "null", nullptr, nullptr, {}},
    {100, "circular arc", read_circular_arc_100, nullptr, {}},
    {102, "composite curve", read_composite_curve_102, nullptr, {}},
    {104, "conic arc", read_conic_arc_104, nullptr, {}},
    {106, "copious data", nullptr, nullptr, {}},
    {108, "plane", nullptr, nullptr, {}},
    {110, "line", read_line_110, nullptr, {}},
    {112, "parametric spline curve", read_parametric_spline_curve_112, nullptr, {}},
    {114, "parametric spline surface", nullptr, read_parametric_spline_surface_114, {}},
    {116, "point", read_point_116, nullptr, {}},
    {118, "ruled surface", nullptr, read_ruled_surface_118, {}},
    {120, "surface of revolution", nullptr, read_surface_of_revolution_120, {}},
    {122, "tabulated cylinder", nullptr, nullptr, {}},
    {123, "direction", nullptr, nullptr, {}},
    {124, "transformation matrix", nullptr, nullptr, {}},
    {126, "rational B-spline curve", read_rational_bspline_curve_126, nullptr, {}},
    {128, "rational B-spline surface", nullptr, read_rational_bspline_surface_128, {}},
    {130, "offset curve", nullptr, nullptr, {}},
    {140, "offset surface", nullptr, nullptr, {}},
    {141, "boundary", nullptr, nullptr, {}},
    {142, "curve on a parametric surface", nullptr, nullptr, {}},
    {143, "bounded surface", nullptr, nullptr, {.first = 2}},
    {144, "trimmed surface", nullptr, nullptr, {.first = 1}},
    {186, "manifold solid B-rep", nullptr, nullptr, {}},
    {190, "plane surface", nullptr, nullptr, {}},
    {192, "right circular cylindrical surface", nullptr, nullptr, {}},
    {194, "right circular conical surface", nullptr, nullptr, {}},
    {196, "spherical surface", nullptr, nullptr, {}},
    {198, "toroidal surface", nullptr, nullptr, {}},
    {212, "general note", nullptr, nullptr, {}},
    {308, "subfigure definition", nullptr, nullptr, {.first = 4, .counted_by = 3}},
    {314, "color definition", nullptr, nullptr, {}},
    {402, "associativity", nullptr, nullptr, {}},
    {404, "drawing", nullptr, nullptr, {}},
    {406, "property", nullptr, nullptr, {}},
    {408, "subfigure instance", nullptr, nullptr, {}},
    {410, "view", nullptr, nullptr, {}},
    {416, "external reference", nullptr, nullptr, {}},
    {502, "vertex list", nullptr, nullptr, {}},
    {504, "edge list", nullptr, nullptr, {}},
    {508, "loop", nullptr, nullptr, {}},
    {510, "face", nullptr, nullptr, {.first = 1}},
    {514, "shell", nullptr, nullptr, {}},
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
