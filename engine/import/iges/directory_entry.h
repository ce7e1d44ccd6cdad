#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/import/iges/tolerance_log.h"

namespace lamina::engine {

/// Entity use flag of the status number (IGES 5.3, section 2.2.4.4.9.3).
enum class EntityUse { kGeometry, kAnnotation, kDefinition, kOther, kLogical, kParametric, kConstruction };

/// One entity of the directory section. Pointers are line numbers of a section, from 1; 0 is none.
struct DirectoryEntry {
  int type = 0;
  int form = 0;
  std::size_t parameter_line = 0;
  std::size_t parameter_line_count = 0;  ///< as stated, 0 where it is not
  std::size_t transform = 0;             ///< directory line of a 124
  bool is_blanked = false;
  bool is_physically_dependent = false;
  EntityUse use = EntityUse::kGeometry;
};

/// Reads the directory section: two lines an entity, so entry i stands on lines 2 i + 1 and 2 i + 2. Throws
/// ImportError, naming `file`, where a field is no number or the two lines of an entry do not belong
/// together.
std::vector<DirectoryEntry> parse_directory(const std::vector<std::string_view>& lines,
                                            const std::string& file, ToleranceLog& log);

}  // namespace lamina::engine
