#pragma once

#include <cstdint>
#include <vector>

#include "engine/pointcloud/section_arc.h"

namespace lamina::engine {

struct Model;

/// Which known solid the arcs of a section bound.
class SolidNumbers {
 public:
  SolidNumbers() = default;  ///< none is known
  explicit SolidNumbers(const Model& model);

  /// Number from 1; 0 where none is known.
  std::uint32_t of(const SectionArc& arc) const;

  bool none() const { return none_; }

  /// What arcs cut from a mesh, or from a scan, have as their surface.
  static std::uint32_t surface_of_mesh(std::uint32_t mesh) { return kMeshesFrom + mesh; }
  static std::uint32_t surface_of_scan(std::uint32_t scan) { return kScansFrom + scan; }

 private:
  /// Meshes and scans are numbered after all surfaces that a model can have.
  static constexpr std::uint32_t kMeshesFrom = 1U << 31U;
  static constexpr std::uint32_t kScansFrom = 3U << 30U;

  std::vector<std::uint32_t> surfaces_;
  std::vector<std::uint32_t> meshes_;
  bool none_ = true;
};

}  // namespace lamina::engine
