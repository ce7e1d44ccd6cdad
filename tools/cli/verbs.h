#pragma once

#include "tools/cli/command_line.h"

namespace lamina::tools {

Verb slice_verb();
Verb print_verb();
Verb emulate_verb();
Verb contours_verb();
Verb info_verb();
Verb profiles_verb();
Verb sd_verb();
Verb ports_verb();
Verb replay_verb();

}  // namespace lamina::tools
