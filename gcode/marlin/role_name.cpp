#include "gcode/marlin/role_name.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lamina::gcode {
namespace {

// Two roles share a name where the dialect knows one: the first is what reading gives back.
constexpr std::array<std::pair<Role, std::string_view>, 11> kNames{{
    {Role::kOuterWall, "External perimeter"},
    {Role::kInnerWall, "Perimeter"},
    {Role::kSparseInfill, "Internal infill"},
    {Role::kSolidInfill, "Solid infill"},
    {Role::kBottomSurface, "Solid infill"},
    {Role::kTopSurface, "Top solid infill"},
    {Role::kBridge, "Bridge infill"},
    {Role::kGapFill, "Gap fill"},
    {Role::kSkirt, "Skirt/Brim"},
    {Role::kBrim, "Skirt/Brim"},
    {Role::kSupport, "Support material"},
}};

}  // namespace

std::string_view role_name(Role role) {
  const auto* const entry = std::ranges::find(kNames, role, &std::pair<Role, std::string_view>::first);
  return entry == kNames.end() ? "Custom" : entry->second;
}

Role role_of_name(std::string_view name) {
  const auto* const entry = std::ranges::find(kNames, name, &std::pair<Role, std::string_view>::second);
  return entry == kNames.end() ? Role::kTravel : entry->first;
}

}  // namespace lamina::gcode
