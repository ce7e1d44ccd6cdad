#include "engine/contour/fit/spline_trial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/contour/fit/knot_density.h"
#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kSamplesPerControl = 4;
constexpr std::size_t kFewestSamples = 24;
constexpr int kCorrections = 4;
constexpr int kDoublings = 3;             // of the samples, for short spans
constexpr double kNearlyRight = 3.0;      // times the target
constexpr double kHopeless = 40.0;        // times the target
constexpr std::size_t kVeryFewSpans = 4;  // their parametrisation may be far from arc length

/// How much longer a span is than one that would just hold the target.
double relative_length(double distance, double target, int degree) {
  return std::pow(std::max(distance / target, 1e-3), 1.0 / (static_cast<double>(degree) + 1.0));
}

/// Whether there is a sample for every knot span, by arc length.
bool each_span_is_sampled(const PlanarCurve& curve, const std::vector<FitSample>& samples) {
  std::size_t sample = 0;
  const auto p = static_cast<std::size_t>(curve.degree);
  for (std::size_t k = p; k + p + 1 < curve.knots.size(); ++k) {
    while (sample < samples.size() && samples[sample].walked < curve.knots[k]) ++sample;
    if (sample == samples.size() || samples[sample].walked > curve.knots[k + 1]) return false;
  }
  return true;
}

}  // namespace

void SplineTrials::take_samples(std::size_t controls) {
  samples_ = samples_of(walk_, std::max(kSamplesPerControl * controls, kFewestSamples));
  latest_greatest_ = std::numeric_limits<double>::infinity();
}

void SplineTrials::attempt(SplineTrial& trial, Knots knots) {
  trial.curve.degree = trial.degree;
  trial.curve.knots = std::move(knots);
  trial.distances.clear();
  trial.within = false;
  const std::size_t spans = trial.spans();
  const std::size_t controls = spans + static_cast<std::size_t>(trial.degree);
  if (kSamplesPerControl * controls > 2 * samples_.size()) take_samples(controls);
  // A span without a sample is free to dart out.
  for (int doubling = 1; doubling <= kDoublings && !each_span_is_sampled(trial.curve, samples_); ++doubling)
    take_samples(controls << doubling);
  // Parameters corrected for a curve that was nearly right are a better start than arc length.
  if (!(latest_greatest_ < kNearlyRight * target_)) {
    for (FitSample& sample : samples_) sample.parameter = sample.walked;
  }
  double greatest = 0.0;
  for (int round = 0; round < kCorrections; ++round) {
    if (!system_.solve(trial.curve, samples_)) {
      trial.distances.clear();
      break;
    }
    trial.distances = system_.correct_parameters(trial.curve, samples_);
    if (hooks_at_ends(trial.curve)) {
      for (double* end : {&trial.distances.front(), &trial.distances.back()})
        *end = std::max(*end, 1.5 * target_);
    }
    const double before = greatest;
    greatest = *std::max_element(trial.distances.begin(), trial.distances.end());
    trial.within = greatest <= target_;
    const bool slow = round > 0 && greatest > 0.7 * before;
    const bool far = spans > kVeryFewSpans && greatest > kHopeless * target_;
    if (trial.within || slow || far) break;
  }
  if (trial.distances.empty()) {
    latest_greatest_ = std::numeric_limits<double>::infinity();
    trial.predicted = 1.25 * static_cast<double>(spans) + 1.0;
    trial.failed = std::max(trial.failed, spans);
    return;
  }
  latest_greatest_ = greatest;
  trial.predicted = 0.0;
  for (const double distance : trial.distances)
    trial.predicted += relative_length(distance, target_, trial.degree);
  if (trial.within) {
    trial.best = TriedSpline{trial.curve, samples_};
  } else {
    trial.failed = std::max(trial.failed, spans);
  }
}

/// Whether the curve leaves its start, or meets its end, against the tangent there: all samples may be met
/// nevertheless.
bool SplineTrials::hooks_at_ends(const PlanarCurve& curve) const {
  const std::size_t last = curve.control_points.size() - 1;
  const std::vector<Vector2>& tangents = walk_.chain.tangents;
  return (curve.control_points[1] - curve.control_points[0]).dot(tangents.front()) <= 0.0 ||
         (curve.control_points[last] - curve.control_points[last - 1]).dot(tangents.back()) <= 0.0;
}

Knots SplineTrials::first_knots(int degree, std::size_t spans) const {
  if (spans == 1) return KnotDensity({0.0, walk_.walked.back()}, {1.0}).knots(degree, 1);
  const double share = static_cast<double>(degree) / (static_cast<double>(degree) + 1.0);
  std::vector<double> turns;
  turns.reserve(walk_.segments());
  double turning = 0.0;
  for (std::size_t i = 0; i < walk_.segments(); ++i) {
    const Vector2& a = walk_.chain.tangents[i];
    const Vector2& b = walk_.chain.tangents[i + 1];
    turns.push_back(std::abs(cross(a, b)));
    turning += turns.back();
  }
  const double mean = (turning + 0.1) / walk_.walked.back();
  std::vector<double> masses;
  masses.reserve(walk_.segments());
  for (std::size_t i = 0; i < walk_.segments(); ++i) {
    const double length = walk_.lengths[i];
    masses.push_back(length * (std::pow(turns[i] / length / mean, share) + 0.2));
  }
  return KnotDensity(walk_.walked, masses).knots(degree, spans);
}

Knots SplineTrials::knots_by_distance(const SplineTrial& trial, std::size_t spans) const {
  if (trial.distances.empty()) return first_knots(trial.degree, spans);
  const Knots& knots = trial.curve.knots;
  std::vector<double> masses;
  masses.reserve(trial.distances.size());
  for (const double distance : trial.distances)
    masses.push_back(relative_length(distance, target_, trial.degree));
  return KnotDensity({knots.begin() + trial.degree, knots.end() - trial.degree}, masses)
      .knots(trial.degree, spans);
}

Knots SplineTrials::refined_knots(const PlanarCurve& curve, const std::vector<double>& distances) const {
  Knots knots = curve.knots;
  const auto p = static_cast<std::size_t>(curve.degree);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] > target_) knots.push_back(0.5 * (curve.knots[p + i] + curve.knots[p + i + 1]));
  }
  std::sort(knots.begin(), knots.end());
  return knots;
}

}  // namespace lamina::engine
