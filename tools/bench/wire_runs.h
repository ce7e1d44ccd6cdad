#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transport/emulator/print_on_emulator.h"

namespace lamina::tools {

/// A link, and how it is used.
struct WireCase {
  int baud = 115200;
  transport::Duration latency{};  ///< of the printer's answers, through packets of 62 bytes
  bool advanced_ok = false;
  bool meatpack = false;
  bool window = true;  ///< else one line at a time
};

/// How much of the link a print made use of.
struct WireUse {
  double lines_per_second = 0;
  double limit = 0;             ///< lines/s that the wire can carry: its bytes, back to back
  std::int64_t bytes_lost = 0;  ///< by overruns of the receive buffer
  std::int64_t underruns = 0;
  double told_starved = 0;  ///< s of motion that the host says were lost for want of lines
  double moving = 0;        ///< s

  double share() const { return limit > 0 ? lines_per_second / limit : 0; }
};

/// `count` chords of 0.2 mm of a circle of 40 mm radius, `speed` mm/s, with what a print has before.
std::vector<std::string> circle_of_chords(int count, double speed);

/// Prints on a machine that is never the bottleneck: what the wire and its use allow.
WireUse measure_wire(const std::vector<std::string>& lines, const WireCase& wire);

/// Prints on a machine with the usual limits: what the use of the wire does to the motion.
WireUse measure_motion(const std::vector<std::string>& lines, const WireCase& wire);

/// The emulator of such a link, and the link itself, for a host of the real world.
transport::EmulatorOptions tireless_printer(const WireCase& wire);

}  // namespace lamina::tools
