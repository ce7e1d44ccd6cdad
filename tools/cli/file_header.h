#pragma once

#include <cstdint>
#include <string>

#include "profiles/settings.h"

namespace lamina::tools {

/// Fills in what the first lines of a G-code file say: program, version, time and the object's name (made
/// ASCII). The time is that of $SOURCE_DATE_EPOCH where it is set, so that files can be reproduced; now
/// otherwise. Throws Failure when the variable is no time.
void name_print(profiles::Settings& settings, const std::string& object_name);

}  // namespace lamina::tools
