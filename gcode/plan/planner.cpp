#include "gcode/plan/planner.h"

#include <algorithm>
#include <string>
#include <utility>

#include "gcode/marlin/number_text.h"
#include "gcode/plan/adhesion.h"
#include "gcode/plan/island.h"
#include "gcode/plan/order.h"
#include "gcode/plan/plan_error.h"
#include "gcode/plan/seam.h"
#include "gcode/region/polygon_clipping.h"

namespace lamina::gcode {
namespace {

using engine::Region;
using engine::Vector2;

/// Thicknesses that add up to a shell's minimum within this are enough, mm.
constexpr double kThicknessSlack = 1e-6;

void check_bead(const std::string& key, double width, double thickness) {
  if (width < thickness) {
    throw PlanError(key, width, thickness,
                    key + " " + fixed_text(width, 3) + " mm is less than the layer's thickness " +
                        fixed_text(thickness, 3) + " mm: choose thinner layers or a wider line");
  }
}

void check_widths(const LayerRegion& layer, const WidthOptions& width) {
  const double thickness = layer.plane.thickness();
  if (layer.index == 0 && width.first_layer > 0.0) {
    check_bead("width.first_layer", width.first_layer, thickness);
    return;
  }
  check_bead("width.outer_wall", width.outer_wall, thickness);
  check_bead("width.inner_wall", width.inner_wall, thickness);
  check_bead("width.sparse_infill", width.sparse_infill, thickness);
  check_bead("width.solid_infill", width.solid_infill, thickness);
  check_bead("width.top_surface", width.top_surface, thickness);
}

void check_share(const std::string& key, double value) {
  if (value >= 0.0 && value <= 1.0) return;
  throw PlanError(key, value, value < 0.0 ? 0.0 : 1.0,
                  key + " " + number_text(value, 6) + " is not a share between 0 and 1");
}

/// Turns a path so that it begins where it should: a closed one at its seam, an open one at its nearer end.
BeadPath begun_near(BeadPath path, SeamPosition seam, const Vector2& nozzle,
                    const std::vector<Vector2>& below) {
  if (path.closed) {
    const auto start = seam_vertex(path.points, seam, nozzle, below);
    std::rotate(path.points.begin(), path.points.begin() + static_cast<std::ptrdiff_t>(start),
                path.points.end());
  } else if ((path.points.back() - nozzle).norm() < (path.points.front() - nozzle).norm()) {
    std::reverse(path.points.begin(), path.points.end());
  }
  return path;
}

std::vector<BeadPath> adhesion_paths(const LayerRegion& layer, const Region& first_layer,
                                     const PlanOptions& options, const FilamentOptions& filament) {
  const double width = options.width.first_layer > 0.0 ? options.width.first_layer : options.width.outer_wall;
  const double height = layer.plane.thickness();
  switch (options.adhesion.type) {
    case Adhesion::kNone:
      break;
    case Adhesion::kSkirt:
      if (layer.index >= options.adhesion.skirt_height) break;
      return make_skirt(first_layer, options.adhesion, width, height,
                        options.adhesion.skirt_min_length * filament.area());
    case Adhesion::kBrim:
      if (layer.index > 0) break;
      return make_brim(first_layer, options.adhesion, width, height);
  }
  return {};
}

}  // namespace

Planner::Planner(PlanOptions options, FilamentOptions filament, const engine::Vector3& start)
    : options_(options), filament_(std::move(filament)) {
  nozzle_.position = start;
  check_share("infill.density", options_.infill.density);
  check_share("infill.wall_overlap", options_.infill.wall_overlap);
}

std::vector<LayerToolpath> Planner::push(LayerRegion layer) {
  check_widths(layer, options_.width);
  if (!window_.empty() && layer.plane.top <= window_.back().plane.top) {
    const double below = window_.back().plane.top;
    throw PlanError("layer " + std::to_string(layer.index), layer.plane.top, below,
                    "layer " + std::to_string(layer.index) +
                        " ends at z = " + fixed_text(layer.plane.top, 3) +
                        " mm, not above the layer before it (" + fixed_text(below, 3) + " mm)");
  }
  if (layer.index == 0) first_layer_ = layer.region;
  window_.push_back(std::move(layer));
  return finish_layers(false);
}

std::vector<LayerToolpath> Planner::finish() {
  return finish_layers(true);
}

Planner::Shells Planner::shells(std::size_t position) const {
  const ShellOptions& shell = options_.shell;
  Shells shells;
  // A surface on top of layer i + n - 1 makes layer i solid when the layers i to i + n - 1 are its shell;
  // whether there is one, layer i + n tells.
  double thickness = 0.0;
  while (shell.bottom_layers > 0 && shells.below <= position &&
         (shells.below < shell.bottom_layers || thickness < shell.bottom_min_thickness - kThicknessSlack)) {
    thickness += window_[position - shells.below].plane.thickness();
    ++shells.below;
  }
  thickness = 0.0;
  while (shell.top_layers > 0 &&
         (shells.above < shell.top_layers || thickness < shell.top_min_thickness - kThicknessSlack)) {
    if (position + shells.above >= window_.size()) return shells;
    thickness += window_[position + shells.above].plane.thickness();
    ++shells.above;
  }
  shells.complete = position + shells.above < window_.size();
  return shells;
}

Neighbours Planner::neighbours(std::size_t position) const {
  const Shells reach = shells(position);
  Neighbours around;
  if (position + 1 < window_.size()) around.above = window_[position + 1].region;
  if (position > 0) around.below = window_[position - 1].region;
  if (reach.complete) {
    around.covered_above = around.above;
    for (std::size_t i = 2; i <= reach.above; ++i) {
      around.covered_above = intersect(around.covered_above, window_[position + i].region);
    }
  }
  if (reach.below <= position) {
    around.covered_below = around.below;
    for (std::size_t i = 2; i <= reach.below; ++i) {
      around.covered_below = intersect(around.covered_below, window_[position - i].region);
    }
  }
  return around;
}

std::vector<LayerToolpath> Planner::finish_layers(bool last) {
  std::vector<LayerToolpath> finished;
  while (next_ < window_.size() && (last || shells(next_).complete)) {
    finished.push_back(plan(next_));
    ++next_;
  }
  drop_unneeded();
  return finished;
}

void Planner::drop_unneeded() {
  if (window_.empty()) return;
  const std::size_t position = std::min(next_, window_.size() - 1);
  const std::size_t below = std::max<std::size_t>(shells(position).below, 1);
  for (std::size_t i = below; i < position; ++i) {
    window_.pop_front();
    --next_;
  }
}

LayerToolpath Planner::plan(std::size_t position) {
  const LayerRegion& layer = window_[position];
  const LayerPlace place{layer.index, layer.plane.thickness()};
  LayerToolpath toolpath;
  toolpath.index = layer.index;
  toolpath.z = layer.plane.top;
  toolpath.thickness = place.thickness;

  const Neighbours around = neighbours(position);
  std::vector<Island> islands;
  for (const engine::Polygon& polygon : layer.region) {
    islands.push_back(make_island(polygon, around, place, options_));
    toolpath.narrow_area += islands.back().narrow_area;
  }

  Route route(nozzle_, toolpath.z, place.thickness, layer.index == 0, options_, filament_);
  std::vector<Vector2> seams;
  for (const BeadPath& path : adhesion_paths(layer, first_layer_, options_, filament_)) {
    route.lay(begun_near(path, SeamPosition::kNearest, route.position(), {}));
  }
  while (!islands.empty()) {
    const std::size_t nearest = nearest_island(islands, route.position());
    for (std::vector<BeadPath>& group : islands[nearest].groups) {
      while (!group.empty()) {
        const auto chosen = static_cast<std::ptrdiff_t>(nearest_path(group, route.position()));
        const BeadPath path = begun_near(std::move(group[static_cast<std::size_t>(chosen)]),
                                         options_.wall.seam, route.position(), seams_);
        group.erase(group.begin() + chosen);
        if (path.role == Role::kOuterWall) seams.push_back(path.points.front());
        route.lay(path);
      }
    }
    islands.erase(islands.begin() + static_cast<std::ptrdiff_t>(nearest));
  }
  seams_ = std::move(seams);
  toolpath.moves = route.take_moves();
  nozzle_ = route.nozzle();
  return toolpath;
}

}  // namespace lamina::gcode
