#include "gcode/toolpath.h"

namespace lamina::gcode {

double volume(const LayerToolpath& layer) {
  double sum = 0.0;
  for (const Move& move : layer.moves) sum += move.volume;
  return sum;
}

engine::Box3 extrusion_bounds(const LayerToolpath& layer, const engine::Vector3& start) {
  engine::Box3 box;
  engine::Vector3 from = start;
  for (const Move& move : layer.moves) {
    if (move.volume > 0.0) {
      const engine::Vector3 reach(0.5 * move.width, 0.5 * move.width, 0.0);
      for (const engine::Vector3& point : {from, move.end}) {
        box.extend(point - reach);
        box.extend(point + reach);
      }
    }
    from = move.end;
  }
  return box;
}

}  // namespace lamina::gcode
