#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "profiles/profile.h"

namespace lamina::profiles {

/// Where profiles are found by name: in folders that hold printers/, filaments/ and qualities/, the first
/// folder first, then among those compiled into the library. The file of profile "x" is x.toml.
class ProfileStore {
 public:
  /// Throws ProfileError for a folder that does not exist.
  explicit ProfileStore(std::vector<std::filesystem::path> folders = {});

  /// Names of all profiles of a kind, sorted, each once.
  std::vector<std::string> names(ProfileKind kind) const;

  /// The profile of that name, or of that file when the name ends in ".toml". `wanted_by` is where the name
  /// was written. Throws ProfileError, with the nearest name when there is none of this name.
  Profile load(ProfileKind kind, const std::string& name, const Origin& wanted_by = {}) const;

  /// The profile and those it inherits from, the root first. Throws ProfileError for a cycle.
  std::vector<Profile> load_chain(ProfileKind kind, const std::string& name,
                                  const Origin& wanted_by = {}) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// The folders of a search path as in $LAMINA_PROFILE_PATH: separated by colons, empty ones left out.
std::vector<std::filesystem::path> split_search_path(const std::string& search_path);

}  // namespace lamina::profiles
