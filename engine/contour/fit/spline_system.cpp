#include "engine/contour/fit/spline_system.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

constexpr double kAlongWeight = 0.0001;

/// The one inner control point of a single parabola: where the end tangents meet, ahead of the start and
/// behind the end.
bool place_apex(PlanarCurve& curve, const FitSample& first, const FitSample& last) {
  const Vector2 chord = last.position - first.position;
  const double sine = cross(first.tangent, last.tangent);
  if (std::abs(sine) < 1e-9) return false;
  const double ahead = cross(chord, last.tangent) / sine;
  const double behind = cross(first.tangent, chord) / sine;
  if (!(ahead > 0.0 && behind > 0.0)) return false;
  curve.control_points = {first.position, first.position + ahead * first.tangent, last.position};
  return true;
}

}  // namespace

template <int kDegree>
void SplineSystem::assemble(const PlanarCurve& curve, const std::vector<FitSample>& samples) {
  constexpr auto kCount = static_cast<std::size_t>(kDegree) + 1;
  const std::size_t controls = curve.knots.size() - kCount;
  matrix_.reset(2 * controls, 2 * kCount - 1);
  right_.assign(2 * controls, 0.0);
  windows_.resize(samples.size());

  // Of the span: each pair of basis functions, lower triangle column by column.
  using Pairs = std::array<double, kCount*(kCount + 1) / 2>;
  Pairs block_xx{};
  Pairs block_xy{};
  Pairs block_yy{};
  std::array<double, kCount> side_x{};
  std::array<double, kCount> side_y{};
  const auto flush = [&](std::size_t first) {
    std::size_t pair = 0;
    for (std::size_t j = 0; j < kCount; ++j) {
      double* const column_x = &matrix_.at(2 * (first + j), 2 * (first + j));
      double* const column_y = &matrix_.at(2 * (first + j) + 1, 2 * (first + j) + 1);
      for (std::size_t below = 0; below < kCount - j; ++below, ++pair) {
        column_x[2 * below] += block_xx[pair];
        column_x[2 * below + 1] += block_xy[pair];
        if (below > 0) column_y[2 * below - 1] += block_xy[pair];
        column_y[2 * below] += block_yy[pair];
      }
      right_[2 * (first + j)] += side_x[j];
      right_[2 * (first + j) + 1] += side_y[j];
    }
    block_xx = {};
    block_xy = {};
    block_yy = {};
    side_x = {};
    side_y = {};
  };

  std::size_t span = kCount - 1;
  SpanBasis<kDegree> basis(curve.knots, span);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const FitSample& sample = samples[k];
    if (sample.parameter >= curve.knots[span + 1] && span + 1 < controls) {
      flush(span + 1 - kCount);
      while (span + 1 < controls && sample.parameter >= curve.knots[span + 1]) ++span;
      basis = SpanBasis<kDegree>(curve.knots, span);
    }
    windows_[k] = basis.at(sample.parameter);
    const auto& value = windows_[k].value;
    // Weight one across the tangent (x, y), a small one along it: I - (1 - w) t t^T.
    const double x = sample.tangent.x();
    const double y = sample.tangent.y();
    const double xx = 1.0 - (1.0 - kAlongWeight) * x * x;
    const double xy = -(1.0 - kAlongWeight) * x * y;
    const double yy = 1.0 - (1.0 - kAlongWeight) * y * y;
    const double right_x = xx * sample.position.x() + xy * sample.position.y();
    const double right_y = xy * sample.position.x() + yy * sample.position.y();
    Pairs products;
    std::size_t pair = 0;
    for (std::size_t j = 0; j < kCount; ++j) {
      for (std::size_t i = j; i < kCount; ++i, ++pair) products[pair] = value[i] * value[j];
    }
    for (std::size_t j = 0; j < kCount; ++j) {
      side_x[j] += value[j] * right_x;
      side_y[j] += value[j] * right_y;
    }
    for (pair = 0; pair < products.size(); ++pair) {
      block_xx[pair] += products[pair] * xx;
      block_xy[pair] += products[pair] * xy;
      block_yy[pair] += products[pair] * yy;
    }
  }
  flush(span + 1 - kCount);
}

