#include "tests/engine/fit/curve_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamina::tests {

using engine::CircularArc;
using engine::CurvePiece;
using engine::LineSegment;
using engine::PieceCurve;
using engine::PlanarCurve;
using engine::Polyline;
using engine::Vector2;

Polyline dense_points(const PieceCurve& curve, std::size_t per_piece) {
  Polyline points;
  for (const CurvePiece& piece : curve.pieces) {
    for (std::size_t k = 0; k <= per_piece; ++k) {
      const double u = static_cast<double>(k) / static_cast<double>(per_piece);
      if (const auto* line = std::get_if<LineSegment>(&piece)) {
        points.push_back((1.0 - u) * line->start + u * line->end);
      } else if (const auto* arc = std::get_if<CircularArc>(&piece)) {
        const Vector2 from = arc->start - arc->centre;
        const double angle = std::atan2(from.y(), from.x()) + u * arc->sweep;
        points.push_back(arc->centre + from.norm() * Vector2(std::cos(angle), std::sin(angle)));
      } else {
        const auto& spline = std::get<PlanarCurve>(piece);
        const double begin = spline.first_parameter();
        points.push_back(evaluate(spline, begin + u * (spline.last_parameter() - begin)));
      }
    }
  }
  return points;
}

Polyline dense_points(const ParametricCurve& curve, std::size_t count) {
  Polyline points;
  for (std::size_t k = 0; k <= count; ++k)
    points.push_back(curve.point(static_cast<double>(k) / static_cast<double>(count)));
  return points;
}

namespace {

double segment_distance(const Vector2& point, const Vector2& start, const Vector2& end) {
  const Vector2 side = end - start;
  const double squared = side.squaredNorm();
  const double share = squared > 0.0 ? std::clamp((point - start).dot(side) / squared, 0.0, 1.0) : 0.0;
  return (point - start - share * side).norm();
}

}  // namespace

double greatest_distance(const Polyline& points, const Polyline& chain) {
  double greatest = 0.0;
  for (const Vector2& point : points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      least = std::min(least, segment_distance(point, chain[i], chain[i + 1]));
    }
    greatest = std::max(greatest, least);
  }
  return greatest;
}

Polyline every(const Polyline& points, std::size_t step) {
  Polyline result;
  for (std::size_t i = 0; i < points.size(); i += step) result.push_back(points[i]);
  return result;
}

double greatest_gap(const PieceCurve& curve) {
  double greatest = 0.0;
  const std::size_t count = curve.pieces.size();
  for (std::size_t i = 0; i < (curve.closed ? count : count - 1); ++i) {
    greatest =
        std::max(greatest, (end_point(curve.pieces[i]) - start_point(curve.pieces[(i + 1) % count])).norm());
  }
  return greatest;
}

double greatest_kink(const PieceCurve& curve) {
  double greatest = 0.0;
  const std::size_t count = curve.pieces.size();
  for (std::size_t i = 0; i < (curve.closed ? count : count - 1); ++i) {
    const Vector2 in = end_tangent(curve.pieces[i]);
    const Vector2 out = start_tangent(curve.pieces[(i + 1) % count]);
    greatest = std::max(greatest, std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out))));
  }
  return greatest;
}

}  // namespace lamina::tests
