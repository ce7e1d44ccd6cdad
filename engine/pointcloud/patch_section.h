#pragma once

#include <vector>

#include "engine/pointcloud/arc_nodes.h"
#include "engine/pointcloud/patch_point.h"
#include "engine/pointcloud/section_arc.h"

namespace lamina::engine {

struct SectionOptions {
  double chord_tolerance =
      0.0025;  ///< greatest distance of an arc from the chord between neighbouring nodes, mm
  double smallest_cell = 0.005;  ///< sub-patches of this size are not divided further, mm
};

/// Cuts patches with a plane. A patch is halved until the height over the plane is monotone in one parameter,
/// which the differences of the control net prove, and the two edges across change sign at most once
/// (variation diminishing): then the section is one arc that the other parameter runs along without turning
/// back. No small loop or thin sliver is lost, whatever the size, and the work follows the number of such
/// arcs, not epsilon. Along an arc nodes are placed by bisection until the chords are within tolerance.
///
/// Edges, vertices and whole patches that lie in the plane to the model tolerance are reported as such;
/// elsewhere a point in the plane counts as above it.
class PatchSection {
 public:
  explicit PatchSection(const SectionOptions& options) : options_(options) {}

  /// Appends what the plane at height z and the patch have in common.
  void cut(const FrontPatch& patch, double z, Section& section);

 private:
  struct Rectangle {
    double u0, u1, v0, v1;
  };

  void visit(double* net, const Rectangle& rectangle, int depth);
  bool snap_edges(double* net) const;
  void emit_one_sided(const double* net, const Rectangle& rectangle, bool above);
  void emit_flat(const Rectangle& rectangle);
  void halve(const double* net, const Rectangle& rectangle, double* free, int depth, Direction direction);
  bool emit_monotone(const double* net, const Rectangle& rectangle, Direction solved, bool rising,
                     bool at_limit);
  void emit_unresolved(const double* net, const Rectangle& rectangle);
  ArcNodes arc_nodes() const { return {*patch_, z_, options_.chord_tolerance, *section_}; }

  SectionOptions options_;
  // The patch in hand.
  const FrontPatch* patch_ = nullptr;
  Section* section_ = nullptr;
  double z_ = 0.0;
  double size_u_ = 0.0;  ///< length along u, mm, an upper bound
  double size_v_ = 0.0;
  std::vector<double> nets_;  ///< stack of nets of heights over the plane
};

}  // namespace lamina::engine
