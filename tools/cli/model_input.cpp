#include "tools/cli/model_input.h"

#include <iostream>

#include <fmt/format.h>

namespace lamina::tools {

std::vector<std::string> import_warnings(const engine::ImportReport& report) {
  std::vector<std::string> warnings;
  for (const engine::SkippedEntities& skipped : report.skipped) {
    warnings.push_back(fmt::format("skipped {} x entity {} ({}), first at directory line {}: {}",
                                   skipped.count, skipped.type, skipped.name, skipped.first_directory_line,
                                   skipped.reason));
  }
  for (const engine::ToleratedBreach& breach : report.tolerated) {
    const std::string place =
        breach.line == 0 ? "" : fmt::format(", first at {} line {}", breach.section, breach.line);
    warnings.push_back(fmt::format("tolerated {} x{}: {}", breach.count, place, breach.what));
  }
  return warnings;
}

void say_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
}

}  // namespace lamina::tools
