#pragma once

#include <vector>

#include "engine/contour/contour_node.h"
#include "engine/contour/planar_faces.h"

namespace lamina::engine {

/// For each chain of a graph +1 when the solid that it bounds lies on its left as it runs, -1 when on its
/// right.
///
/// Surface normals in files cannot be relied on, so a chain is judged by where it runs. One that borders the
/// outside has its solid on the other side. Of the closed chains that do not, one that only touches is a
/// hole; one that crosses a chain is another solid that overlaps, filled inside, or the hole of a solid that
/// another one runs into. Only the normals can tell: it is a hole where they say so, where it lies inside a
/// chain that it does not cross, and where nothing speaks against the normals: no chain along which they
/// point now to one side and now to the other, and no chain that borders the outside the other way round than
/// others do. An open chain that is enclosed goes by the normals, read the way the chains around it show.
std::vector<int> chain_orientations(const std::vector<NodeChain>& chains, const PlanarGraph& graph,
                                    const PlanarFaces& faces);

/// How often each face is covered by the solids, from 0 outside, breadth first.
std::vector<int> face_windings(const PlanarGraph& graph, const PlanarFaces& faces,
                               const std::vector<int>& orientations);

}  // namespace lamina::engine
