#include "gcode/plan/island.h"

#include <algorithm>
#include <utility>

#include "gcode/plan/bead.h"
#include "gcode/plan/infill.h"
#include "gcode/plan/simplify.h"
#include "gcode/plan/walls.h"

namespace lamina::gcode {
namespace {

WidthOptions widths_of(const LayerPlace& place, const WidthOptions& options) {
  if (place.index > 0 || options.first_layer <= 0.0) return options;
  const double width = options.first_layer;
  return {width, width, width, width, width, width};
}

std::vector<BeadPath> wall_paths(const std::vector<engine::Loop>& loops, Role role, double width) {
  std::vector<BeadPath> paths;
  paths.reserve(loops.size());
  for (const engine::Loop& loop : loops) paths.push_back({role, width, true, loop});
  return paths;
}

BeadPath simplified_path(BeadPath path, double resolution) {
  path.points = path.closed ? simplified_loop(path.points, resolution) : simplified(path.points, resolution);
  return path;
}

}  // namespace

Island make_island(const engine::Polygon& polygon, const Neighbours& neighbours, const LayerPlace& place,
                   const PlanOptions& options) {
  const WidthOptions width = widths_of(place, options.width);
  const double height = place.thickness;

  const Walls walls = make_walls(
      polygon, options.wall.loops,
      {width.outer_wall, width.inner_wall, height, options.infill.wall_overlap * width.inner_wall});
  Island island;
  island.narrow_area = walls.narrow_area;
  for (std::size_t level = 0; level < walls.levels.size(); ++level) {
    const bool outer = level == 0;
    island.groups.push_back(wall_paths(walls.levels[level], outer ? Role::kOuterWall : Role::kInnerWall,
                                       outer ? width.outer_wall : width.inner_wall));
  }
  if (options.wall.order == WallOrder::kInnerFirst) std::reverse(island.groups.begin(), island.groups.end());

  SkinOptions skin;
  skin.has_top = options.shell.top_layers > 0;
  skin.has_bottom = options.shell.bottom_layers > 0;
  skin.line_spacing = bead_spacing(width.solid_infill, height);
  skin.min_area_solid = options.infill.density > 0.0 ? options.infill.min_area_solid : 0.0;
  Skins skins = divide_inside(walls.inside, neighbours, skin);

  const double angle = infill_angle(options.infill, place.index);
  if (options.infill.density >= 1.0) {
    skins.solid.insert(skins.solid.end(), skins.sparse.begin(), skins.sparse.end());
    skins.sparse.clear();
  }
  island.groups.push_back(fill_solid(skins.bottom, Role::kBottomSurface, width.solid_infill, height, angle));
  island.groups.push_back(
      fill_sparse(skins.sparse, options.infill, width.sparse_infill, height, place.index));
  island.groups.push_back(fill_solid(skins.solid, Role::kSolidInfill, width.solid_infill, height, angle));
  island.groups.push_back(fill_solid(skins.top, Role::kTopSurface, width.top_surface, height, angle));

  for (std::vector<BeadPath>& group : island.groups) {
    for (BeadPath& path : group) path = simplified_path(std::move(path), options.resolution);
  }
  return island;
}

}  // namespace lamina::gcode
