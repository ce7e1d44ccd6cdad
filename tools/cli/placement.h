#pragma once

#include <vector>

#include "engine/model.h"
#include "gcode/print_volume.h"
#include "tools/cli/command_line.h"

namespace lamina::tools {

/// Where a model goes on the bed.
struct PlacementArguments {
  double scale = 1.0;
  bool keep_position = false;  ///< Keep the model's own x and y instead of centring it.
  std::vector<double> move;    ///< x, y; mm, after the rest; empty = not moved.

  void declare(OptionSet& options);
};

struct PlacedModel {
  engine::Model model;  ///< In printer coordinates.
  engine::Box3 bounds;  ///< Around it, to a micrometre.
};

/// The model scaled, centred on the bed and put on z = 0. Throws Failure when the arguments are impossible or
/// the model has no extent, FitError when it reaches out of the printer.
PlacedModel place(const engine::Model& model, const PlacementArguments& arguments,
                  const gcode::PrintVolume& volume);

}  // namespace lamina::tools
