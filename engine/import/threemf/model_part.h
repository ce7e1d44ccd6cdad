#pragma once

#include <string>

#include "engine/import/breach_log.h"
#include "engine/import/threemf/package.h"
#include "engine/import/threemf/zip_archive.h"

namespace lamina::engine {

/// Reads the model part `name` of the archive. Throws ImportError, naming `file`.
ModelPart read_model_part(ZipArchive& archive, const std::string& name, const std::string& file,
                          BreachLog& log);

/// Name of the part that holds the build, as the relationships of the package say.
std::string find_root_part(ZipArchive& archive, const std::string& file);

}  // namespace lamina::engine