/// Replaces the coordinates of a control point by those along and across `direction`.
void SplineSystem::turn_unknowns(std::size_t control, const Vector2& direction) {
  const std::size_t first = 2 * control;
  const double c = direction.x();
  const double s = direction.y();
  const auto turn = [c, s](double& along, double& across) {
    const double x = along;
    along = c * x + s * across;
    across = c * across - s * x;
  };
  const std::size_t reach = matrix_.half_width() - 1;  // of an even row: whole control points
  const std::size_t begin = first > reach ? first - reach : 0;
  for (std::size_t k = begin; k < first; ++k) turn(matrix_.at(first, k), matrix_.at(first + 1, k));
  const std::size_t end = std::min(matrix_.size(), first + reach + 2);
  for (std::size_t k = first + 2; k < end; ++k) turn(matrix_.at(k, first), matrix_.at(k, first + 1));
  const double xx = matrix_.at(first, first);
  const double xy = matrix_.at(first + 1, first);
  const double yy = matrix_.at(first + 1, first + 1);
  matrix_.at(first, first) = c * c * xx + 2.0 * c * s * xy + s * s * yy;
  matrix_.at(first + 1, first) = c * s * (yy - xx) + (c * c - s * s) * xy;
  matrix_.at(first + 1, first + 1) = s * s * xx - 2.0 * c * s * xy + c * c * yy;
  turn(right_[first], right_[first + 1]);
}

void SplineSystem::fix(std::size_t unknown, double value) {
  const std::size_t width = matrix_.half_width();
  for (std::size_t k = unknown > width ? unknown - width : 0; k < unknown; ++k) {
    right_[k] -= matrix_.at(unknown, k) * value;
    matrix_.at(unknown, k) = 0.0;
  }
  const std::size_t end = std::min(matrix_.size(), unknown + width + 1);
  for (std::size_t k = unknown + 1; k < end; ++k) {
    right_[k] -= matrix_.at(k, unknown) * value;
    matrix_.at(k, unknown) = 0.0;
  }
  matrix_.at(unknown, unknown) = 1.0;
  right_[unknown] = value;
}

bool SplineSystem::solve(PlanarCurve& curve, const std::vector<FitSample>& samples) {
  assert(curve.degree >= 2 && curve.degree <= kHighestWindowDegree);
  const std::size_t controls = curve.knots.size() - static_cast<std::size_t>(curve.degree) - 1;
  const FitSample& first = samples.front();
  const FitSample& last = samples.back();
  with_degree(curve.degree, [&](auto degree) { assemble<degree>(curve, samples); });
  if (controls == 3) return place_apex(curve, first, last);

  const std::size_t penultimate = controls - 2;
  const auto across = [](const Vector2& direction, const Vector2& point) { return cross(direction, point); };
  turn_unknowns(1, first.tangent);
  turn_unknowns(penultimate, last.tangent);
  fix(0, first.position.x());
  fix(1, first.position.y());
  fix(3, across(first.tangent, first.position));
  fix(2 * penultimate + 1, across(last.tangent, last.position));
  fix(2 * penultimate + 2, last.position.x());
  fix(2 * penultimate + 3, last.position.y());
  if (!matrix_.factorise()) return false;
  matrix_.solve(right_);

  curve.control_points.resize(controls);
  for (std::size_t i = 0; i < controls; ++i) curve.control_points[i] = {right_[2 * i], right_[2 * i + 1]};
  const double start_arm = right_[2] - first.tangent.dot(first.position);
  const double end_arm = last.tangent.dot(last.position) - right_[2 * penultimate];
  // From the ends themselves, so that they lie on the tangents to the last digit.
  curve.control_points.front() = first.position;
  curve.control_points[1] = first.position + start_arm * first.tangent;
  curve.control_points[penultimate] = last.position - end_arm * last.tangent;
  curve.control_points.back() = last.position;
  return true;
}

std::vector<double> SplineSystem::correct_parameters(const PlanarCurve& curve,
                                                     std::vector<FitSample>& samples) {
  const auto p = static_cast<std::size_t>(curve.degree);
  std::vector<double> distances(curve.control_points.size() - p, 0.0);
  const double end = curve.last_parameter();
  double before = curve.first_parameter();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    FitSample& sample = samples[k];
    const BasisWindow& window = windows_[k];
    Vector2 gap = -sample.position;
    Vector2 derivative = Vector2::Zero();
    for (std::size_t r = 0; r <= p; ++r) {
      const Vector2& control = curve.control_points[window.first + r];
      gap += window.value[r] * control;
      derivative += window.slope[r] * control;
    }
    const double speed = derivative.norm();
    double distance = gap.norm();
    if (speed > 0.0) {
      distance = std::abs(cross(derivative, gap)) / speed;
      sample.parameter -= gap.dot(derivative) / (speed * speed);
    }
    if (sample.parameter < before || sample.parameter > end) {
      // The foot point is out of order: the curve folds here.
      sample.parameter = std::clamp(sample.parameter, before, end);
      distance = gap.norm();
    }
    before = sample.parameter;
    distances[window.first] = std::max(distances[window.first], distance);
  }
  samples.front().parameter = curve.first_parameter();
  samples.back().parameter = end;
  return distances;
}

}  // namespace lamina::engine
