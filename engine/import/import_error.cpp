#include "engine/import/import_error.h"

#include <utility>

#include <fmt/format.h>

namespace lamina::engine {
namespace {

std::string message(const ImportPlace& place, const std::string& problem, const std::string& hint) {
  std::string text = place.file;
  if (place.entity_type != 0) {
    text += fmt::format(": entity {} (directory line {}", place.entity_type, place.directory_line);
    if (place.line != 0 && place.section != "directory")
      text += fmt::format(", {} line {}", place.section, place.line);
    text += ")";
  } else if (place.line != 0) {
    text += fmt::format(": {} line {}", place.section, place.line);
  } else if (!place.section.empty()) {
    text += fmt::format(": {} section", place.section);
  }
  text += ": " + problem;
  if (!hint.empty()) text += "; " + hint;
  return text;
}

}  // namespace

ImportError::ImportError(ImportPlace place, const std::string& problem, std::string hint)
    : std::runtime_error(message(place, problem, hint)), place_(std::move(place)), hint_(std::move(hint)) {}

}  // namespace lamina::engine
