#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::gcode {

/// What a line is for.
enum class Role {
  kTravel,
  kOuterWall,
  kInnerWall,
  kSparseInfill,
  kSolidInfill,
  kTopSurface,
  kBottomSurface,
  kBridge,
  kGapFill,
  kSkirt,
  kBrim,
  kSupport,
};

/// What the nozzle does next: straight from where it is to `end`, in printer coordinates. Either it lays down
/// a bead (volume > 0), or it travels (volume = 0), or it stays where it is and only the filament moves
/// (filament != 0).
struct Move {
  engine::Vector3 end = engine::Vector3::Zero();  ///< mm
  Role role = Role::kTravel;
  double speed = 0.0;         ///< Wanted, mm/s; of the filament where only that moves.
  double acceleration = 0.0;  ///< Wanted, mm/s^2; 0 = the machine's own.
  double width = 0.0;         ///< Of the bead, mm; 0 without one.
  double height = 0.0;        ///< Of the bead, mm; 0 without one.
  double volume = 0.0;        ///< Laid down along the way, mm^3; not negative.
  double filament = 0.0;      ///< Drawn back (negative) or pushed out (positive) in place, mm of filament.
};

/// One layer's moves, in order. The first one starts where the layer before ended; the first layer's starts
/// at the origin.
struct LayerToolpath {
  std::size_t index = 0;     ///< 0-based.
  double z = 0.0;            ///< Height of the nozzle, mm: the layer's upper side.
  double thickness = 0.0;    ///< mm
  double fan = 0.0;          ///< Power of the part fan, in [0, 1].
  double narrow_area = 0.0;  ///< Part of the region too narrow for a wall, where nothing is laid, mm^2.
  std::vector<Move> moves;
};

/// Sum of the volumes, mm^3.
double volume(const LayerToolpath& layer);

/// Smallest box around everything that is laid down, half a bead's width included, mm; empty when nothing is.
engine::Box3 extrusion_bounds(const LayerToolpath& layer, const engine::Vector3& start);

}  // namespace lamina::gcode
