#include "engine/contour/fit/spline_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/contour/fit/spline_distance.h"
#include "engine/contour/fit/spline_trial.h"
#include "engine/contour/fit/walked_chain.h"
#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

// Of the tolerance while searching: between samples the distance may be greater.
constexpr double kSearchShare = 0.92;
constexpr int kAttempts = 12;
constexpr int kRepairs = 4;
constexpr std::size_t kFewSpans = 40;  // knots of more are refined where they fail, not spread again
// Cubic spans of an evenly turning curve up to which a single quartic or quintic segment is tried.
constexpr double kMostForOneSpan = 4.0;
constexpr double kHopelessForOneSpan = 40.0;  // times the target, of a cubic, where there is a hint
constexpr std::size_t kExpectedNotOne = 4;    // spans: no single segment is tried where a hint expects more
constexpr std::size_t kSearchesPerDegreeSearch = 4;
constexpr std::size_t kNarrowEnoughWithHint = 8;
constexpr std::size_t kNarrowEnough = 24;     // part of the number of spans to which the fewest is found
constexpr std::size_t kMostForParabolas = 8;  // control points

class Searcher {
 public:
  Searcher(const WalkedChain& walk, const SplineFitOptions& options, const std::optional<SplineHint>& hint)
      : walk_(walk), options_(options), hint_(hint), trials_(walk, kSearchShare * options.tolerance) {
    for (std::size_t i = 0; i < walk.segments(); ++i)
      evenly_turning_ += evenly_turning_spans(walk.chain, i, walk.lengths[i], options.tolerance);
  }

  SplineSearch run() {
    SplineSearch result;
    result.hint = hint_;
    std::optional<TriedSpline> found = search();
    for (int repairs = 0; found; ++repairs) {
      const std::vector<double> distances = span_distances(found->curve, found->samples, walk_);
      result.greatest_distance = *std::max_element(distances.begin(), distances.end());
      if (result.greatest_distance <= options_.tolerance) break;
      found = repairs < kRepairs ? repaired(*found, distances) : std::nullopt;
    }
    if (!found) return result;
    const double ratio =
        std::clamp(static_cast<double>(found->spans()) / std::max(evenly_turning_, 1e-3), 0.2, 5.0);
    result.hint = hint_
                      ? SplineHint{found->curve.degree, std::sqrt(hint_->ratio * ratio), hint_->searches + 1}
                      : SplineHint{found->curve.degree, ratio, 1};
    const std::vector<Vector2>& nodes = walk_.chain.positions;
    result.curve = std::move(found->curve);
    for (Vector2& point : result.curve->control_points) point += nodes.front();
    result.curve->control_points.front() = nodes.front();
    result.curve->control_points.back() = nodes.back();
    return result;
  }

 private:
  bool allowed(int degree) const {
    return degree >= options_.least_degree && degree <= options_.greatest_degree;
  }

  std::optional<TriedSpline> search() {
    if (std::optional<TriedSpline> single = single_segment()) return single;
    // One attempt with a cubic and one with a quintic tell which of them is the likelier; its number of spans
    // is narrowed down. The other degrees are tried with one control point less.
    trials_.take_samples(expected_spans() + 3);
    std::vector<SplineTrial> tried;
    for (const int degree : {hint_ ? hint_->degree : 3, 5, 4, 3, 2}) {
      if (!allowed(degree)) continue;
      if (tried.size() == (hint_ ? 1 : 2) ||
          (tried.size() == 1 && tried.front().best && tried.front().spans() == 1))
        break;
      tried.push_back(first_attempt(degree, std::min(expected_spans(), most_spans(degree))));
    }
    std::stable_sort(tried.begin(), tried.end(), [](const SplineTrial& a, const SplineTrial& b) {
      return a.controls_expected() < b.controls_expected();
    });
    narrow(tried.front(), most_spans(tried.front().degree));
    std::optional<TriedSpline> best = std::move(tried.front().best);
    if (best && hint_ && hint_->searches % kSearchesPerDegreeSearch != 0) return best;
    const int main_degree = tried.front().degree;
    for (const int degree : {3, 5, 4, 2}) {
      if (!allowed(degree) || degree == main_degree) continue;
      const std::size_t limit = spans_to_beat(best, degree);
      if (limit == 0) continue;
      const auto known = std::find_if(tried.begin(), tried.end(),
                                      [&](const SplineTrial& trial) { return trial.degree == degree; });
      SplineTrial trial = known != tried.end()
                              ? std::move(*known)
                              : first_attempt(degree, best ? limit : std::min(expected_spans(), limit));
      if (known != tried.end() && (!trial.best || trial.spans() > limit))
        trials_.attempt(trial, trials_.knots_by_distance(trial, limit));
      narrow(trial, limit);
      if (trial.best) best = std::move(trial.best);  // within the limit, so it is better
    }
    return best;
  }

