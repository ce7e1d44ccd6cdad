#pragma once

#include <utility>
#include <vector>

#include "engine/geometry/vector.h"
#include "gcode/filament_options.h"
#include "gcode/plan/bead_path.h"
#include "gcode/plan/plan_options.h"
#include "gcode/toolpath.h"

namespace lamina::gcode {

/// Where the nozzle is and whether the filament is drawn back.
struct NozzleState {
  engine::Vector3 position = engine::Vector3::Zero();
  bool height_known = false;  ///< False until the nozzle has been sent to a height.
  bool retracted = false;
};

/// Turns bead paths into moves: travel, retraction and lifting between them, speed and volume along them.
class Route {
 public:
  /// Starts where `start` says. `thickness` of the layer in mm, `z` is its upper side.
  Route(const NozzleState& start, double z, double thickness, bool first_layer, const PlanOptions& options,
        const FilamentOptions& filament);

  /// Travels to the path's first point and lays the bead.
  void lay(const BeadPath& path);

  const NozzleState& nozzle() const { return nozzle_; }
  engine::Vector2 position() const { return nozzle_.position.head<2>(); }
  std::vector<Move> take_moves() { return std::move(moves_); }

 private:
  void travel_to(const engine::Vector2& target);
  void retract();
  void recover();
  void move_z(double z);
  void append_travel(const engine::Vector3& end);
  double bead_speed(Role role, double area) const;
  double bead_acceleration(Role role) const;

  NozzleState nozzle_;
  double z_;
  double thickness_;
  bool first_layer_;
  const PlanOptions& options_;
  const FilamentOptions& filament_;
  std::vector<Move> moves_;
};

}  // namespace lamina::gcode
