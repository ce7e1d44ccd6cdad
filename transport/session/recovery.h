#pragma once

#include <optional>
#include <string>
#include <vector>

#include "transport/session/journal.h"
#include "transport/session/parking.h"

namespace lamina::transport {

/// What a printer that has restarted in the middle of a print must be brought to, so that the first source
/// line that may be lost (the one at record.position) can run again. Moves that were in the planner are lost,
/// and nobody knows how many of them: everything behind the last line that is certainly settled is printed
/// again.
MachineState recovery_goal(const JournalRecord& record);

/// The lowest place at which the nozzle may have stopped: one that is called lower than it is makes a gap,
/// one that is called higher digs the nozzle into the part. None: unknown.
std::optional<double> lowest_height(const JournalRecord& record);

/// Brings a printer that has restarted on an unfinished part (`from`: nothing but the height at which its
/// nozzle stands is known) to `to`: heats, calls the height by its name, raises, homes X and Y (never Z: the
/// part is in the way), primes, goes back. What it relies on: nobody has moved the Z axis since.
std::vector<std::string> recover_commands(const MachineState& from, const MachineState& to,
                                          const ParkOptions& options);

/// Why a print cannot go on from `goal` after a restart, one phrase; none if it can.
std::optional<std::string> unrecoverable(const MachineState& goal);

}  // namespace lamina::transport
