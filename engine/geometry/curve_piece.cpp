#include "engine/geometry/curve_piece.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "engine/geometry/basis_window.h"
#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

using std::numbers::pi;

Vector2 quarter_turn(const Vector2& v) {
  return {-v.y(), v.x()};
}

struct GaussPoint {
  double place;  // in [-1, 1]
  double weight;
};

/// Exact for polynomials up to degree 9 (Abramowitz and Stegun, table 25.4).
constexpr std::array<GaussPoint, 5> kGauss{
    {{-0.906179845938663992797626878299, 0.236926885056189087514264040720},
     {-0.538469310105683091036314420700, 0.478628670499366468041291514836},
     {0.0, 0.568888888888888888888888888889},
     {0.538469310105683091036314420700, 0.478628670499366468041291514836},
     {0.906179845938663992797626878299, 0.236926885056189087514264040720}}};

PointAndDerivative at_parameter(const PlanarCurve& curve, std::size_t span, double t) {
  assert(curve.degree <= kHighestWindowDegree);
  PointAndDerivative result;
  const BasisWindow window =
      with_degree(curve.degree, [&](auto degree) { return SpanBasis<degree>(curve.knots, span).at(t); });
  for (std::size_t r = 0; r <= static_cast<std::size_t>(curve.degree); ++r) {
    const Vector2& control = curve.control_points[window.first + r];
    result.point += window.value[r] * control;
    result.derivative += window.slope[r] * control;
  }
  return result;
}

/// Sum over the knot spans of positive length of `term(span, begin, end)`.
template <typename Term>
double sum_over_spans(const PlanarCurve& curve, Term term) {
  double sum = 0.0;
  const auto p = static_cast<std::size_t>(curve.degree);
  for (std::size_t span = p; span + p + 1 < curve.knots.size(); ++span) {
    if (curve.knots[span + 1] > curve.knots[span])
      sum += term(span, curve.knots[span], curve.knots[span + 1]);
  }
  return sum;
}

template <typename Integrand>
double gauss(double begin, double end, Integrand integrand) {
  double sum = 0.0;
  for (const GaussPoint& node : kGauss) {
    sum += node.weight * integrand(0.5 * (begin + end) + 0.5 * (end - begin) * node.place);
  }
  return 0.5 * (end - begin) * sum;
}

double spline_length(const PlanarCurve& curve, std::size_t span, double begin, double end, int depth) {
  const auto speed = [&](double t) { return at_parameter(curve, span, t).derivative.norm(); };
  const double middle = 0.5 * (begin + end);
  const double whole = gauss(begin, end, speed);
  const double halves = gauss(begin, middle, speed) + gauss(middle, end, speed);
  if (std::abs(whole - halves) <= 1e-9 * halves || depth == 0) return halves;
  return spline_length(curve, span, begin, middle, depth - 1) +
         spline_length(curve, span, middle, end, depth - 1);
}

PointAndDerivative locate(const LineSegment& line, double u) {
  const Vector2 along = line.end - line.start;
  return {u < 1.0 ? Vector2(line.start + u * along) : line.end, along};
}

PointAndDerivative locate(const CircularArc& arc, double u) {
  const Vector2 from = arc.start - arc.centre;
  const double radius = from.norm();
  const double growth = (arc.end - arc.centre).norm() - radius;
  const double angle = u * arc.sweep;
  const Vector2 direction = (std::cos(angle) * from + std::sin(angle) * quarter_turn(from)) / radius;
  const double here = radius + u * growth;
  const Vector2 derivative = growth * direction + here * arc.sweep * quarter_turn(direction);
  if (u <= 0.0) return {arc.start, derivative};
  return {u < 1.0 ? Vector2(arc.centre + here * direction) : arc.end, derivative};
}

PointAndDerivative locate(const PlanarCurve& curve, double u) {
  const double width = curve.last_parameter() - curve.first_parameter();
  const double t = u < 1.0 ? curve.first_parameter() + u * width : curve.last_parameter();
  PointAndDerivative result = at_parameter(curve, find_span(curve.knots, curve.degree, t), t);
  result.derivative *= width;
  if (u <= 0.0) result.point = curve.control_points.front();
  if (u >= 1.0) result.point = curve.control_points.back();
  return result;
}

Box2 box_of(const LineSegment& line) {
  return Box2(line.start).extend(line.end);
}

Box2 box_of(const CircularArc& arc) {
  Box2 box = Box2(arc.start).extend(arc.end);
  const Vector2 from = arc.start - arc.centre;
  const double first = std::atan2(from.y(), from.x());
  const double low = std::min(first, first + arc.sweep);
  const double high = std::max(first, first + arc.sweep);
  for (double quarter = std::ceil(low / (pi / 2)); quarter * (pi / 2) <= high; ++quarter) {
    box.extend(point_on(arc, (quarter * (pi / 2) - first) / arc.sweep));
  }
  return box;
}

Box2 box_of(const PlanarCurve& curve) {
  return control_box(curve);
}

double length_of(const LineSegment& line) {
  return (line.end - line.start).norm();
}

double length_of(const CircularArc& arc) {
  return 0.5 * std::abs(arc.sweep) * (arc.radius() + (arc.end - arc.centre).norm());
}

double length_of(const PlanarCurve& curve) {
  return sum_over_spans(curve, [&](std::size_t span, double begin, double end) {
    return spline_length(curve, span, begin, end, 12);
  });
}

double area_of(const LineSegment& line) {
  return 0.5 * cross(line.start, line.end);
}

double area_of(const CircularArc& arc) {
  const double squared = (arc.start - arc.centre).norm() * (arc.end - arc.centre).norm();
  return 0.5 * cross(arc.start, arc.end) + 0.5 * squared * (arc.sweep - std::sin(arc.sweep));
}

double area_of(const PlanarCurve& curve) {
  // About the start, so that a curve far from the origin loses no digits; the triangle to the origin is added
  // after.
  const Vector2& start = curve.control_points.front();
  const double about_start = sum_over_spans(curve, [&](std::size_t span, double begin, double end) {
    return gauss(begin, end, [&](double t) {
      const PointAndDerivative here = at_parameter(curve, span, t);
      return 0.5 * cross(here.point - start, here.derivative);
    });
  });
  return about_start + 0.5 * cross(start, curve.control_points.back());
}

}  // namespace

Vector2 start_point(const CurvePiece& piece) {
  return point_on(piece, 0.0);
}

Vector2 end_point(const CurvePiece& piece) {
  return point_on(piece, 1.0);
}

Vector2 point_on(const CurvePiece& piece, double u) {
  return point_and_derivative(piece, u).point;
}

PointAndDerivative point_and_derivative(const CurvePiece& piece, double u) {
  return std::visit([u](const auto& shape) { return locate(shape, u); }, piece);
}

double length(const CurvePiece& piece) {
  return std::visit([](const auto& shape) { return length_of(shape); }, piece);
}

Box2 bounds(const CurvePiece& piece) {
  return std::visit([](const auto& shape) { return box_of(shape); }, piece);
}

double swept_area(const CurvePiece& piece) {
  return std::visit([](const auto& shape) { return area_of(shape); }, piece);
}

Vector2 start_tangent(const CurvePiece& piece) {
  return point_and_derivative(piece, 0.0).derivative.normalized();
}

Vector2 end_tangent(const CurvePiece& piece) {
  return point_and_derivative(piece, 1.0).derivative.normalized();
}

}  // namespace lamina::engine
