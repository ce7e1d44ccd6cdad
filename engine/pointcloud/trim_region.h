#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/model.h"
#include "engine/nurbs/bezier_chain.h"
#include "engine/pointcloud/edge_samples.h"
#include "engine/pointcloud/trim_chords.h"

namespace lamina::engine {

/// The part of a surface that lies inside its trim loops. In or out is answered on chords of the trim curves,
/// whose deviation is at most 4e-4 of the surface's domain and about 0.005 mm on the surface; exact places on
/// them are found by whoever asks, on the curves themselves.
class TrimRegion {
 public:
  /// Of a surface with trim loops.
  TrimRegion(const Surface& surface, std::uint32_t number);

  const NurbsSurface& surface() const { return surface_; }
  std::uint32_t number() const { return number_; }  ///< of the surface in its model
  const std::vector<BezierChain>& edges() const { return edges_; }
  /// Chords of each edge, lifted onto the surface.
  const std::vector<std::vector<EdgeSample>>& samples() const { return samples_; }
  /// Place of an edge in the parameter plane.
  Vector2 on_edge(std::uint32_t edge, double t) const { return evaluate(edges_[edge], t).head<2>(); }
  Vector3 on_surface(const Vector2& parameters) const {
    return evaluate(surface_, parameters.x(), parameters.y());
  }
  /// Whether an edge lies in the plane at height z, to the model tolerance.
  bool is_level(std::uint32_t edge, double z) const;
  /// All edges that do.
  std::vector<std::uint32_t> edges_in_plane(double z) const;
  /// Where edges are highest or lowest between their ends.
  const std::vector<Vector3>& turning_points() const { return turning_points_; }
  /// Edges of each loop, [first, last).
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& loops() const { return loops_; }
  /// Twice the area of a loop in the parameter plane, positive counter-clockwise.
  double turning(std::size_t loop) const;
  double z_min() const { return z_min_; }  ///< of the trim curves' samples, mm
  double z_max() const { return z_max_; }
  /// The whole surface lies in one horizontal plane, to the model tolerance.
  bool level() const { return level_; }

  /// In and out of the loops, and where lines cross them.
  const TrimChords& chords() const { return chords_; }

 private:
  NurbsSurface surface_;
  std::uint32_t number_;
  std::vector<BezierChain> edges_;
  std::vector<std::vector<EdgeSample>> samples_;
  std::vector<std::pair<double, double>> heights_;  ///< z interval of each edge, mm
  std::vector<std::uint32_t> level_edges_;          ///< those that can lie in a horizontal plane
  std::vector<Vector3> turning_points_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> loops_;
  TrimChords chords_;
  double z_min_ = 0.0;
  double z_max_ = 0.0;
  bool level_ = false;
};

}  // namespace lamina::engine
