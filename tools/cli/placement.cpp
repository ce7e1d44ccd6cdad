#include "tools/cli/placement.h"

#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "profiles/value.h"
#include "tools/cli/failure.h"

namespace lamina::tools {

using engine::Vector2;
using engine::Vector3;

void PlacementArguments::declare(OptionSet& options) {
  options.number("--scale", scale, "FACTOR", "Scale the model, such as 0.5 or 25.4");
  options.flag("--no-center", keep_position,
               "Keep the model's own x and y instead of centring it on the bed");
  options.numbers("--move", move, "X,Y", "Move it on the bed, mm");
}

PlacedModel place(const engine::Model& model, const PlacementArguments& arguments,
                  const gcode::PrintVolume& volume) {
  if (!(arguments.scale > 0.0)) {
    throw Failure(ExitCode::kUsage,
                  "--scale is " + profiles::number_text(arguments.scale) + ": it must be a number above 0");
  }
  if (!arguments.move.empty() && arguments.move.size() != 2) {
    throw Failure(ExitCode::kUsage, "--move needs two numbers, as in --move 10,-5");
  }
  const engine::Box3 bounds = engine::model_bounds(model);
  if (bounds.isEmpty() || !(bounds.sizes().z() > 0.0)) {
    throw Failure(ExitCode::kGeometry, model.name + " has no height: there is nothing to slice");
  }
  const Vector3 middle = bounds.center();
  Vector3 shift =
      arguments.keep_position ? Vector3::Zero() : Vector3(volume.center() - arguments.scale * middle);
  if (!arguments.move.empty()) shift += Vector3(arguments.move[0], arguments.move[1], 0.0);
  shift.z() = -arguments.scale * bounds.min().z();

  const Eigen::Affine3d transform = Eigen::Translation3d(shift) * Eigen::Scaling(arguments.scale);
  PlacedModel placed{engine::transformed(model, transform),
                     engine::Box3(transform * bounds.min(), transform * bounds.max())};
  gcode::check_fit(placed.bounds, volume, "model");
  return placed;
}

}  // namespace lamina::tools
