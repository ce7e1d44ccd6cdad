#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/geometry/vector.h"
#include "gcode/gcode_options.h"
#include "gcode/marlin/gcode_line.h"
#include "gcode/marlin/template_variables.h"
#include "gcode/print_outline.h"
#include "gcode/toolpath.h"

namespace lamina::gcode {

/// Writes toolpaths as lines of Marlin G-code with PrusaSlicer's comments: relative extrusion, absolute
/// positions. Lines carry no line feed. The rounding of each E word is carried into the next one, so the sum
/// of all of them is the planned length within half a last digit, however long the print.
class MarlinWriter {
 public:
  MarlinWriter(const GcodeOptions& options, const PrintOutline& outline);

  /// From the first line to the number of layers, start G-code included. Throws TemplateError.
  std::vector<std::string> header() const;

  /// Where the start G-code leaves the nozzle.
  void start_at(const engine::Vector3& position) { position_ = position; }

  /// One layer. Throws TemplateError.
  std::vector<std::string> layer(const LayerToolpath& layer);

  /// End G-code. Throws TemplateError.
  std::vector<std::string> end() const;

  /// Filament fed by the moves written so far, drawing back and pushing out not counted, mm.
  double filament_length() const { return filament_length_; }

 private:
  using Lines = std::vector<std::string>;

  void append_template(const std::string& name, const std::string& text, const TemplateVariables& variables,
                       Lines& lines) const;
  std::size_t write_to_height(const LayerToolpath& layer, Lines& lines);
  void write_layer_settings(const LayerToolpath& layer, Lines& lines);
  void write_move(const Move& move, Lines& lines);
  void write_bead(const Move& move, Lines& lines);
  void write_acceleration(const Move& move, Lines& lines);
  void append_feedrate(double speed, GcodeLine& line);
  double next_extrusion(double length);
  bool append_position(const engine::Vector3& end, GcodeLine& line);

  GcodeOptions options_;
  PrintOutline outline_;
  TemplateVariables variables_;

  engine::Vector3 position_ = engine::Vector3::Zero();  ///< As written, rounded.
  double extrusion_carry_ = 0.0;                        ///< mm planned and not yet written.
  double filament_length_ = 0.0;
  double feedrate_ = 0.0;  ///< Last F word, mm/min.
  double print_acceleration_ = 0.0;
  double travel_acceleration_ = 0.0;
  double fan_ = 0.0;           ///< Last M106 value, 0 to 255.
  Role role_ = Role::kTravel;  ///< Last ";TYPE:".
  double width_ = 0.0;         ///< Last ";WIDTH:".
};

}  // namespace lamina::gcode
