#pragma once

#include <string>
#include <vector>

#include "engine/import/import_result.h"

namespace lamina::tools {

/// What was skipped or put right while a model was read: one sentence each.
std::vector<std::string> import_warnings(const engine::ImportReport& report);

/// Prints each as "warning: ..." on stderr.
void say_warnings(const std::vector<std::string>& warnings);

}  // namespace lamina::tools
