#include "tests/reference/contour/fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include "tests/reference/contour/contour_curve.h"

namespace lamina::reference {
namespace {

/// Inner control points of the least-squares Bezier curve for points [first, last], by the normal equations;
/// then the sum of squared distances.
double bezier_sum_of_squares(const Polyline& points, const std::vector<double>& parameters,
                             BezierSegment segment, int degree) {
  const auto inner = static_cast<Eigen::Index>(degree) - 1;
  const double start = parameters[segment.first];
  const double width = parameters[segment.last] - start;
  const Vector2& front = points[segment.first];
  const Vector2& back = points[segment.last];
  std::vector<std::vector<double>> rows;
  std::vector<Vector2> rests;  // what the inner control points have to explain
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(inner, inner);
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(inner, 2);
  for (std::size_t r = segment.first + 1; r < segment.last; ++r) {
    rows.push_back(bernstein(degree, (parameters[r] - start) / width));
    const std::vector<double>& basis = rows.back();
    rests.emplace_back(points[r] - basis.front() * front - basis.back() * back);
    for (Eigen::Index i = 0; i < inner; ++i) {
      const double at_i = basis[static_cast<std::size_t>(i) + 1];
      right.row(i) += at_i * rests.back().transpose();
      for (Eigen::Index j = 0; j < inner; ++j) normal(i, j) += at_i * basis[static_cast<std::size_t>(j) + 1];
    }
  }
  const Eigen::MatrixX2d control = normal.ldlt().solve(right);
  double sum = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Vector2 rest = rests[k];
    for (Eigen::Index i = 0; i < inner; ++i)
      rest -= rows[k][static_cast<std::size_t>(i) + 1] * control.row(i).transpose();
    sum += rest.squaredNorm();
  }
  return sum;
}

void divide(const Polyline& points, const std::vector<double>& parameters, int degree, double tolerance,
            BezierSegment segment, std::vector<BezierSegment>& segments) {
  // With no more inner points than inner control points the segment interpolates: nothing is left to divide.
  const std::size_t inner_points = segment.last - segment.first - 1;
  if (inner_points <= static_cast<std::size_t>(degree - 1) ||
      bezier_sum_of_squares(points, parameters, segment, degree) <= tolerance) {
    segments.push_back(segment);
    return;
  }
  const std::size_t middle = segment.first + (segment.last - segment.first) / 2;
  divide(points, parameters, degree, tolerance, {segment.first, middle}, segments);
  divide(points, parameters, degree, tolerance, {middle, segment.last}, segments);
}

/// Means of `count` consecutive groups of nearly equal size.
std::vector<double> group_means(const std::vector<double>& values, std::size_t count) {
  std::vector<double> means;
  for (std::size_t g = 0; g < count; ++g) {
    const std::size_t begin = g * values.size() / count;
    const std::size_t end = std::max(begin + 1, (g + 1) * values.size() / count);
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += values[i];
    means.push_back(sum / static_cast<double>(end - begin));
  }
  return means;
}

double greatest_distance(const PlanarCurve& curve, const Polyline& points,
                         const std::vector<double>& parameters) {
  double greatest = 0.0;
  for (std::size_t r = 0; r < points.size(); ++r) {
    greatest = std::max(greatest, (evaluate(curve, parameters[r]) - points[r]).norm());
  }
  return greatest;
}

/// The knots as they were, but without those that leave a basis function without data (Schoenberg and
/// Whitney): one parameter strictly inside each support is needed for the equations to have one solution.
Knots supported_knots(const Knots& knots, int degree, const std::vector<double>& parameters) {
  const auto p = static_cast<std::size_t>(degree);
  Knots result(knots.begin(), knots.begin() + degree + 1);
  std::size_t used = 1;  // the first parameter belongs to the first control point
  for (std::size_t i = p + 1; i + p + 1 < knots.size(); ++i) {
    const double previous = result.back();
    std::size_t next = used;
    while (next < parameters.size() && parameters[next] <= previous) ++next;
    if (next + 1 >= parameters.size() || parameters[next] >= knots[i] || knots[i] >= 1.0) continue;
    result.push_back(knots[i]);
    used = next + 1;
  }
  result.insert(result.end(), knots.end() - degree - 1, knots.end());
  return result;
}

}  // namespace

std::vector<double> chord_length_parameters(const Polyline& points) {
  const double total = length(points);
  std::vector<double> parameters{0.0};
  double walked = 0.0;
  for (std::size_t r = 1; r < points.size(); ++r) {
    walked += (points[r] - points[r - 1]).norm();
    parameters.push_back(walked / total);
  }
  parameters.back() = 1.0;
  return parameters;
}

