#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lamina::profiles {

/// The candidate that `name` was most likely meant to be: the fewest inserted, removed, replaced or swapped
/// neighbouring letters (optimal string alignment; Damerau 1964), the first of equals. Empty when none is
/// within a third of the letters.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "did you mean 'x'?", or `otherwise` when nothing is near.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates,
                       const std::string& otherwise = {});

}  // namespace lamina::profiles
