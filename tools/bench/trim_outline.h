#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/model.h"
#include "engine/nurbs/bezier.h"

namespace lamina::tools {

/// The trim loops of a surface, in its parameter plane and in space: what lies inside by fine chains of
/// chords, how far the rim is and where it crosses a plane by looking closer on the curves themselves. A
/// route apart from the engine's.
class TrimOutline {
 public:
  explicit TrimOutline(const engine::Surface& surface);

  /// By parity of the crossings of a ray.
  bool contains(const engine::Vector2& parameters) const;

  /// To the nearest point of the loops on the surface, mm.
  double distance_to_rim(const engine::Vector3& point) const;

  struct Crossings {
    std::vector<engine::Vector2> through;   ///< where a loop passes through the plane
    std::vector<engine::Vector2> in_plane;  ///< where it may do so by rounding alone: it runs in the plane,
                                            ///< or has a corner there
  };

  /// Where the loops cross the plane at height z.
  Crossings crossings(double z) const;

 private:
  /// Between two parameters of a trim curve; of no curve (kNoCurve) where it closes the gap to the next one.
  struct Chord {
    static constexpr std::size_t kNoCurve = static_cast<std::size_t>(-1);

    std::size_t curve = kNoCurve;
    double t0 = 0.0;
    double t1 = 0.0;
    engine::Vector2 a;  ///< ends in the parameter plane
    engine::Vector2 b;
    engine::Vector3 from;  ///< ends in space
    engine::Vector3 to;
  };

  engine::Vector3 place(std::size_t curve, double t) const;

  engine::NurbsSurface surface_;
  std::vector<engine::NurbsCurve> curves_;
  std::vector<Chord> chords_;
};

/// A part of a model's surface as a Bezier patch of its own.
struct ModelPatch {
  engine::BezierPatch patch;
  engine::Vector2 low = engine::Vector2::Zero();  ///< corners in the surface's parameter plane
  engine::Vector2 high = engine::Vector2::Ones();
  const TrimOutline* trim = nullptr;  ///< null: all of it counts
  std::uint32_t solid = 0;            ///< that it bounds, 0 where none is known

  engine::Vector2 on_surface(const engine::Vector2& uv) const { return low + uv.cwiseProduct(high - low); }
  bool counts(const engine::Vector2& uv) const { return trim == nullptr || trim->contains(on_surface(uv)); }
};

/// All of a model: the patches of its surfaces, and its facets as patches of degree one that have one side of
/// no length. Outlines are owned here, the patches refer to them.
struct ModelPatches {
  explicit ModelPatches(const engine::Model& model);
  ModelPatches(const ModelPatches&) = delete;
  ModelPatches& operator=(const ModelPatches&) = delete;

  std::vector<TrimOutline> outlines;
  std::vector<ModelPatch> patches;
};

}  // namespace lamina::tools
