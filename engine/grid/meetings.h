#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/contour/contour_node.h"
#include "engine/grid/tile_grid.h"

namespace lamina::engine {

/// Chains that cross or touch each other or themselves.
struct Meetings {
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      chains;  ///< ascending, no pair twice; (c, c): c meets itself
  std::size_t shared_cells = 0;
  std::size_t close_places = 0;  ///< pairs of segments in one cell that stay apart
};

/// The layer grid as a judge of what may meet: every chain is drawn into bit tiles of cells of side epsilon,
/// and only the segments in cells that were entered twice are compared with each other, exactly. Chains whose
/// cells nobody shares are contours as they are. Buffers are kept from layer to layer.
class MeetingFinder {
 public:
  explicit MeetingFinder(double epsilon) : epsilon_(epsilon) {}

  /// Segments meet when they come within `tolerance` (mm) of each other; neighbours in a chain do not count.
  Meetings find(const std::vector<NodeChain>& chains, double tolerance);

  std::size_t tile_count() const { return drawn_.tile_count(); }

 private:
  struct Entry {
    TileCell cell;
    std::uint32_t chain;
    std::uint32_t segment;
  };

  double epsilon_;
  TileGrid drawn_;
  TileGrid shared_;
  std::vector<Entry> entries_;
};

}  // namespace lamina::engine
