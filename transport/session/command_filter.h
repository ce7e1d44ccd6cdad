#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "transport/session/machine_state.h"

namespace lamina::transport {

/// What the filter remembers from line to line.
struct FilterState {
  MachineState file;                  ///< the printer as the file believes it to be
  std::optional<std::string> object;  ///< the one being printed, where the file tells
  bool other_plane = false;           ///< G18 or G19: arcs do not lie in X and Y
  std::set<std::string> skipped;      ///< objects that are left out
  /// While an object is left out here: the printer as it was when that began.
  std::optional<MachineState> skipping_from;

  bool operator==(const FilterState&) const = default;
};

/// What the firmware can take. DEFAULT: everything, as long as nobody has asked it.
struct FirmwareDialect {
  bool arcs = true;               ///< G2, G3
  bool bezier = true;             ///< G5
  bool progress = true;           ///< M73
  bool objects = false;           ///< M486
  std::set<std::string> lacking;  ///< codes that it called unknown

  bool operator==(const FirmwareDialect&) const = default;
};

struct FilterOptions {
  /// Of an arc or curve that is sent as chords: how far they may be from it, mm.
  double chord_tolerance = 0.01;
};

/// Source lines become what this printer understands: comments and line numbers off, codes that the firmware
/// lacks left out, arcs and curves as chords where it knows none, skipped objects left out with the printer's
/// modes, position and filament kept right.
class CommandFilter {
 public:
  explicit CommandFilter(FilterOptions options = {});

  /// The commands that one source line becomes; none for a comment.
  std::vector<std::string> push(std::string_view line);

  void set_dialect(FirmwareDialect dialect) { dialect_ = std::move(dialect); }
  const FirmwareDialect& dialect() const { return dialect_; }
  void lacks(const std::string& code) { dialect_.lacking.insert(code); }

  /// Leaves `object` out from here on, if it is being printed from its next line on.
  void skip_object(const std::string& object) { state_.skipped.insert(object); }

  const FilterState& state() const { return state_; }
  void restore(FilterState state) { state_ = std::move(state); }

  /// Objects that the file has named so far.
  const std::set<std::string>& objects() const { return objects_; }

 private:
  void enter_object(std::optional<std::string> object, std::vector<std::string>& commands);
  void run(std::string command, std::vector<std::string>& commands);

  FilterOptions options_;
  FirmwareDialect dialect_;
  FilterState state_;
  std::set<std::string> objects_;
};

}  // namespace lamina::transport
