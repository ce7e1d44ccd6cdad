#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "engine/geometry/planar_curve.h"
#include "engine/layer.h"
#include "engine/model.h"
#include "engine/slice_options.h"
#include "engine/sparse/contour_node.h"
#include "engine/sparse/meetings.h"
#include "engine/sparse/patch_front.h"
#include "engine/sparse/patch_section.h"
#include "engine/sparse/sparse_report.h"

namespace lamina::engine {

/// Makes a curve of a chain of exact nodes. A closed chain's curve ends where it begins.
using CurveMaker = std::function<PlanarCurve(const NodeChain&)>;

/// The curve through the nodes by straight pieces; within the chord tolerance of the section.
PlanarCurve polyline_through(const NodeChain& chain);

struct SparseOptions {
  double chord_part =
      0.05;  ///< greatest distance of chords between nodes from the section, as a part of epsilon
  double longest_bridge = 0.5;  ///< gaps up to this are closed and reported, mm
  bool unite_all =
      false;  ///< sends every chain through the arrangement, whether it meets another or not: for tests
  CurveMaker make_curve = polyline_through;
};

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

/// Slices a model plane by plane at a cost that follows the length of the contours. Patches that the plane
/// meets are cut into arcs whose nodes are exact; arcs are linked end to end; gaps are bridged; a sparse grid
/// of bit tiles tells which chains may meet, and only those are united. Holds the patches near the plane and
/// the buffers of one layer.
class SparseSlicer {
 public:
  /// Planes must rise. Throws SliceError when an option is out of its range or a plane lies below its
  /// predecessor.
  SparseSlicer(const Model& model, std::vector<SlicePlane> planes, const SliceOptions& options,
               SparseOptions sparse = {});

  /// The next layer, or nothing after the last plane. A plane that misses the model gives a layer without
  /// contours.
  std::optional<Layer> next();

  /// The contours at the next plane as chains, or nothing after the last.
  std::optional<LayerChains> next_chains();

  std::size_t layer_count() const { return planes_.size(); }
  std::size_t patch_count() const { return front_.patch_count(); }
  /// Of the layer made last.
  const SparseReport& report() const { return report_; }

 private:
  std::vector<NodeChain> united(std::vector<NodeChain> chains, std::vector<NodeChain>& open);

  SliceOptions options_;
  SparseOptions sparse_;
  std::vector<SlicePlane> planes_;
  PatchFront front_;
  PatchSection patch_section_;
  MeetingFinder meetings_;
  Section section_;
  SparseReport report_;
  std::size_t next_plane_ = 0;
};

}  // namespace lamina::engine
