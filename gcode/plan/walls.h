#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/polygon.h"
#include "gcode/plan/plan_options.h"

namespace lamina::gcode {

/// Walls of one polygon and what they leave inside.
struct Walls {
  /// Centre lines of the beads by level, the outermost first. A level's outer loops run counter-clockwise,
  /// those around holes clockwise. Levels for which there is no room are missing.
  std::vector<std::vector<engine::Loop>> levels;
  engine::Region
      inside;  ///< Area for skins and infill: it reaches to the inner flank of the innermost walls.
  double narrow_area = 0.0;  ///< mm^2 of the polygon too narrow for even one wall; nothing is laid there.
};

/// Widths of one layer's walls and how much of the inside's edge the walls share with it, mm.
struct WallWidths {
  double outer = 0.45;
  double inner = 0.45;
  double height = 0.2;   ///< Thickness of the layer.
  double overlap = 0.0;  ///< The inside is larger by this than what the walls leave free.
};

/// Walls by offset. The outer wall's bead touches the outline, so its centre line runs at outer / 2 inside
/// it; each further one lies a bead spacing deeper (between the outer and the first inner wall the mean of
/// their spacings). A wall of a level is left out where the part is so narrow that the passes on its two
/// sides would share more than two fifths of their spacing.
Walls make_walls(const engine::Polygon& polygon, std::size_t loops, const WallWidths& widths);

/// Depth of a level's centre line below the outline, mm.
double wall_depth(std::size_t level, const WallWidths& widths);

}  // namespace lamina::gcode
