#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/model.h"

namespace lamina::engine {

enum class TrimPlace { kInside, kOutside, kCut };

/// Where a line of straight sides in the parameter plane meets a trim curve.
struct TrimCrossing {
  std::size_t side = 0;  ///< of the line: from its point `side` to the next
  double along = 0.0;    ///< that side, 0 to 1
  std::uint32_t edge = 0;
  std::uint32_t sample = 0;  ///< of the edge: it is met between this one and the next
};

/// A trim curve lifted onto its surface at one parameter.
struct EdgeSample {
  double t = 0.0;
  Vector2 parameters;  ///< (u, v)
  Vector3 position;    ///< mm
};

/// The part of a surface that lies inside its trim loops. In or out is answered on chords of the trim curves,
/// whose deviation is a ten-thousandth of the surface's domain; exact places on them are found by whoever
/// asks, on the curves themselves.
class TrimRegion {
 public:
  /// Of a surface with trim loops.
  TrimRegion(const Surface& surface, std::uint32_t number);

  const NurbsSurface& surface() const { return surface_; }
  std::uint32_t number() const { return number_; }  ///< of the surface in its model
  const std::vector<NurbsCurve>& edges() const { return edges_; }
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
  /// Edges of each loop, [first, last).
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& loops() const { return loops_; }
  /// Twice the area of a loop in the parameter plane, positive counter-clockwise.
  double turning(std::size_t loop) const;
  double z_min() const { return z_min_; }  ///< of the trim curves' samples, mm
  double z_max() const { return z_max_; }
  /// The whole surface lies in one horizontal plane, to the model tolerance.
  bool level() const { return level_; }

  bool contains(const Vector2& parameters) const;
  TrimPlace place_of(const Vector2& low, const Vector2& high) const;
  /// In order along the line, which has two points at least.
  std::vector<TrimCrossing> crossings(const std::vector<Vector2>& line) const;

 private:
  static constexpr std::uint32_t kNoEdge = 0xffffffff;

  struct Chord {
    Vector2 a;
    Vector2 b;
    std::uint32_t edge;    ///< kNoEdge: closes the gap between two curves
    std::uint32_t sample;  ///< of the edge, at `a`

    bool meets(const Box2& box) const {
      return std::max(a.x(), b.x()) >= box.min().x() && std::min(a.x(), b.x()) <= box.max().x() &&
             std::max(a.y(), b.y()) >= box.min().y() && std::min(a.y(), b.y()) <= box.max().y();
    }
  };

  void find_crossings(const std::vector<Vector2>& line, std::size_t first, std::size_t last,
                      std::size_t first_near, std::vector<std::uint32_t>& near,
                      std::vector<TrimCrossing>& found) const;
  void cross_chord(const Vector2& from, const Vector2& to, std::size_t side, const Chord& chord,
                   std::vector<TrimCrossing>& found) const;
  void sample_edge(const NurbsCurve& curve, double tolerance);
  void fill_buckets();
  std::size_t bucket_of(double v) const;
  /// Chords whose v interval meets the given one, each once.
  template <typename Visit>
  void for_each_chord(double v_low, double v_high, Visit visit) const;

  NurbsSurface surface_;
  std::uint32_t number_;
  std::vector<NurbsCurve> edges_;
  std::vector<std::vector<EdgeSample>> samples_;
  std::vector<std::pair<double, double>> heights_;  ///< z interval of each edge, mm
  std::vector<std::uint32_t> level_edges_;          ///< those that can lie in a horizontal plane
  std::vector<std::pair<std::uint32_t, std::uint32_t>> loops_;
  std::vector<Chord> chords_;
  std::vector<std::uint32_t> bucket_chords_;  ///< chords by v, bucket after bucket
  std::vector<std::uint32_t> bucket_ends_;    ///< where each begins, and the last one's end
  double v_low_ = 0.0;
  double bucket_height_ = 1.0;
  double z_min_ = 0.0;
  double z_max_ = 0.0;
  bool level_ = false;
};

}  // namespace lamina::engine
