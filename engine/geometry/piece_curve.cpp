#include "engine/geometry/piece_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/geometry/arc_length.h"

namespace lamina::engine {
namespace {

/// Appends to a chain that ends where the piece begins.
struct AppendChords {
  Polyline& points;
  double tolerance;

  void operator()(const LineSegment& line) const { points.push_back(line.end); }

  void operator()(const CircularArc& arc) const {
    // A chord over the angle a has the sagitta r (1 - cos(a / 2)).
    const double cosine = std::max(0.0, 1.0 - tolerance / arc.radius());
    const double chords = std::max(1.0, std::ceil(std::abs(arc.sweep) / (2.0 * std::acos(cosine))));
    for (double k = 1.0; k <= chords; ++k) points.push_back(point_on(arc, k / chords));
  }

  void operator()(const PlanarCurve& curve) const {
    const Polyline chain = flatten(curve, tolerance);
    points.insert(points.end(), chain.begin() + 1, chain.end());
  }
};

}  // namespace

Vector2 point_on(const PieceCurve& curve, double u) {
  const auto last = static_cast<double>(curve.pieces.size() - 1);
  const double piece = std::clamp(std::floor(u), 0.0, last);
  return point_on(curve.pieces[static_cast<std::size_t>(piece)], u - piece);
}

double length(const PieceCurve& curve) {
  double sum = 0.0;
  for (const CurvePiece& piece : curve.pieces) sum += length(piece);
  return sum;
}

Box2 bounds(const PieceCurve& curve) {
  Box2 box;
  for (const CurvePiece& piece : curve.pieces) box.extend(bounds(piece));
  return box;
}

double signed_area(const PieceCurve& curve) {
  double sum = 0.0;
  for (const CurvePiece& piece : curve.pieces) sum += swept_area(piece);
  return sum;
}

Polyline flatten(const PieceCurve& curve, double tolerance) {
  if (curve.pieces.empty()) return {};
  Polyline points{start_point(curve.pieces.front())};
  for (const CurvePiece& piece : curve.pieces) std::visit(AppendChords{points, tolerance}, piece);
  if (curve.closed) points.pop_back();
  return points;
}

Polyline sample_evenly(const PieceCurve& curve, double step) {
  if (curve.pieces.empty()) return {};
  std::vector<ArcLengthTable> tables;
  tables.reserve(curve.pieces.size());
  double total = 0.0;
  for (const CurvePiece& piece : curve.pieces) {
    tables.emplace_back(piece);
    total += tables.back().length();
  }
  const double intervals = std::max(1.0, std::ceil(total / step));
  Polyline points{start_point(curve.pieces.front())};
  std::size_t piece = 0;
  double walked = 0.0;  // up to the piece
  for (double k = 1.0; k < intervals; ++k) {
    const double distance = total * k / intervals;
    while (piece + 1 < tables.size() && distance > walked + tables[piece].length())
      walked += tables[piece++].length();
    points.push_back(point_on(curve.pieces[piece], tables[piece].place_at(distance - walked)));
  }
  if (!curve.closed) points.push_back(end_point(curve.pieces.back()));
  return points;
}

}  // namespace lamina::engine
