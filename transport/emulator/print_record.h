#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "transport/emulator/emulator_options.h"
#include "transport/emulator/planner.h"

namespace lamina::transport {

/// One extruded move that was run to its end.
struct Bead {
  std::array<double, 3> from{};  ///< mm
  std::array<double, 3> to{};    ///< mm
  double filament = 0;           ///< mm of filament that left the nozzle on the way

  bool operator==(const Bead&) const = default;
};

/// Sums over a print. Lengths in mm, volumes in mm^3.
struct PrintReport {
  double filament = 0;  ///< filament that left the nozzle: pushed, less what only made up for a retraction
  double volume = 0;    ///< the same as plastic
  double filament_fed = 0;          ///< net movement of the extruder, retractions counted as negative
  std::int64_t beads = 0;           ///< moves that extruded along a way
  std::int64_t moves = 0;           ///< all moves that were run
  std::int64_t layers = 0;          ///< different heights at which something was extruded along a way
  std::array<double, 3> box_min{};  ///< of the extruded moves
  std::array<double, 3> box_max{};
  Duration moving{};  ///< from the start of the first move to the end of the last
  std::int64_t underruns =
      0;  ///< the planner ran dry in the middle of extruding, and more came without a wished-for stop
  Duration starved{};  ///< how long it was dry, in all
  Duration longest_starved{};
  std::int64_t cold_extrusions = 0;  ///< moves whose extrusion the firmware prevented
  std::int64_t too_long_extrusions = 0;
  std::int64_t outside_moves = 0;  ///< moves to a place outside the bed
  std::int64_t lines_run = 0;      ///< commands run
  std::int64_t unknown_commands = 0;
  std::int64_t refused_lines = 0;    ///< lines answered with an error and a resend request
  std::int64_t duplicate_lines = 0;  ///< lines received again and dropped
  std::int64_t bytes_lost = 0;       ///< bytes that found the receive buffer full
  /// Numbered lines that were run a second time, or never: M110 lets both happen.
  std::int64_t doubled_lines = 0;
  std::int64_t skipped_lines = 0;
  /// Commands without a number that were obeyed in a numbered conversation, such as the tails of lines that
  /// the error flush has cut; and those of them that move.
  std::int64_t unnumbered_commands = 0;
  std::int64_t unnumbered_moves = 0;
  /// The longest time that the nozzle stood still, hot and with the filament not drawn back, between two
  /// moves.
  Duration longest_ooze{};
};

/// Writes down what the printer does.
class PrintRecord {
 public:
  PrintRecord(RecordDetail detail, double filament_diameter);

  /// A move has been run to its end; `deposited` of it is filament in mm.
  void add(const PlannedMove& move);

  /// The extruder has `length` mm to push or, negative, to draw back. Returns how much of it leaves the
  /// nozzle.
  double deposit(double length);

  /// The beads so far; empty unless RecordDetail::kBeads.
  const std::vector<Bead>& beads() const { return beads_; }

  /// The sums; the counters are the caller's to raise.
  PrintReport& report() { return report_; }
  const PrintReport& report() const { return report_; }

 private:
  RecordDetail detail_;
  double filament_area_;  // mm^2
  double retracted_ = 0;  // mm
  std::vector<Bead> beads_;
  std::set<std::int64_t> heights_;  // um
  PrintReport report_;
};

}  // namespace lamina::transport
