#pragma once

#include <optional>
#include <string>
#include <vector>

#include "profiles/toml_entries.h"

namespace lamina::profiles {

enum class ProfileKind { kPrinter, kFilament, kQuality };

/// "printer", "filament", "quality".
std::string to_text(ProfileKind kind);

/// Settings that a printer makes for one filament or quality, and for those that inherit from it.
struct ProfileOverride {
  ProfileKind kind = ProfileKind::kFilament;
  std::string name;  ///< Of the filament or quality.
  TomlEntry entry;   ///< Its key is the setting's.
};

/// One profile file, as it stands; nothing inherited.
struct Profile {
  ProfileKind kind = ProfileKind::kPrinter;
  std::string name;
  std::string description;
  std::string source;                 ///< The file it was read from.
  std::optional<TomlEntry> inherits;  ///< Its value is the parent's name.
  std::vector<TomlEntry> settings;
  std::vector<ProfileOverride> overrides;  ///< Only of a printer.
};

/// Reads a profile's text. Throws ProfileError when it is no profile of that kind, when its schema is not 1,
/// or when a key is unknown or a value wrong.
Profile read_profile(const std::string& text, const std::string& source, ProfileKind kind);

}  // namespace lamina::profiles
