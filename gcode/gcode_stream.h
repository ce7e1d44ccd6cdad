#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/layer.h"
#include "gcode/gcode_options.h"
#include "gcode/marlin/gcode_reader.h"
#include "gcode/marlin/writer.h"
#include "gcode/motion/look_ahead.h"
#include "gcode/plan/planner.h"
#include "gcode/print_outline.h"
#include "gcode/print_totals.h"

namespace lamina::gcode {

/// From contours to G-code, one layer at a time: layers in, lines (without line feeds) out. It runs regions,
/// planning, cooling, times and writing one after the other and keeps no more layers than the planner does.
///
///     GcodeStream stream(options, outline);
///     print(stream.begin());
///     for (each layer in rising z) print(stream.push(layer));
///     print(stream.finish());
class GcodeStream {
 public:
  /// Throws FitError when the outline does not fit the printer, TemplateError for a start G-code that cannot
  /// be filled in, PlanError for options that nothing can be planned with.
  GcodeStream(const GcodeOptions& options, const PrintOutline& outline);

  /// The lines before the first layer.
  const std::vector<std::string>& begin() const { return header_; }

  /// The lines of the layers that are finished now. Throws FitError when a layer with its skirt or brim does
  /// not fit the printer, PlanError and TemplateError.
  std::vector<std::string> push(const engine::Layer& layer);

  /// The rest, end G-code and statistics.
  std::vector<std::string> finish();

  /// What has been written so far; complete after finish().
  const PrintTotals& totals() const { return totals_; }

 private:
  void write(std::vector<LayerToolpath> layers, std::vector<std::string>& lines);
  void add_time(const TimedSegment& timed);

  GcodeOptions options_;
  MarlinWriter writer_;
  std::vector<std::string> header_;
  GcodeReader start_;         ///< What the header does.
  engine::Vector3 position_;  ///< Where the last planned move ends.
  Planner planner_;
  LookAhead machine_;
  PrintTotals totals_;
};

}  // namespace lamina::gcode