std::vector<BezierSegment> divide_by_bezier_fit(const Polyline& points, const std::vector<double>& parameters,
                                                int degree, double tolerance) {
  std::vector<BezierSegment> segments;
  divide(points, parameters, degree, tolerance, {0, points.size() - 1}, segments);
  return segments;
}

Knots averaged_knots(const std::vector<double>& parameters, const std::vector<BezierSegment>& segments,
                     int degree) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> representatives;
  for (const BezierSegment segment : segments) {
    const std::vector<double> values(parameters.begin() + static_cast<std::ptrdiff_t>(segment.first),
                                     parameters.begin() + static_cast<std::ptrdiff_t>(segment.last) + 1);
    const std::vector<double> means = group_means(values, std::min(p + 1, values.size()));
    representatives.insert(representatives.end(), means.begin(), means.end());
  }
  // A single segment is a Bezier curve: it has no inner knot.
  const std::size_t count = segments.size() == 1 ? 0 : representatives.size() / p;
  Knots knots(p + 1, 0.0);
  const std::vector<double> inner = group_means(representatives, count);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), p + 1, 1.0);
  return supported_knots(knots, degree, parameters);
}

PlanarCurve least_squares_curve(const Polyline& points, const std::vector<double>& parameters,
                                const Knots& knots, int degree) {
  PlanarCurve curve;
  curve.degree = degree;
  curve.knots = knots;
  const auto count = static_cast<Eigen::Index>(knots.size()) - degree - 1;
  const Eigen::Index inner = count - 2;
  curve.control_points.assign(static_cast<std::size_t>(count), Vector2::Zero());
  curve.control_points.front() = points.front();
  curve.control_points.back() = points.back();
  if (inner <= 0) return curve;

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(inner, 2);
  for (std::size_t r = 1; r + 1 < points.size(); ++r) {
    const std::size_t span = find_span(knots, degree, parameters[r]);
    const BasisRow basis = basis_functions(knots, degree, span, parameters[r]);
    const Eigen::Index first = static_cast<Eigen::Index>(span) - degree;
    Vector2 rest = points[r];
    for (Eigen::Index k = 0; k <= degree; ++k) {
      if (first + k == 0) rest -= basis[static_cast<std::size_t>(k)] * points.front();
      if (first + k == count - 1) rest -= basis[static_cast<std::size_t>(k)] * points.back();
    }
    for (Eigen::Index k = 0; k <= degree; ++k) {
      const Eigen::Index i = first + k - 1;
      if (i < 0 || i >= inner) continue;
      right.row(i) += basis[static_cast<std::size_t>(k)] * rest.transpose();
      for (Eigen::Index l = 0; l <= k; ++l) {
        const Eigen::Index j = first + l - 1;
        if (j >= 0)
          entries.emplace_back(i, j, basis[static_cast<std::size_t>(k)] * basis[static_cast<std::size_t>(l)]);
      }
    }
  }
  Eigen::SparseMatrix<double> normal(inner, inner);
  normal.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> solver(
      normal);
  const Eigen::MatrixX2d control = solver.solve(right);
  for (Eigen::Index i = 0; i < inner; ++i)
    curve.control_points[static_cast<std::size_t>(i) + 1] = control.row(i).transpose();
  return curve;
}

FitResult fit_curve(const Polyline& points, const FitOptions& options) {
  assert(points.size() >= 2);
  const int degree = std::clamp(options.degree, 1, static_cast<int>(points.size()) - 1);
  const std::vector<double> parameters = chord_length_parameters(points);
  std::size_t segment_count = 0;
  for (double tolerance = options.epsilon;; tolerance *= 0.5) {
    const std::vector<BezierSegment> segments = divide_by_bezier_fit(points, parameters, degree, tolerance);
    if (segments.size() == segment_count) {
      // A halved tolerance that divides nothing more may still do so when halved again, until every segment
      // interpolates its points.
      const bool interpolates = std::all_of(segments.begin(), segments.end(), [&](BezierSegment segment) {
        return segment.last - segment.first <= static_cast<std::size_t>(degree);
      });
      if (interpolates) break;
      continue;
    }
    segment_count = segments.size();
    const Knots knots = averaged_knots(parameters, segments, degree);
    FitResult result{least_squares_curve(points, parameters, knots, degree), 0.0, true};
    result.greatest_distance = greatest_distance(result.curve, points, parameters);
    if (result.greatest_distance <= options.epsilon) return result;
  }
  return {polyline_curve(points), 0.0, false};
}

}  // namespace lamina::reference
