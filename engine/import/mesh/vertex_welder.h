#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// Gives equal points one index: equal bit by bit, but for the sign of zero. Points must be finite.
class VertexWelder {
 public:
  /// Index of `point` among the vertices; it is appended where it is new.
  std::uint32_t index_of(const Eigen::Vector3f& point);

  std::size_t size() const { return vertices_.size(); }

  /// The vertices, in the order in which they came first. The welder is empty afterwards.
  std::vector<Eigen::Vector3f> take_vertices();

 private:
  void grow();
  std::size_t slot_of(const Eigen::Vector3f& point) const;

  std::vector<Eigen::Vector3f> vertices_;
  std::vector<std::uint32_t>
      slots_;  ///< open addressing, a power of two of them: index of a vertex + 1, or 0
};

}  // namespace lamina::engine
