#pragma once

#include <cstddef>
#include <optional>

#include "engine/contour/fit/smooth_chain.h"
#include "engine/geometry/planar_curve.h"

namespace lamina::engine {

struct SplineFitOptions {
  double tolerance = 0.002;  ///< greatest distance of the nodes' cubics from the splines, mm
  int least_degree = 2;      ///< 2 to greatest_degree
  int greatest_degree = 5;   ///< to 5
};

/// What one search tells about the next one on the same contour.
struct SplineHint {
  int degree = 3;
  double ratio = 1.0;        ///< spans needed to spans of an evenly turning cubic
  std::size_t searches = 0;  ///< so far
};

/// Share of a cubic's span that a segment takes up: in a curve that turns evenly a span that turns by an
/// angle a deviates by a^4 / 500 of the radius.
double evenly_turning_spans(const SmoothChain& chain, std::size_t segment, double length, double tolerance);

/// One spline along a whole smooth chain.
struct SplineSearch {
  std::optional<PlanarCurve> curve;  ///< none if none with fewer control points than the nodes' cubics fits
  double greatest_distance = 0.0;    ///< measured by `span_distances`, mm; at most the tolerance
  std::optional<SplineHint> hint;    ///< for the next search
};

/// The spline with few control points that holds the tolerance along a chain.
///
/// Single Bezier segments first. Otherwise knots are simple and spread evenly over the error of the previous
/// attempt (de Boor, A Practical Guide to Splines, chapter XII, NEWNOT), and their number is narrowed down
/// until one less fails. Cubic and quintic are tried, the likelier is narrowed, the other degrees have to do
/// with fewer control points. The search is a local one: it finds few control points, not provably the
/// fewest. With a hint it starts from what the search before needed, keeps its degree but for every fourth
/// time, and stops within an eighth of the number of spans.
///
/// The search looks at samples only. Where the spline that it found is too far from the chain between them,
/// knots are put in there, a few times at most.
SplineSearch search_spline(const SmoothChain& chain, const SplineFitOptions& options,
                           const std::optional<SplineHint>& hint);

}  // namespace lamina::engine
