#pragma once

#include <cstddef>
#include <vector>

#include "tests/reference/grid/layer_grid.h"
#include "tests/reference/pointcloud/patch_lists.h"

namespace lamina::reference {

using namespace engine;

/// Marks the cell of every point within epsilon of the plane as below, above or, with both, strong. A point
/// in the plane to the model tolerance counts as both; one more than a quarter of epsilon away is well above
/// or well below. Returns how many points were within epsilon (dissertation p. 139).
std::size_t mark_points(LayerGrid& grid, const std::vector<Vector3>& points, double z);

/// The neighbour rule: a cell with points on one side only, whose right or upper neighbour has points on the
/// other side only, becomes strong together with that neighbour (dissertation p. 140).
void join_opposite_neighbours(LayerGrid& grid);

/// A layer grid over all active patches at height z, marked.
struct MarkedGrid {
  LayerGrid grid;
  std::size_t points_near_plane = 0;
};

MarkedGrid make_layer_grid(const std::vector<ListedPatch>& global_list, const ActiveList& active, double z,
                           double epsilon);

}  // namespace lamina::reference
