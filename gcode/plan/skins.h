#pragma once

#include "engine/geometry/polygon.h"

namespace lamina::gcode {

/// What lies around a layer, as far as it decides where the infill is solid.
struct Neighbours {
  engine::Region above;          ///< The next layer's region.
  engine::Region below;          ///< The layer below.
  engine::Region covered_above;  ///< In each of the layers that a top shell reaches through.
  engine::Region covered_below;  ///< In each of the layers that a bottom shell reaches through.
};

/// The inside of a polygon by what is laid there. The four are disjoint.
struct Skins {
  engine::Region top;     ///< Nothing above, with an anchor of one line beyond.
  engine::Region bottom;  ///< Nothing below, with the anchor, where it is not top.
  engine::Region solid;   ///< Solid because a surface is near.
  engine::Region sparse;
};

struct SkinOptions {
  bool has_top = true;  ///< The shell has top layers at all.
  bool has_bottom = true;
  /// Of solid infill, mm: solid areas reach so far into sparse ones, to be anchored there, and sparse areas
  /// that are narrower become solid.
  double line_spacing = 0.41;
  double min_area_solid = 15.0;  ///< Sparse areas below this become solid, mm^2.
};

/// Divides the inside of a layer by differences with its neighbours.
Skins divide_inside(const engine::Region& inside, const Neighbours& neighbours, const SkinOptions& options);

}  // namespace lamina::gcode
