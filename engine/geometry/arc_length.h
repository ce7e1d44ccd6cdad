#pragma once

#include <vector>

#include "engine/geometry/curve_piece.h"

namespace lamina::engine {

/// Places on a piece by arc length. Holds a reference to the piece.
class ArcLengthTable {
 public:
  explicit ArcLengthTable(const CurvePiece& piece);

  double length() const { return walked_.back(); }

  /// The u in [0, 1] that lies `distance` mm along the piece from its start, to 1e-9 of the length.
  double place_at(double distance) const;

 private:
  const CurvePiece& piece_;
  std::vector<double> places_;  // ascending from 0 to 1
  std::vector<double> walked_;  // up to each of them, mm
};

/// Places u at which a piece may be cut so that it bends evenly in between: 0 and 1 for lines and arcs, the
/// knots and `parts` - 1 places between neighbouring ones for splines.
std::vector<double> even_places(const CurvePiece& piece, std::size_t parts);

}  // namespace lamina::engine
