#pragma once

#include <string>
#include <vector>

#include "profiles/profile_error.h"
#include "profiles/value.h"

namespace lamina::profiles {

/// One key of a TOML document, with its place.
struct TomlEntry {
  std::string key;  ///< Tables joined by dots, such as "infill.density".
  Value value;
  Origin origin;
};

/// Every key of a TOML document, in the order of the file. `source` names it in errors. Throws ProfileError
/// with line and column for broken TOML and for arrays and dates, which no setting takes.
std::vector<TomlEntry> parse_toml(const std::string& text, const std::string& source);

}  // namespace lamina::profiles
