#pragma once

#include <string>
#include <vector>

#include "engine/model.h"
#include "gcode/print_volume.h"
#include "tools/cli/command_line.h"

namespace lamina::tools {

/// Where models go on the bed.
struct PlacementArguments {
  double scale = 1.0;
  std::vector<double> scale_to_fit;  ///< x, y, z; mm; empty = not scaled
  std::vector<double> rotate;        ///< about z, or about x, y and z in turn, degrees
  std::vector<double> center;        ///< x, y of the middle on the bed, mm; empty = the bed's middle
  int copies = 1;                    ///< of every model
  double spacing = 6.0;              ///< between parts on one bed, mm
  bool keep_position = false;        ///< Keep the model's own x and y instead of centring it.
  std::vector<double> move;          ///< x, y; mm, after the rest; empty = not moved.

  void declare(OptionSet& options);
};

struct PlacedModel {
  engine::Model model;  ///< In printer coordinates.
  engine::Box3 bounds;  ///< Around it, to a micrometre.
  std::vector<std::string> warnings;
};

/// The models turned, scaled, put on z = 0 and centred on the bed; several ones, or copies, beside each
/// other. Throws Failure when the arguments are impossible or a model has no extent, FitError when it reaches
/// out of the printer.
PlacedModel place(const std::vector<engine::Model>& models, const PlacementArguments& arguments,
                  const gcode::PrintVolume& volume);

}  // namespace lamina::tools
