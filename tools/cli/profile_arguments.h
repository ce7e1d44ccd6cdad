#pragma once

#include <optional>
#include <string>
#include <vector>

#include "profiles/resolve.h"
#include "tools/cli/command_line.h"

namespace lamina::tools {

/// How to slice: options that several verbs share. Each is a setting with a name of its own.
struct SlicingArguments {
  std::optional<std::string> layer_height;
  std::optional<std::string> tolerance;
  std::optional<std::string> degree;
  std::optional<std::string> bridge;
  std::optional<std::string> slice_at;
  int threads = 0;  ///< that slice; 0: one a core. The result is the same for any number.

  void declare(OptionSet& options);
  std::vector<profiles::Assignment> assignments() const;
};

/// Which profiles, and what is set on top of them.
struct ProfileArguments {
  profiles::ProfileChoice choice;
  std::vector<std::string> settings;  ///< key=value

  void declare(OptionSet& options);
};

/// The profiles of $LAMINA_PROFILE_PATH and the built-in ones. Throws ProfileError.
profiles::ProfileStore profile_store();

/// The settings that these arguments ask for; `settings` come after the slicing options. Throws ProfileError.
profiles::ResolvedProfile resolve(const ProfileArguments& profile, const SlicingArguments& slicing = {});

}  // namespace lamina::tools