  /// A single Bezier segment may meet what an evenly turning spline needs many spans for.
  std::optional<TriedSpline> single_segment() {
    if (hint_ && expected_spans() > kExpectedNotOne) return std::nullopt;
    for (int degree = options_.least_degree; degree <= options_.greatest_degree; ++degree) {
      if (degree > 3 && evenly_turning_ > kMostForOneSpan) break;
      trials_.take_samples(static_cast<std::size_t>(degree) + 1);
      SplineTrial trial = first_attempt(degree, 1);
      if (trial.best) return std::move(trial.best);
      if (hint_ && degree >= 3 && trials_.latest_distance() > kHopelessForOneSpan) break;
    }
    return std::nullopt;
  }

  SplineTrial first_attempt(int degree, std::size_t spans) {
    SplineTrial trial;
    trial.degree = degree;
    trials_.attempt(trial, trials_.first_knots(degree, spans));
    return trial;
  }

  /// A spline needs fewer control points than the cubics of the segments.
  std::size_t most_spans(int degree) const {
    const std::size_t cubics = 2 * walk_.segments() + 2;
    const auto p = static_cast<std::size_t>(degree);
    return cubics > p ? cubics - p : 1;
  }

  /// The most spans of that degree that are better than the best spline, if there is one; none is 0. As many
  /// control points from a lower degree are better than from a higher one.
  std::size_t spans_to_beat(const std::optional<TriedSpline>& best, int degree) const {
    if (!best) return most_spans(degree);
    const auto p = static_cast<std::size_t>(degree);
    const std::size_t most_controls = best->controls() - (degree < best->curve.degree ? 0 : 1);
    if (most_controls <= p || (degree == 2 && most_controls > kMostForParabolas)) return 0;
    return std::min(most_spans(degree), most_controls - p);
  }

  std::size_t expected_spans() const {
    return std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(evenly_turning_ * (hint_ ? hint_->ratio : 1.0))));
  }

  /// Looks for the fewest spans, at most `limit`, that hold the target, from the trial's latest attempt on.
  void narrow(SplineTrial& trial, std::size_t limit) {
    if (trial.best && trial.best->spans() > limit) trial.best.reset();
    bool repeated = false;
    for (int count = 0; count < kAttempts; ++count) {
      const std::size_t spans = trial.spans();
      const std::size_t held = trial.best ? trial.best->spans() : limit + 1;
      const auto predicted = static_cast<std::size_t>(std::ceil(trial.predicted));
      const std::size_t near = held / (hint_ ? kNarrowEnoughWithHint : kNarrowEnough);
      if (trial.failed + 1 >= held || (trial.best && held - trial.failed <= near) ||
          (hint_ && trial.within && predicted + near >= held))
        break;
      const bool badly_spread = !trial.within && predicted <= spans;
      if (badly_spread && !repeated && spans < held && spans <= kFewSpans) {
        repeated = true;
        trial.failed = spans - 1;
        trials_.attempt(trial, trials_.knots_by_distance(trial, spans));
        continue;
      }
      repeated = false;
      if (!trial.best && trial.predicted > 2.0 * static_cast<double>(limit)) break;
      std::optional<Knots> knots;
      if (badly_spread && !trial.distances.empty()) {
        Knots refined = trials_.refined_knots(trial.curve, trial.distances);
        if (refined.size() < held + 2 * static_cast<std::size_t>(trial.degree) + 1)
          knots = std::move(refined);
      }
      if (!knots) {
        // A failure calls for a twentieth more at least, and tells nothing about more than twice as many.
        const std::size_t least = trial.within ? trial.failed + 1 : trial.failed + 1 + trial.failed / 20;
        const std::size_t most = std::min(held - 1, 2 * spans + 4);
        knots = trials_.knots_by_distance(trial, std::min(std::max(predicted, least), most));
      }
      trials_.attempt(trial, *knots);
    }
  }

  /// The same spline with knots put in where it is too far from the chain between the samples, and with twice
  /// as many samples as are usual.
  std::optional<TriedSpline> repaired(const TriedSpline& found, std::vector<double> distances) {
    trials_.take_samples(2 * found.controls());
    SplineTrial trial;
    trial.degree = found.curve.degree;
    trial.curve = found.curve;
    for (int count = 0; count < kRepairs && !trial.best; ++count) {
      Knots knots = trials_.refined_knots(trial.curve, distances);
      if (knots.size() > most_spans(trial.degree) + 2 * static_cast<std::size_t>(trial.degree) + 1) break;
      trials_.attempt(trial, std::move(knots));
      if (trial.distances.empty()) break;
      distances = trial.distances;
    }
    return std::move(trial.best);
  }

  const WalkedChain& walk_;
  const SplineFitOptions& options_;
  const std::optional<SplineHint>& hint_;
  SplineTrials trials_;
  double evenly_turning_ = 0.0;  // spans of a cubic
};

}  // namespace

double evenly_turning_spans(const SmoothChain& chain, std::size_t segment, double length, double tolerance) {
  const Vector2& a = chain.tangents[segment];
  const Vector2& b = chain.tangents[segment + 1];
  const double turn = std::abs(cross(a, b));
  return std::sqrt(std::sqrt(turn * turn * turn * length / (500.0 * tolerance)));
}

SplineSearch search_spline(const SmoothChain& chain, const SplineFitOptions& options,
                           const std::optional<SplineHint>& hint) {
  const WalkedChain walk(chain);
  return Searcher(walk, options, hint).run();
}

}  // namespace lamina::engine
