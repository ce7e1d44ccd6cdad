#include "gcode/plan/route.h"

#include <algorithm>
#include <limits>

#include "gcode/plan/bead.h"

namespace lamina::gcode {
namespace {

using engine::Vector2;
using engine::Vector3;

double role_speed(Role role, const SpeedOptions& speed) {
  switch (role) {
    case Role::kTravel:
      return speed.travel;
    case Role::kOuterWall:
      return speed.outer_wall;
    case Role::kInnerWall:
      return speed.inner_wall;
    case Role::kSparseInfill:
      return speed.sparse_infill;
    case Role::kTopSurface:
      return speed.top_surface;
    case Role::kSkirt:
    case Role::kBrim:
      return speed.skirt;
    case Role::kSolidInfill:
    case Role::kBottomSurface:
    case Role::kBridge:
    case Role::kGapFill:
    case Role::kSupport:
      return speed.solid_infill;
  }
  return speed.solid_infill;
}

}  // namespace

Route::Route(const NozzleState& start, double z, double thickness, bool first_layer,
             const PlanOptions& options, const FilamentOptions& filament)
    : nozzle_(start),
      z_(z),
      thickness_(thickness),
      first_layer_(first_layer),
      options_(options),
      filament_(filament) {}

void Route::lay(const BeadPath& path) {
  if (path.points.size() < 2) return;
  travel_to(path.points.front());
  const double area = bead_area(path.width, thickness_);
  Move move;
  move.role = path.role;
  move.width = path.width;
  move.height = thickness_;
  move.speed = bead_speed(path.role, area);
  move.acceleration = bead_acceleration(path.role);
  const std::size_t count = path.points.size() + (path.closed ? 1 : 0);
  for (std::size_t i = 1; i < count; ++i) {
    const Vector2& point = path.points[i % path.points.size()];
    move.end = Vector3(point.x(), point.y(), z_);
    move.volume = area * (move.end - nozzle_.position).norm();
    if (move.volume == 0.0) continue;
    moves_.push_back(move);
    nozzle_.position = move.end;
  }
}

void Route::travel_to(const Vector2& target) {
  const bool layer_change = !nozzle_.height_known || nozzle_.position.z() != z_;
  const double distance = (target - position()).norm();
  const RetractionOptions& retraction = options_.retraction;
  if (distance > retraction.min_travel || (layer_change && retraction.on_layer_change)) retract();
  const bool hop = nozzle_.retracted && retraction.z_hop > 0.0 &&
                   (retraction.z_hop_max_z <= 0.0 || z_ <= retraction.z_hop_max_z);
  move_z(hop ? z_ + retraction.z_hop : z_);
  if (distance > 0.0) append_travel(Vector3(target.x(), target.y(), nozzle_.position.z()));
  move_z(z_);
  recover();
}

void Route::retract() {
  if (nozzle_.retracted || options_.retraction.length <= 0.0) return;
  Move move;
  move.end = nozzle_.position;
  move.filament = -options_.retraction.length;
  move.speed = options_.retraction.speed;
  moves_.push_back(move);
  nozzle_.retracted = true;
}

void Route::recover() {
  if (!nozzle_.retracted) return;
  const RetractionOptions& retraction = options_.retraction;
  Move move;
  move.end = nozzle_.position;
  move.filament = retraction.length + retraction.restart_extra;
  move.speed = retraction.recover_speed > 0.0 ? retraction.recover_speed : retraction.speed;
  moves_.push_back(move);
  nozzle_.retracted = false;
}

void Route::move_z(double z) {
  if (nozzle_.height_known && nozzle_.position.z() == z) return;
  nozzle_.height_known = true;
  append_travel(Vector3(nozzle_.position.x(), nozzle_.position.y(), z));
  const SpeedOptions& speed = options_.speed;
  if (speed.travel_z > 0.0) moves_.back().speed = speed.travel_z;
}

void Route::append_travel(const Vector3& end) {
  Move move;
  move.end = end;
  move.speed = options_.speed.travel;
  if (first_layer_) move.speed = std::min(move.speed, options_.speed.first_layer_travel);
  move.acceleration = options_.acceleration.travel;
  moves_.push_back(move);
  nozzle_.position = end;
}

double Route::bead_speed(Role role, double area) const {
  double speed = role_speed(role, options_.speed);
  if (first_layer_) speed = std::min(speed, options_.speed.first_layer);
  if (filament_.max_volumetric_speed > 0.0) {
    speed = std::min(speed, filament_.max_volumetric_speed / (area * filament_.flow));
  }
  return speed;
}

double Route::bead_acceleration(Role role) const {
  const AccelerationOptions& acceleration = options_.acceleration;
  if (first_layer_ && acceleration.first_layer > 0.0) return acceleration.first_layer;
  if (role == Role::kOuterWall) return acceleration.outer_wall;
  if (role == Role::kInnerWall) return acceleration.inner_wall;
  return acceleration.infill;
}

}  // namespace lamina::gcode
