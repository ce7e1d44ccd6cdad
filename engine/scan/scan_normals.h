#pragma once

#include <vector>

#include "engine/scan/point_tree.h"

namespace lamina::engine {

/// Unit normals of the planes through each point's neighbours (Hoppe et al., 1992): turned so that neighbours
/// agree, along the spanning tree in which they agree most, and outwards at the top of each connected part.
std::vector<Eigen::Vector3f> estimated_normals(const std::vector<Eigen::Vector3f>& points,
                                               const PointTree& tree);

/// Part of the pairs of neighbours whose normals point to opposite sides, 0 to 1.
double contradictions(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                      const PointTree& tree);

/// Turns all normals round where most of them point inwards at the outermost points.
void turn_outwards(const std::vector<Eigen::Vector3f>& points, std::vector<Eigen::Vector3f>& normals);

}  // namespace lamina::engine
