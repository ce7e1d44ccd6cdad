#include "engine/import/mesh/vertex_welder.h"

#include <bit>
#include <utility>

namespace lamina::engine {
namespace {

constexpr std::size_t kFirstSlots = 1024;

std::uint64_t hash(const Eigen::Vector3f& point) {
  // Multiply and fold (the constants are odd and irregular, nothing more).
  const std::uint64_t xy =
      std::uint64_t{std::bit_cast<std::uint32_t>(point.x())} << 32U | std::bit_cast<std::uint32_t>(point.y());
  std::uint64_t mixed = (xy ^ xy >> 31U) * 0x9e3779b97f4a7c15U;
  mixed = (mixed ^ mixed >> 29U ^ std::bit_cast<std::uint32_t>(point.z())) * 0xbf58476d1ce4e5b9U;
  return mixed ^ mixed >> 32U;
}

}  // namespace

std::size_t VertexWelder::slot_of(const Eigen::Vector3f& point) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(point) & mask;
  while (slots_[slot] != 0 && vertices_[slots_[slot] - 1] != point) slot = (slot + 1) & mask;
  return slot;
}

void VertexWelder::grow() {
  const std::size_t wanted = slots_.empty() ? kFirstSlots : 2 * slots_.size();
  slots_ = {};  // before the new ones are there
  slots_.resize(wanted, 0);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    slots_[slot_of(vertices_[i])] = static_cast<std::uint32_t>(i + 1);
  }
}

std::uint32_t VertexWelder::index_of(const Eigen::Vector3f& point) {
  if (3 * slots_.size() < 4 * (vertices_.size() + 1)) grow();
  const Eigen::Vector3f unsigned_zeros = point.array() + 0.0F;
  const std::size_t slot = slot_of(unsigned_zeros);
  if (slots_[slot] == 0) {
    vertices_.push_back(unsigned_zeros);
    slots_[slot] = static_cast<std::uint32_t>(vertices_.size());
  }
  return slots_[slot] - 1;
}

std::vector<Eigen::Vector3f> VertexWelder::take_vertices() {
  slots_ = {};
  return std::exchange(vertices_, {});
}

}  // namespace lamina::engine
