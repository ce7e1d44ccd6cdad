#pragma once

#include <string>

#include "engine/import/iges/global_section.h"
#include "engine/import/iges/tolerance_log.h"
#include "engine/import/import_report.h"

namespace lamina::engine {

/// The unit that flag and name of the global section state (IGES 5.3, section 2.2.4.3.14). The flag decides,
/// flag 3 hands over to the name, an empty flag too; the standard's default where both are empty is the inch.
/// Throws ImportError, naming `file`, where the name is needed and not known.
FileUnit file_unit(const GlobalSection& global, const std::string& file, ToleranceLog& log);

}  // namespace lamina::engine
