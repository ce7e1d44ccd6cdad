#pragma once

#include "engine/model.h"

namespace lamina::tests {

/// Straight trim curves through the corners, back to the first.
engine::TrimLoop polygon_loop(const std::vector<engine::Vector2>& corners);

/// A full circle in the parameter plane, as one rational quadratic, counter-clockwise or clockwise.
engine::TrimLoop circle_loop(const engine::Vector2& centre, double radius, bool clockwise);

/// The flat surface origin + u * along_u + v * along_v, u and v in [-margin, 1 + margin], with trim loops.
engine::Surface trimmed_plane(const engine::Vector3& origin, const engine::Vector3& along_u,
                              const engine::Vector3& along_v, double margin,
                              std::vector<engine::TrimLoop> loops);

/// A box with an upright round hole, like `box_with_hole`, as B-rep files have it: six planes wider than the
/// faces, trimmed by rectangles, top and bottom by the rectangle and the circle, and the hole's wall trimmed
/// in height.
engine::Model trimmed_box_with_hole(const engine::Vector3& low, const engine::Vector3& high,
                                    double hole_radius);

}  // namespace lamina::tests
