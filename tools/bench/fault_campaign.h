#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transport/emulator/print_on_emulator.h"

namespace lamina::tools {

/// A print that faults can be tried on: the start of a G-code file and some hundred lines from the middle of
/// it.
struct ShortPrint {
  std::vector<std::string> lines;
  std::vector<transport::Bead> beads;  ///< what it deposits when nothing goes wrong
  std::int64_t commands = 0;           ///< lines that reach the printer
};

/// `count` prints of about `length` lines, cut from `gcode` at layer changes that lie evenly over it. Throws
/// std::runtime_error if one of them fails although nothing goes wrong.
std::vector<ShortPrint> short_prints(const std::vector<std::string>& gcode, std::size_t count,
                                     std::size_t length);

/// What goes wrong in one print, and over which link.
struct FaultPlan {
  transport::EmulatedPrintOptions options;
  bool fatal = false;       ///< one of the faults ends the print
  std::string description;  ///< one line
};

/// The schedule of that seed: a link (speed, latency, kind of ok, packing), faults by chance at rates up to
/// `highest_rate` a byte, and some to order. Damaged bytes keep a line's length apart: two in one line can
/// cancel out in Marlin's checksum, an exclusive or, whatever the host does; and links that may pack get no
/// bytes put in from nowhere on the way to the printer, which it does not see either where they stand for two
/// equal characters.
FaultPlan random_plan(std::uint64_t seed, std::size_t window, double highest_rate);

/// What came of it.
struct FaultVerdict {
  bool completed = false;
  bool same_beads = false;
  std::int64_t errors = 0;           ///< lines refused
  std::int64_t stray_commands = 0;   ///< obeyed without a number: tails of lines
  std::int64_t stray_moves = 0;      ///< those of them that moved
  std::int64_t strays_reported = 0;  ///< by the protocol engine
  std::int64_t bytes = 0;            ///< sent
  double seconds = 0;                ///< simulated
  std::string failure;               ///< of the print
  std::string violation;             ///< of what is promised; empty if all was kept
};

FaultVerdict try_plan(const ShortPrint& print, const FaultPlan& plan);

}  // namespace lamina::tools
