#pragma once

#include <string_view>
#include <vector>

#include "profiles/key.h"

namespace lamina::profiles {

/// Every setting that a profile or `-s key=value` can give, each declared once, in the order in which they
/// are shown.
const std::vector<Key>& key_table();

/// The key of that name. Throws ProfileError with the nearest name when there is none.
const Key& find_key(std::string_view name, const Origin& origin);

}  // namespace lamina::profiles
