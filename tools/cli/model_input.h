#pragma once

#include <string>
#include <vector>

#include "engine/import/import_result.h"
#include "tools/cli/progress_bar.h"

namespace lamina::tools {

/// What was skipped or put right while a model was read: one sentence each.
std::vector<std::string> import_warnings(const engine::ImportReport& report);

/// The kinds of files that are read, as the help names them.
inline constexpr const char* kModelFiles = "IGES, STEP, STL, OBJ, 3MF, PLY, PCD or XYZ file, also with .gz";

struct ModelInput {
  std::vector<engine::Model> models;
  std::vector<std::string> warnings;  ///< with the file's name where there are several
};

/// Reads every file. Throws ImportError, and Failure where none is given.
ModelInput read_models(const std::vector<std::string>& files, ProgressBar& bar);

/// Prints each as "warning: ..." on stderr.
void say_warnings(const std::vector<std::string>& warnings);

}  // namespace lamina::tools
