#pragma once

#include <optional>
#include <vector>

#include "transport/emulator/planner.h"

namespace lamina::transport {

/// An arc in the XY plane as G2 and G3 give it.
struct Arc {
  double center_x = 0, center_y = 0;  ///< mm, machine coordinates
  bool clockwise = false;
  int extra_turns = 0;  ///< P: whole circles besides the arc
};

/// The center from I and J (relative to the start); none where the firmware says "bad parameters".
std::optional<Arc> arc_by_center(const MachinePosition& start, std::optional<double> i,
                                 std::optional<double> j, bool clockwise, int extra_turns);

/// The center from R: positive the shorter, negative the longer way round. None where there is no such arc.
std::optional<Arc> arc_by_radius(const MachinePosition& start, const MachinePosition& end, double radius,
                                 bool clockwise);

/// The chords that Marlin runs instead of the arc, as end points; the last one is `end`. Z and E change in
/// proportion. Marlin's rule: chords of 1 mm, but at least 72 a circle, and none shorter than 0.1 mm.
std::vector<MachinePosition> arc_segments(const MachinePosition& start, const MachinePosition& end,
                                          const Arc& arc);

/// The chords that Marlin runs for G5, a cubic Bezier curve in XY with the control points given as absolute
/// positions: the parameter step is halved until the chord's middle is within 0.1 mm (sum of both axes) of
/// the curve's, and doubled again while it allows.
std::vector<MachinePosition> bezier_segments(const MachinePosition& start, double first_x, double first_y,
                                             double second_x, double second_y, const MachinePosition& end);

}  // namespace lamina::transport
