#pragma once

#include <string_view>

#include "gcode/toolpath.h"

namespace lamina::gcode {

/// The name that PrusaSlicer's viewers know for a role, for ";TYPE:" comments.
std::string_view role_name(Role role);

/// The role with that name; kTravel for a name that none has, such as "Custom".
Role role_of_name(std::string_view name);

}  // namespace lamina::gcode
