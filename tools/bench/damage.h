#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/model.h"

namespace lamina::tools {

/// A surface that a corpus model was given a defect at: nothing is promised about it and what it borders on.
struct Damage {
  std::string defect;       ///< such as gap-all-sides
  std::size_t surface = 0;  ///< index in the model
  double amount = 0.0;      ///< mm
  engine::Box3 box;         ///< around the surface, larger by the amount and a tenth of a millimetre
};

/// What the list beside a model (part.defects.txt beside part.igs) says; empty where there is none. Throws
/// std::runtime_error on a line that cannot be read.
std::vector<Damage> listed_damage(const std::filesystem::path& model_file, const engine::Model& model);

bool is_damaged(const std::vector<Damage>& damage, const engine::Vector3& place);

}  // namespace lamina::tools
