#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "engine/contour/fit/spline_system.h"
#include "engine/contour/fit/walked_chain.h"
#include "engine/geometry/planar_curve.h"

namespace lamina::engine {

/// A spline that holds the target at the samples, relative to the chain's first node, and the samples with
/// their parameters on it.
struct TriedSpline {
  PlanarCurve curve;
  std::vector<FitSample> samples;

  std::size_t controls() const { return curve.control_points.size(); }
  std::size_t spans() const { return controls() - static_cast<std::size_t>(curve.degree); }
};

/// What is known about the splines of one degree along a chain.
struct SplineTrial {
  int degree = 3;
  PlanarCurve curve;              ///< of the latest attempt
  std::vector<double> distances;  ///< of its spans, mm; empty if it has no solution
  bool within = false;            ///< it holds the target
  double predicted = 0.0;         ///< spans that should hold it
  std::size_t failed = 0;         ///< the most spans that did not hold it
  std::optional<TriedSpline> best;

  std::size_t spans() const { return curve.knots.size() - 2 * static_cast<std::size_t>(degree) - 1; }
  double controls_expected() const { return predicted + degree; }
};

/// Attempts to meet samples of one chain with splines of given knots.
class SplineTrials {
 public:
  /// `target`: distance to hold at the samples, mm. Refers to the chain, which must outlive it.
  SplineTrials(const WalkedChain& walk, double target) : walk_(walk), target_(target) {}

  /// Samples for that many control points, their parameters the way along the chain.
  void take_samples(std::size_t controls);

  /// Fits with the given knots, takes more samples where there are too few for them, and notes in the trial
  /// what came of it.
  void attempt(SplineTrial& trial, Knots knots);

  /// Knots for a first attempt: denser where the chain turns.
  Knots first_knots(int degree, std::size_t spans) const;

  /// Knots spread evenly over the order-th root of the latest distances, which is proportional to the spans'
  /// lengths.
  Knots knots_by_distance(const SplineTrial& trial, std::size_t spans) const;

  /// The knots of a spline, and one more in the middle of every span whose distance fails the target.
  Knots refined_knots(const PlanarCurve& curve, const std::vector<double>& distances) const;

  /// Greatest distance of a sample in the latest attempt, in targets.
  double latest_distance() const { return latest_greatest_ / target_; }

 private:
  bool hooks_at_ends(const PlanarCurve& curve) const;

  const WalkedChain& walk_;
  double target_;
  std::vector<FitSample> samples_;
  double latest_greatest_ = std::numeric_limits<double>::infinity();  // distance, mm
  SplineSystem system_;
};

}  // namespace lamina::engine
