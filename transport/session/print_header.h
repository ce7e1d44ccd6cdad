#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace lamina::transport {

/// What a slicer wrote into its file about the printer that it is for. lamina, PrusaSlicer and its kin, Cura.
struct PrintHeader {
  std::string generator;  ///< as it calls itself; empty: unknown
  std::string flavor;     ///< "marlin", "Marlin", "klipper", "RepRap", ...; empty: unknown
  std::string printer;    ///< its name; empty: unknown
  std::optional<std::array<double, 3>> low, high;          ///< mm: what is printed reaches from here to there
  std::optional<std::array<double, 2>> bed_low, bed_high;  ///< mm: the bed that it was sliced for
  std::optional<double> bed_height;
  std::optional<double> nozzle;  ///< deg C, the hottest
  std::optional<double> bed;     ///< deg C, the hottest
  std::optional<double> seconds;
  std::optional<int> layers;
  std::optional<int> extruders;  ///< highest tool used, and one

  /// Takes one line of the file: comments and, of commands, those that heat and change tools.
  void read(std::string_view line);

 private:
  void read_comment(std::string_view comment);
  void read_entry(std::string_view key, std::string_view value);
};

}  // namespace lamina::transport
