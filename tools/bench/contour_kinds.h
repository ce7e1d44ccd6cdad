#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/layer.h"

namespace lamina::tools {

/// How many contours of each kind a layer has, and how deep the closed ones nest.
struct ContourKinds {
  std::size_t touching = 0;  ///< closed or open touch curves
  std::size_t open = 0;
  std::size_t planar = 0;
  std::size_t holes = 0;  ///< of planar contours
  std::size_t points = 0;
  std::vector<std::size_t> depths;  ///< of the closed contours, ascending

  bool operator==(const ContourKinds&) const = default;
};

ContourKinds kinds_of(const engine::Layer& layer, double tolerance);
/// The outlines and holes of a region; they do not touch.
ContourKinds kinds_of(const engine::Region& region);

/// Such as "3 closed at depths 0 1 1, 1 open".
std::string described(const ContourKinds& kinds);

/// The closed contours of a layer but for touch curves, flattened to `tolerance` (mm).
std::vector<engine::Loop> closed_loops(const engine::Layer& layer, double tolerance);

}  // namespace lamina::tools
