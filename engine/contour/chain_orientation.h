#pragma once

#include <vector>

#include "engine/contour/contour_node.h"
#include "engine/contour/planar_faces.h"

namespace lamina::engine {

/// For each chain of a graph +1 when the solid that it bounds lies on its left as it runs, -1 when on its
/// right.
///
/// Surface normals in files cannot be relied on, so a chain is judged by where it runs. One that borders the
/// outside has its solid on the other side. Of the chains that do not, one that crosses a chain is another
/// solid that overlaps, filled inside; one that only touches is a hole. Only an open chain that is enclosed
/// goes by the normals, read the way the chains around it show.
std::vector<int> chain_orientations(const std::vector<NodeChain>& chains, const PlanarGraph& graph,
                                    const PlanarFaces& faces);

/// How often each face is covered by the solids, from 0 outside, breadth first.
std::vector<int> face_windings(const PlanarGraph& graph, const PlanarFaces& faces,
                               const std::vector<int>& orientations);

}  // namespace lamina::engine
