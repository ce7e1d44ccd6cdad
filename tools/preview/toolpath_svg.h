#pragma once

#include <string>
#include <vector>

#include "gcode/toolpath.h"

namespace lamina::tools {

/// A sheet with one picture for each of the layers: beads in their real width in the colours of their roles,
/// travels as thin lines, with height and layer number below. Three pictures in a row; all show the same part
/// of the bed. Each layer comes with the point where its first move starts.
struct PicturedLayer {
  gcode::LayerToolpath toolpath;
  engine::Vector3 start = engine::Vector3::Zero();
};

std::string toolpath_sheet_svg(const std::vector<PicturedLayer>& layers);

}  // namespace lamina::tools
