#include "engine/import/iges/units.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

struct Unit {
  int flag;
  std::string_view name;
  double millimetres;
};

constexpr int kFlagByName = 3;

constexpr std::array<Unit, 12> kUnits{{{1, "INCH", 25.4},
                                       {1, "IN", 25.4},
                                       {2, "MM", 1.0},
                                       {4, "FT", 304.8},
                                       {5, "MI", 1609344.0},
                                       {6, "M", 1000.0},
                                       {7, "KM", 1e6},
                                       {8, "MIL", 0.0254},
                                       {9, "UM", 0.001},
                                       {10, "CM", 10.0},
                                       {11, "UIN", 25.4e-6},
                                       {2, "MILLIMETER", 1.0}}};

std::string upper_case(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

const Unit* by_flag(int flag) {
  for (const Unit& unit : kUnits) {
    if (unit.flag == flag) return &unit;
  }
  return nullptr;
}

const Unit* by_name(const std::string& name) {
  for (const Unit& unit : kUnits) {
    if (unit.name == name) return &unit;
  }
  return nullptr;
}

}  // namespace

FileUnit file_unit(const GlobalSection& global, const std::string& file, ToleranceLog& log) {
  FileUnit found{global.unit_flag, global.unit_name, 25.4};
  const Unit* flagged = by_flag(global.unit_flag);
  const Unit* named = by_name(upper_case(global.unit_name));
  if (flagged != nullptr) {
    found.millimetres = flagged->millimetres;
    if (named != nullptr && named->flag != flagged->flag) {
      log.note(Tolerance::kUnitConflict, "global", 1,
               fmt::format("{}, {}", global.unit_flag, global.unit_name));
    }
    return found;
  }
  if (named != nullptr) {
    found.millimetres = named->millimetres;
    if (global.unit_flag != kFlagByName) {
      log.note(Tolerance::kUnitMissing, "global", 1,
               fmt::format("{}, name {} used", global.unit_flag, named->name));
    }
    return found;
  }
  if (global.unit_flag == kFlagByName || !global.unit_name.empty()) {
    throw ImportError(
        {.file = file, .section = "global"},
        fmt::format("the unit of length \"{}\" (flag {}) is not known", global.unit_name, global.unit_flag),
        "use one of IN, MM, FT, MI, M, KM, MIL, UM, CM, UIN");
  }
  log.note(Tolerance::kUnitMissing, "global", 1, fmt::format("{}, inch assumed", global.unit_flag));
  return found;
}

}  // namespace lamina::engine
