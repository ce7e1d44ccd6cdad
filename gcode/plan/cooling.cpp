#include "gcode/plan/cooling.h"

#include <algorithm>
#include <utility>

#include "gcode/motion/toolpath_time.h"

namespace lamina::gcode {
namespace {

/// Halvings of the interval in which the factor is sought: 2^-10 of the speed is finer than 1 % of the time.
constexpr int kBisections = 10;

LayerToolpath slowed(LayerToolpath layer, double factor, double min_speed) {
  for (Move& move : layer.moves) {
    if (move.volume > 0.0) move.speed = std::min(move.speed, std::max(move.speed * factor, min_speed));
  }
  return layer;
}

}  // namespace

double fan_power(std::size_t layer, double seconds, const CoolingOptions& options) {
  const std::size_t number = layer + 1;
  if (number <= options.fan_off_layers) return 0.0;
  double power = options.fan_always ? options.fan_min : 0.0;
  if (seconds <= options.slow_below_time) {
    power = options.fan_max;
  } else if (seconds < options.fan_below_time) {
    const double need =
        (options.fan_below_time - seconds) / (options.fan_below_time - options.slow_below_time);
    power = options.fan_min + need * (options.fan_max - options.fan_min);
  }
  if (number < options.fan_full_layer) {
    power *= static_cast<double>(number - options.fan_off_layers) /
             static_cast<double>(options.fan_full_layer - options.fan_off_layers);
  }
  return power;
}

LayerToolpath cooled(LayerToolpath layer, const engine::Vector3& start, const CoolingOptions& options,
                     const FilamentOptions& filament, const MachineLimits& limits) {
  double seconds = layer_time(layer, start, filament, limits);
  if (seconds > 0.0 && seconds < options.slow_below_time) {
    double slow = 0.0;
    double fast = 1.0;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (slow + fast);
      const double time = layer_time(slowed(layer, middle, options.min_speed), start, filament, limits);
      (time < options.slow_below_time ? fast : slow) = middle;
    }
    layer = slowed(std::move(layer), slow, options.min_speed);
    seconds = layer_time(layer, start, filament, limits);
  }
  layer.fan = fan_power(layer.index, seconds, options);
  return layer;
}

}  // namespace lamina::gcode
