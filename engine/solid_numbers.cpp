#include "engine/solid_numbers.h"

#include "engine/model.h"

namespace lamina::engine {

SolidNumbers::SolidNumbers(const Model& model) {
  for (const Surface& surface : model.surfaces) surfaces_.push_back(surface.solid);
  for (const TriangleMesh& mesh : model.meshes) meshes_.push_back(mesh.solid);
  for (const auto* numbers : {&surfaces_, &meshes_}) {
    for (const std::uint32_t number : *numbers) none_ = none_ && number == 0;
  }
}

std::uint32_t SolidNumbers::of(const SectionArc& arc) const {
  if (none_ || arc.surface >= kScansFrom) return 0;
  return arc.surface < kMeshesFrom ? surfaces_[arc.surface] : meshes_[arc.surface - kMeshesFrom];
}

}  // namespace lamina::engine
