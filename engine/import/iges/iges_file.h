#pragma once

#include <string>
#include <vector>

#include "engine/import/iges/directory_entry.h"
#include "engine/import/iges/global_section.h"
#include "engine/import/iges/record.h"

namespace lamina::engine {

/// An IGES file cut into lines, its header and its directory read, its entities not yet.
struct IgesFile {
  std::string name;
  IgesRecords records;
  GlobalSection global;
  std::vector<DirectoryEntry> entries;
};

/// Line of the directory section on which entry `index` starts.
inline std::size_t directory_line(std::size_t index) {
  return 2 * index + 1;
}

}  // namespace lamina::engine
