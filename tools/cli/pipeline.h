#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/adaptive_planes.h"
#include "engine/slicer.h"
#include "gcode/gcode_stream.h"
#include "profiles/settings.h"
#include "tools/cli/placement.h"
#include "tools/cli/slice_report.h"

namespace lamina::tools {

/// What slicing could not do perfectly, summed over the layers.
struct SlicingFlaws {
  std::size_t bridged_gaps = 0;
  engine::BridgedGap widest_bridge;
  double widest_bridge_z = 0.0;
  std::size_t open_gaps = 0;
  engine::BridgedGap widest_gap;
  double widest_gap_z = 0.0;
  std::size_t open_layers = 0;  ///< with open contours that are no touch: the model is not closed there
  double lowest_open_z = 0.0;
  double highest_open_z = 0.0;
  double dropped_length = 0.0;   ///< of pieces inside the solid, or beyond it where surfaces overlap, mm
  std::size_t empty_layers = 0;  ///< Planes inside the model that meet nothing.
  std::size_t missed_faces = 0;  ///< Level faces that adaptive layers could not meet.

  void add(const engine::Layer& layer);
};

/// The way from a placed model to G-code, pulled layer by layer: planes -> contours -> toolpaths -> lines.
/// What it holds does not grow with the number of layers,
/// but for a row of figures each where the slicing has a clock.
class ModelGcode {
 public:
  /// Throws SliceError, FitError, PlanError, TemplateError, Failure.
  ModelGcode(const PlacedModel& placed, const profiles::Settings& settings);

  /// The lines of the next step, without line feeds: those before the first layer, those that follow from one
  /// more layer (perhaps none yet), and those after the last. Nothing when all is told.
  std::optional<std::vector<std::string>> next();

  std::size_t layer_count() const { return slicer_.layer_count(); }
  std::size_t layers_sliced() const { return layers_sliced_; }
  const SlicingFlaws& flaws() const { return flaws_; }

  /// What was counted so far, and timed where the slicing has a clock.
  const SliceReport& report() const { return report_; }

  /// Complete when `next` has returned nothing.
  const gcode::PrintTotals& totals() const { return stream_.totals(); }

 private:
  std::optional<engine::Layer> next_layer();

  enum class Step { kHeader, kLayers, kDone };

  engine::AdaptivePlanes layers_;
  engine::Slicer slicer_;
  gcode::GcodeStream stream_;
  Step step_ = Step::kHeader;
  std::size_t layers_sliced_ = 0;
  SlicingFlaws flaws_;
  double (*clock_)() = nullptr;
  SliceReport report_;
};

/// The layers of a model of these bounds, even or adaptive. Throws Failure where there are too many.
engine::AdaptivePlanes plan_layers(const engine::Model& model, const engine::Box3& bounds,
                                   const engine::SlicingPlanesOptions& options);

/// What the user should know of the slicing: one sentence each.
std::vector<std::string> slicing_warnings(const SlicingFlaws& flaws);

/// And of the print that came of it.
std::vector<std::string> print_warnings(const SlicingFlaws& flaws, const gcode::PrintTotals& totals);

}  // namespace lamina::tools
