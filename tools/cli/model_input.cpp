#include "tools/cli/model_input.h"

#include <iostream>
#include <utility>

#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "tools/cli/failure.h"

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

ModelInput read_models(const std::vector<std::string>& files, ProgressBar& bar) {
  if (files.empty()) throw Failure(ExitCode::kUsage, "a model is missing", "name one or more files");
  ModelInput input;
  for (const std::string& file : files) {
    bar.begin("Reading " + file);
    engine::ImportResult import = engine::read_model(file);
    bar.clear();
    for (const std::string& warning : import_warnings(import.report))
      input.warnings.push_back(files.size() == 1 ? warning : import.model.name + ": " + warning);
    input.models.push_back(std::move(import.model));
  }
  return input;
}

void say_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
}

}  // namespace lamina::tools
