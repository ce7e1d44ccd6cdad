#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "engine/model.h"
#include "engine/nurbs/bezier.h"

namespace lamina::tools {

/// A straight piece of a section, the surface's normal on its right.
using SectionPiece = std::pair<engine::Vector2, engine::Vector2>;

/// Points that a plane and the surfaces have in common.
struct TrueSection {
  std::vector<engine::Vector2> crossings;  ///< where a surface passes through the plane
  std::vector<engine::Vector2> in_plane;   ///< where it lies in the plane, or ends in it
  std::vector<SectionPiece> pieces;        ///< of cells of parameter lines with two crossings
};

/// Sections by a route of their own: on lines of constant u and of constant v at random places, the sides of
/// every patch among them, the height over the plane is evaluated; where it changes sign the crossing is
/// solved by bisection. Loops smaller than the lines' spacing can be missed, nothing else: the points are no
/// farther apart than about the spacing.
class TrueSectioner {
 public:
  TrueSectioner(const engine::Model& model, unsigned seed);

  /// At height z; `spacing` of the lines, mm.
  TrueSection at(double z, double spacing);

 private:
  struct Candidate {
    engine::BezierPatch patch;
    engine::Box3 box;
    double size_u = 0.0;  ///< upper bounds of the lengths, mm
    double size_v = 0.0;
  };

  std::vector<double> places(double size, double spacing);
  void cut(const Candidate& candidate, double z, double spacing, TrueSection& section);

  std::vector<Candidate> candidates_;
  std::mt19937 random_;
};

/// How often the pieces of a section wind around a place: 0 outside, 1 inside one solid, 2 inside two whose
/// surfaces run through each other; negative where the surfaces' normals point inwards.
double winding_number(const std::vector<SectionPiece>& pieces, const engine::Vector2& place);

}  // namespace lamina::tools
