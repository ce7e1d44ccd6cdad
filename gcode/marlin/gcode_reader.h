#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/vector.h"
#include "gcode/marlin/gcode_line.h"
#include "gcode/motion/look_ahead.h"
#include "gcode/motion/machine_limits.h"

namespace lamina::gcode {

/// What a G-code file does, as far as it can be told without a printer.
struct GcodeSummary {
  std::size_t lines = 0;
  std::size_t commands = 0;
  std::size_t layers = 0;            ///< By ";LAYER_CHANGE", without any by extruding at a new height.
  std::size_t announced_layers = 0;  ///< By ";LAYER_COUNT:"; 0 without one.
  engine::Box3 extrusion_bounds;     ///< Around the centre lines of everything extruded, arcs as chords, mm.
  double max_z = 0.0;                ///< Of everything extruded, mm.
  double filament_length = 0.0;      ///< The most that is out of the spool at any time, mm.
  double extrusion_length = 0.0;     ///< Way travelled extruding, mm.
  double travel_length = 0.0;        ///< mm
  double seconds = 0.0;  ///< Estimate: moves and dwells; homing, heating and arcs' curvature are not in it.
  std::size_t arcs = 0;
  std::vector<std::string>
      unreadable;  ///< Up to ten lines that are no G-code, each with its number and reason.
  std::size_t unreadable_lines = 0;
};

/// Reads G-code line by line as a printer would: absolute and relative positions and extrusion (G90, G91,
/// M82, M83), G92, inches (G20, G21), homing as a jump to the origin.
class GcodeReader {
 public:
  explicit GcodeReader(const MachineLimits& limits = {});

  /// Takes one line without its line feed. A line that is no G-code is counted and passed over.
  void read(std::string_view line);

  /// Everything read so far; times of moves still inside the look-ahead window included.
  GcodeSummary summary() const;

  /// Where the nozzle stands, mm.
  const engine::Vector3& position() const { return position_; }

 private:
  void run(const GcodeLine& line);
  void move(const GcodeLine& line);
  void home(const GcodeLine& line);
  void set_position(const GcodeLine& line);
  void read_comment(std::string_view comment);

  GcodeSummary summary_;
  LookAhead machine_;
  engine::Vector3 position_ = engine::Vector3::Zero();
  engine::Vector3 origin_ = engine::Vector3::Zero();  ///< Set by G92: position = word + origin.
  double extruder_ = 0.0;                             ///< The E position that absolute words refer to, mm.
  double filament_ = 0.0;                             ///< Out of the spool now, mm.
  double feedrate_ = 1000.0;                          ///< mm/min
  double unit_ = 1.0;                                 ///< mm
  bool relative_ = false;
  bool relative_extrusion_ = false;
  bool marked_layers_ = false;
  double last_layer_z_ = 0.0;
};

/// Reads a whole file.
GcodeSummary summarize(std::istream& file, const MachineLimits& limits = {});

}  // namespace lamina::gcode
