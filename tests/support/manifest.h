#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/corpus.h"

namespace lamina::tests {

/// One row of the corpus's table, its cells without blanks around them: the file is cell 1, then source,
/// units, box, entities, faces, whether it is watertight, volume (cell 8) and area.
using ManifestRow = std::vector<std::string>;

/// The rows of models whose file has one of the extensions (".ig" stands for .igs and .iges).
inline std::vector<ManifestRow> manifest_rows(const std::vector<std::string>& extensions) {
  constexpr std::size_t kCells = 10;
  std::vector<ManifestRow> rows;
  std::ifstream manifest(corpus_file("MANIFEST.md"));
  for (std::string line; std::getline(manifest, line);) {
    ManifestRow row;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, '|');) {
      const auto first = cell.find_first_not_of(' ');
      row.push_back(first == std::string::npos ? ""
                                               : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
    if (row.size() < kCells) continue;
    for (const std::string& extension : extensions) {
      if (row[1].find(extension) == std::string::npos) continue;
      rows.push_back(row);
      break;
    }
  }
  return rows;
}

}  // namespace lamina::tests
