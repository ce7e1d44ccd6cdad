#pragma once

#include <cstddef>

namespace lamina::gcode {

/// Fan and slowing down; they belong to the filament. Fan powers are shares in [0, 1].
struct CoolingOptions {
  bool fan_always = true;  ///< Run at fan_min where the layer time does not ask for more.
  double fan_min = 1.0;
  double fan_max = 1.0;
  double fan_bridge = 1.0;
  std::size_t fan_off_layers = 1;  ///< So many first layers are printed without the fan.
  std::size_t fan_full_layer =
      4;  ///< From the end of fan_off_layers the fan ramps up until this layer (1-based).
  double fan_below_time = 60.0;   ///< Layers shorter than this get fan_min to fan_max in proportion, s.
  double slow_below_time = 12.0;  ///< Layers shorter than this are slowed down to last so long, s; 0 = never.
  double min_speed = 15.0;        ///< Slowing down stops here, mm/s.
};

}  // namespace lamina::gcode
