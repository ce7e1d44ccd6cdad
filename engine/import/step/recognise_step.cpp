#include "engine/import/step/read_step.h"

namespace lamina::engine {
namespace {

/// The beginning without what editors put in front.
std::string_view head(std::string_view bytes) {
  constexpr std::size_t kLongEnough = 256;
  const std::string_view start = bytes.substr(0, kLongEnough);
  const auto first = start.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return first == std::string_view::npos ? std::string_view{} : start.substr(first);
}

}  // namespace

bool looks_like_step(std::string_view bytes) {
  return head(bytes).substr(0, 12) == "ISO-10303-21";
}

bool looks_like_brep(std::string_view bytes) {
  const std::string_view start = head(bytes);
  return start.substr(0, 13) == "DBRep_Drawabl" || start.substr(0, 18) == "CASCADE Topology V";
}

}  // namespace lamina::engine
