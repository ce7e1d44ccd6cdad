#pragma once

#include <string>
#include <vector>

#include "profiles/key.h"
#include "profiles/profile_store.h"

namespace lamina::profiles {

/// One setting of the command line.
struct Assignment {
  std::string key;
  std::string value;   ///< As written.
  std::string source;  ///< The option that wrote it, such as "--layer-height 0.3".
};

/// "key=value" taken apart. Throws ProfileError when there is no '='.
Assignment parse_assignment(const std::string& text);

/// What is to be resolved: three names and what the command line adds.
struct ProfileChoice {
  std::string printer = "generic_marlin_220";
  std::string filament = "pla";
  std::string quality = "normal";
  std::vector<Assignment> assignments;
};

struct ResolvedValue {
  Key key;
  Value value;
  Origin origin;  ///< Of the last one who set it.
};

/// Every key's value, in the order of key_table(), and the option structs that hold them.
struct ResolvedProfile {
  std::string printer;
  std::string filament;
  std::string quality;
  Settings settings;
  std::vector<ResolvedValue> values;

  /// The value of that key. The key must exist.
  const ResolvedValue& at(const std::string& key) const;
};

/// Resolves a choice; the last one who sets a key wins: built-in defaults < quality < filament < printer <
/// what the printer overrides for this filament and quality < assignments. Within a kind, the inheriting
/// profile wins. Throws ProfileError.
ResolvedProfile resolve(const ProfileStore& store, const ProfileChoice& choice);

}  // namespace lamina::profiles
