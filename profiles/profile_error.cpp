#include "profiles/profile_error.h"

#include <utility>

#include <fmt/format.h>

namespace lamina::profiles {
namespace {

std::string message(const ProfileError::Fields& fields) {
  const std::string place = fields.origin.source.empty() ? "" : to_text(fields.origin) + ": ";
  const std::string hint = fields.hint.empty() ? "" : fmt::format(" ({})", fields.hint);
  return place + fields.problem + hint;
}

}  // namespace

std::string to_text(const Origin& origin) {
  if (origin.source.empty()) return "default";
  if (origin.line == 0) return origin.source;
  return fmt::format("{}:{}:{}", origin.source, origin.line, origin.column);
}

ProfileError::ProfileError(Fields fields) : std::runtime_error(message(fields)), fields_(std::move(fields)) {}

}  // namespace lamina::profiles
