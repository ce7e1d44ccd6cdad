#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "transport/session/command_session.h"

namespace lamina::transport {

// The SD card of a printer, as M20 to M30 show it: what to read out of the answers.

struct CardFile {
  std::string name;       ///< as M23 wants it, "PART.GCO"
  std::int64_t size = 0;  ///< bytes; -1: not told
  std::string long_name;  ///< where the firmware gives one
};

/// The files in an answer to M20; none where the printer has no card in it.
std::optional<std::vector<CardFile>> card_files(const CommandAnswer& answer);

/// How far the card's print is (M27).
struct CardProgress {
  std::int64_t position = 0;
  std::int64_t size = 0;
};

/// None: nothing is being printed from the card.
std::optional<CardProgress> card_progress(const CommandAnswer& answer);

/// What went wrong, in the printer's words; none if nothing did. For M23, M28, M29 and M30.
std::optional<std::string> card_complaint(const CommandAnswer& answer);

/// A name that every card takes, eight letters and three, from a file's name: "my part v2.gcode" ->
/// "MYPARTV2.GCO".
std::string card_name(const std::string& file_name);

}  // namespace lamina::transport
