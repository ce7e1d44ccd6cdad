#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/layer.h"
#include "gcode/region/region_options.h"

namespace lamina::gcode {

/// The filled area of one layer.
struct LayerRegion {
  std::size_t index = 0;
  engine::SlicePlane plane;
  engine::Region region;  ///< mm, same plane coordinates as the contours.

  std::size_t closed_contours = 0;
  std::size_t planar_contours = 0;
  std::size_t open_contours = 0;  ///< These three bound no area and are left out of the region.
  std::size_t touch_contours = 0;
  std::size_t touch_points = 0;
  std::size_t crossing_contours = 0;  ///< Pairs of closed contours that cross: solids that overlap.
};

/// Fills the contours of a layer. Closed contours nest by parity; where contours cross, each outer one with
/// the holes directly inside it is a solid of its own, and the union of the solids counts. Planar contours
/// are filled between their outer and inner curves and united with the rest. Curves are replaced by chords
/// within options.tolerance. Then the compensations of the options are applied.
LayerRegion make_region(const engine::Layer& layer, const RegionOptions& options);

struct FilledContours {
  engine::Region region;
  std::size_t crossings = 0;  ///< Pairs of loops that cross.
};

/// The parity and union rule alone, for loops of either direction.
FilledContours fill_contours(const std::vector<engine::Loop>& loops);

}  // namespace lamina::gcode
