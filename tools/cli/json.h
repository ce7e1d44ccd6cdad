#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "engine/geometry/vector.h"

namespace lamina::tools {

/// A JSON value whose keys keep the order in which they were set.
using Json = nlohmann::ordered_json;

/// Its text, over several lines; bytes that are no UTF-8 become U+FFFD.
std::string to_text(const Json& json);

/// The same in one line.
std::string to_line(const Json& json);

/// {"min": [x, y, z], "max": [x, y, z]}, or null for an empty box.
Json to_json(const engine::Box3& box);

}  // namespace lamina::tools
