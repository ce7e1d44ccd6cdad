#pragma once

#include <cstddef>

#include "engine/geometry/planar_curve.h"

namespace lamina::reference {

using namespace engine;

struct FitOptions {
  double epsilon = 0.05;  ///< greatest distance of the curve at a point's parameter from that point, mm
  int degree = 2;
};

struct FitResult {
  PlanarCurve curve;
  double greatest_distance = 0.0;  ///< of any point from the curve at the point's parameter, mm
  bool within_tolerance = true;    ///< false: the curve is the polyline through the points
};

/// Chord-length parameters on [0, 1] of a chain of points (dissertation p. 151).
std::vector<double> chord_length_parameters(const Polyline& points);

/// A subset of the points, first to last inclusive, that one Bezier segment approximates; neighbours share an
/// end.
struct BezierSegment {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Halves the chain of points until each part has a least-squares Bezier curve of the given degree, through
/// its end points, whose sum of squared distances is within `tolerance` (dissertation p. 152; the sum in mm^2
/// is compared with a tolerance in mm, as printed there).
std::vector<BezierSegment> divide_by_bezier_fit(const Polyline& points, const std::vector<double>& parameters,
                                                int degree, double tolerance);

/// A clamped knot vector on [0, 1] from the division. The parameters of each segment are averaged in degree +
/// 1 groups, and the averages again in groups of `degree`: one inner knot each (dissertation p. 153). The
/// printed rule takes the groups over all points; taken over each segment's points the knots lie dense where
/// the segments do, which is what the division is for. Never more inner knots than the points can carry.
Knots averaged_knots(const std::vector<double>& parameters, const std::vector<BezierSegment>& segments,
                     int degree);

/// Least-squares B-spline with the given knots through the first and the last point (The NURBS Book,
/// section 9.4.1).
PlanarCurve least_squares_curve(const Polyline& points, const std::vector<double>& parameters,
                                const Knots& knots, int degree);

/// The B-spline of an ordered set of cell locations: parameters, division, knots and least squares; the
/// tolerance of the division starts at epsilon and is halved until every point is within epsilon of the curve
/// (dissertation p. 150 to 154). A chain whose last point repeats the first gives a closed curve. Takes at
/// least two distinct points; the degree is lowered to what the number of points allows.
FitResult fit_curve(const Polyline& points, const FitOptions& options);

}  // namespace lamina::reference
