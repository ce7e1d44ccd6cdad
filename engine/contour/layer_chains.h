#pragma once

#include <vector>

#include "engine/contour/contour_node.h"
#include "engine/geometry/vector.h"
#include "engine/grid/meetings.h"
#include "engine/layer_report.h"
#include "engine/pointcloud/section_arc.h"
#include "engine/slice_options.h"
#include "engine/solid_numbers.h"

namespace lamina::engine {

/// One layer's contours as chains of exact nodes, before curves are made of them.
struct LayerChains {
  std::vector<NodeChain> closed;
  std::vector<NodeChain> open;
  std::vector<NodeChain> touch_curves;  ///< closed or open
  std::vector<Vector2> touch_points;
  struct Face {
    NodeChain outer;
    std::vector<NodeChain> inner;
  };
  std::vector<Face> faces;
};

/// Links the arcs of a section end to end, bridges gaps, unites the chains that meet and sorts out what lies
/// in the plane. Known solids that are closed are made one by one and then united; everything else is taken
/// together. `meetings` lends its buffers. Counts in `report` what was found and all that was imperfect.
LayerChains make_chains(const Section& section, const SolidNumbers& solids, const SliceOptions& options,
                        MeetingFinder& meetings, LayerReport& report);

}  // namespace lamina::engine
