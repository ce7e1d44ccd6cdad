#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/model.h"
#include "engine/pointcloud/front_state.h"

namespace lamina::engine {

/// The model's triangles by ascending z minimum, and those that a rising plane may meet: for triangles what
/// `PatchFront` is for patches.
class FacetFront {
 public:
  explicit FacetFront(const Model& model);

  /// Moves the plane up to z, which must not decrease: triangles whose z interval lies within `reach` of it
  /// become active.
  void advance(double z, double reach);

  std::vector<FrontFacet> active() const;
  std::size_t added() const { return added_; }      ///< by the last advance
  std::size_t removed() const { return removed_; }  ///< by the last advance

 private:
  struct Place {
    std::uint32_t mesh;
    std::uint32_t facet;
  };

  float lowest(const Place& place) const;
  float highest(const Place& place) const;
  const Eigen::Vector3f& corner(const Place& place, std::size_t k) const;

  std::vector<TriangleMesh> meshes_;
  std::vector<Place> places_;  ///< by ascending z minimum
  std::vector<Place> active_;
  std::size_t next_ = 0;
  std::size_t added_ = 0;
  std::size_t removed_ = 0;
};

}  // namespace lamina::engine
