#include "gcode/motion/toolpath_time.h"

namespace lamina::gcode {

Segment segment_of(const Move& move, const engine::Vector3& start, const FilamentOptions& filament) {
  const engine::Vector3 way = move.end - start;
  Segment segment;
  segment.delta = {way.x(), way.y(), way.z(), move.volume * filament.flow / filament.area() + move.filament};
  segment.speed = move.speed;
  segment.acceleration = move.acceleration;
  return segment;
}

double layer_time(const LayerToolpath& layer, const engine::Vector3& start, const FilamentOptions& filament,
                  const MachineLimits& limits) {
  LookAhead machine(limits);
  engine::Vector3 position = start;
  double seconds = 0.0;
  for (const Move& move : layer.moves) {
    if (const auto timed = machine.push(segment_of(move, position, filament))) seconds += timed->seconds;
    position = move.end;
  }
  for (const TimedSegment& timed : machine.finish()) seconds += timed.seconds;
  return seconds;
}

}  // namespace lamina::gcode
