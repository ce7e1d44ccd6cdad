#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tools/preview/toolpath_svg.h"

namespace lamina::tools {

/// Collects a few layers of the G-code that goes by, for a picture of what is really in the file. It reads
/// the dialect that lamina writes: absolute positions, relative extrusion, ";LAYER_CHANGE", ";TYPE:",
/// ";WIDTH:".
class GcodePicture {
 public:
  /// Of `layer_count` layers, at most `pictures` are kept, spread evenly from the first to the last.
  GcodePicture(std::size_t layer_count, std::size_t pictures);

  void read(std::string_view line);

  /// The layers side by side.
  std::string svg() const { return toolpath_sheet_svg(layers_); }

 private:
  void read_comment(std::string_view comment);

  std::vector<std::size_t> wanted_;  ///< Layer numbers, rising.
  std::vector<PicturedLayer> layers_;
  std::size_t next_layer_ = 0;  ///< The number that the next ";LAYER_CHANGE" begins.
  bool collecting_ = false;
  engine::Vector3 position_ = engine::Vector3::Zero();
  gcode::Role role_ = gcode::Role::kTravel;
  double width_ = 0.0;  ///< mm
};

}  // namespace lamina::tools
