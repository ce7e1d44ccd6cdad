#pragma once

#include <string_view>
#include <vector>

namespace lamina::profiles {

/// A profile file that was compiled into the library.
struct EmbeddedProfile {
  std::string_view path;  ///< Below profiles/, such as "printers/ender3.toml".
  std::string_view text;
};

/// All of them; the source is written by the build from the TOML files.
const std::vector<EmbeddedProfile>& embedded_profiles();

}  // namespace lamina::profiles
