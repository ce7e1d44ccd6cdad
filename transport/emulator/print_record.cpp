#include "transport/emulator/print_record.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamina::transport {

PrintRecord::PrintRecord(RecordDetail detail, double filament_diameter)
    : detail_(detail), filament_area_(std::numbers::pi / 4 * filament_diameter * filament_diameter) {}

double PrintRecord::deposit(double length) {
  if (length <= 0) {
    retracted_ -= length;
    return 0;
  }
  const double refilled = std::min(length, retracted_);
  retracted_ -= refilled;
  return length - refilled;
}

void PrintRecord::add(const PlannedMove& move) {
  ++report_.moves;
  report_.filament_fed += move.to[3] - move.from[3];
  if (move.deposited <= 0) return;
  report_.filament += move.deposited;
  report_.volume = report_.filament * filament_area_;
  const Bead bead{
      {move.from[0], move.from[1], move.from[2]}, {move.to[0], move.to[1], move.to[2]}, move.deposited};
  if (detail_ == RecordDetail::kBeads) beads_.push_back(bead);
  if (bead.from == bead.to) return;  // a drop on the spot makes no layer
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax(bead.from[axis], bead.to[axis]);
    report_.box_min[axis] = report_.beads == 0 ? low : std::min(report_.box_min[axis], low);
    report_.box_max[axis] = report_.beads == 0 ? high : std::max(report_.box_max[axis], high);
  }
  ++report_.beads;
  heights_.insert(std::llround(bead.to[2] * 1000));
  report_.layers = static_cast<std::int64_t>(heights_.size());
}

}  // namespace lamina::transport
