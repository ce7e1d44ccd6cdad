#pragma once

#include <cstddef>

#include "engine/layer.h"

namespace lamina::tools {

/// One layer in numbers.
struct LayerFigures {
  std::size_t index = 0;
  double z = 0.0;       ///< mm
  double area = 0.0;    ///< Of the filled regions, mm^2.
  double length = 0.0;  ///< Of all contours together, mm.
  std::size_t closed = 0;
  std::size_t open = 0;
  std::size_t planar_outer = 0;
  std::size_t planar_inner = 0;
  std::size_t points = 0;
  std::size_t touch = 0;  ///< Of the closed and open ones: those along which the plane only grazes the model.

  std::size_t contours() const { return closed + open + planar_outer + planar_inner + points; }
};

/// Measures a layer; curves are followed within `tolerance`, mm.
LayerFigures measure(const engine::Layer& layer, double tolerance);

}  // namespace lamina::tools
