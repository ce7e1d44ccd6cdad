#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/model.h"

namespace lamina::tools {

using Triangle = std::array<engine::Vector3, 3>;

/// A part of a corpus model that was given a defect: nothing is promised about it and what it borders on.
struct Damage {
  std::string defect;               ///< such as gap-all-sides
  engine::Box3 box;                 ///< around the part, larger by what the defect reaches
  std::optional<Triangle> facet{};  ///< where the part is a facet: only what is near it counts
};

/// What the list beside a model (part.defects.txt beside part.igs) says, its surfaces' boxes larger by the
/// amount and a tenth of a millimetre; empty where there is none. Throws std::runtime_error on a line that
/// cannot be read.
std::vector<Damage> listed_damage(const std::filesystem::path& model_file, const engine::Model& model);

/// The facets that only one of the two has, by their corners in any order and to the last bit: holes, moved
/// corners, fins, walls within. A facet that is turned over or there twice leaves the surface as it is and is
/// no damage.
std::vector<Damage> facet_damage(const engine::Model& broken, const engine::Model& clean);

/// All that is known of a model: its list, and what tells part_broken.stl from part_clean.stl beside it.
std::vector<Damage> damage_of(const std::filesystem::path& model_file, const engine::Model& model);

/// Whether a place lies in a damaged surface's box, or within a tenth of a millimetre of a damaged facet.
bool is_damaged(const std::vector<Damage>& damage, const engine::Vector3& place);

}  // namespace lamina::tools
