#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "engine/model.h"
#include "tools/bench/height_extremes.h"
#include "tools/bench/trim_outline.h"

namespace lamina::tools {

/// A straight piece of a section, the surface's normal on its right.
using SectionPiece = std::pair<engine::Vector2, engine::Vector2>;

/// Points that a plane and the surfaces have in common.
struct TrueSection {
  std::vector<engine::Vector2> crossings;  ///< where a surface passes through the plane
  std::vector<engine::Vector2> in_plane;   ///< where it lies in the plane, or ends in it
  std::vector<SectionPiece> pieces;        ///< of cells of parameter lines with two crossings, up to the rim
  std::vector<std::uint32_t> solids;       ///< number of each piece's solid, 0 where none is known
};

/// Sections by a route of their own: on lines of constant u and of constant v at random places, the sides of
/// every patch among them, and on those through summits and pits, the height over the plane is evaluated;
/// where it changes sign the crossing is solved by bisection. Of trimmed surfaces what lies inside the loops
/// counts, and where the loops cross the plane; facets are patches of degree one. Loops around no summit or
/// pit, smaller than the lines' spacing, can be missed, nothing else: the points are no farther apart than
/// about the spacing.
class TrueSectioner {
 public:
  TrueSectioner(const engine::Model& model, unsigned seed);

  /// At height z; `spacing` of the lines, mm.
  TrueSection at(double z, double spacing);

 private:
  struct Candidate {
    const ModelPatch* part = nullptr;
    engine::Box3 box;
    double size_u = 0.0;  ///< upper bounds of the lengths, mm
    double size_v = 0.0;
    std::optional<ParameterLines> extremes{};  ///< once they were needed
  };

  std::vector<double> places(double size, double spacing, const std::vector<double>& extremes);
  void cut(Candidate& candidate, double z, double spacing, TrueSection& section);

  ModelPatches parts_;
  std::vector<Candidate> candidates_;
  std::mt19937 random_;
};

/// The known solids of a section, to ask what lies inside them.
class KnownSolids {
 public:
  explicit KnownSolids(const TrueSection& section);

  bool none() const { return solids_.empty(); }

  /// Whether a place lies inside any: of nine rays most cross the solid's pieces an odd number of times.
  /// Surfaces may face either way.
  bool contains(const engine::Vector2& place) const;

 private:
  struct Solid {
    std::vector<SectionPiece> pieces;
    engine::Box2 box;
  };

  static bool contains(const std::vector<SectionPiece>& pieces, const engine::Vector2& place);

  std::vector<Solid> solids_;
};

/// How often the pieces of a section that bound no known solid wind around a place: 0 outside, 1 inside one
/// solid, 2 inside two whose surfaces run through each other; negative where the surfaces' normals point
/// inwards.
double winding_number(const TrueSection& section, const engine::Vector2& place);

}  // namespace lamina::tools
