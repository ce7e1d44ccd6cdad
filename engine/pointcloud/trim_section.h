#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/pointcloud/front_state.h"
#include "engine/pointcloud/section_arc.h"
#include "engine/pointcloud/trim_region.h"

namespace lamina::engine {

/// How much of a section was there before a patch was cut.
struct SectionMark {
  std::size_t nodes = 0;
  std::size_t arcs = 0;
  std::size_t flat_rims = 0;
  std::size_t flats = 0;
  std::size_t touches = 0;
};

SectionMark mark_of(const Section& section);

/// Keeps of what a patch added to a section the part inside the trim loops. Arcs end where the plane meets
/// the trim curve, exactly: on the curve, on the surface and in the plane. Edges along the surface's own
/// border, and those along trim curves in the plane, are left to `add_trim_edges`. What it needs in between
/// it keeps from patch to patch.
class SectionTrimmer {
 public:
  void trim(Section& section, const SectionMark& mark, const FrontPatch& patch, double z);

 private:
  using Nodes = std::span<const SectionNode>;

  /// A place on an arc: on the chord after node k.
  struct Cut {
    std::size_t k = 0;
    TrimCrossing crossing;
    const EdgeSample* end = nullptr;  ///< where it is the end of a trim curve

    double place() const { return static_cast<double>(k) + crossing.along; }
  };

  void trim_arc(const SectionArc& arc, Nodes nodes);
  void add_ends_of_level_edges(Nodes nodes);
  bool on_level_edge(const Vector2& place) const;
  Vector2 probe_of(const Cut& from, const Cut& to) const;
  SectionNode node_at(Nodes nodes, const Cut& cut) const;
  void emit(const SectionArc& arc, Nodes nodes, const Cut& from, bool at_start, const Cut& to, bool at_end);

  // The patch in hand.
  Section* section_ = nullptr;
  const FrontPatch* patch_ = nullptr;
  const TrimRegion* region_ = nullptr;
  double z_ = 0.0;
  std::vector<std::uint32_t> level_edges_;  ///< of the region, those that lie in the plane
  std::vector<SectionArc> arcs_;            ///< as the patch added them
  std::vector<SectionNode> nodes_;
  std::vector<Vector2> line_;  ///< the arc in hand in the parameter plane
  std::vector<Cut> cuts_;      ///< of that arc
};

}  // namespace lamina::engine
