#pragma once

#include "engine/pointcloud/patch_point.h"

namespace lamina::engine {

/// Places nodes along arcs of one patch's section, by bisection until the chords are within tolerance.
class ArcNodes {
 public:
  /// `chord_tolerance`: greatest distance of an arc from the chord between neighbouring nodes, mm. Refers to
  /// the patch and the section, which must outlive it.
  ArcNodes(const FrontPatch& patch, double z, double chord_tolerance, Section& section)
      : patch_(patch), z_(z), tolerance_(chord_tolerance), section_(section) {}

  /// Appends the nodes of an arc where the patch crosses the plane: from `start`, at `from` of the running
  /// parameter, to `end`, at `to`. `solved` brackets the other parameter all along.
  SectionArc crossing(const LineCrossing& solved, double from, const CrossingPoint& start, double to,
                      const CrossingPoint& end);

  /// Appends the nodes of a parameter line that lies in the plane.
  SectionArc edge(Direction held, double at, double from, double to, ArcKind kind);

 private:
  bool chord_holds(const Vector2& a, const Vector2& tangent_a, const Vector2& b,
                   const Vector2& tangent_b) const;
  void bisect(const LineCrossing& solved, double from, const CrossingPoint& start, double to,
              const CrossingPoint& end, int forced, int depth);
  void bisect(Direction held, double at, double from, const EdgePoint& start, double to, const EdgePoint& end,
              int forced, int depth);
  SectionArc begin(ArcKind kind) const;
  void finish(SectionArc& arc) const;

  const FrontPatch& patch_;
  double z_;
  double tolerance_;
  Section& section_;
};

}  // namespace lamina::engine
