#include "tools/cli/json.h"

namespace lamina::tools {
namespace {

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string to_text(const Json& json) {
  return dumped(json, 2);
}

std::string to_line(const Json& json) {
  return dumped(json, -1);
}

Json to_json(const engine::Box3& box) {
  if (box.isEmpty()) return nullptr;
  return {{"min", {box.min().x(), box.min().y(), box.min().z()}},
          {"max", {box.max().x(), box.max().y(), box.max().z()}}};
}

}  // namespace lamina::tools
