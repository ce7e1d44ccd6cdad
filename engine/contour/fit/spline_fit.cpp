#include "engine/contour/fit/spline_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/contour/fit/knot_density.h"
#include "engine/contour/fit/spline_system.h"
#include "engine/geometry/basis_window.h"

namespace lamina::engine {
namespace {

// Of the tolerance while searching: between samples the distance may be greater.
constexpr double kSearchShare = 0.92;
constexpr std::size_t kSamplesPerControl = 4;
constexpr std::size_t kPlacesPerSpan = 10;
constexpr int kCorrections = 4;
constexpr int kAttempts = 12;
constexpr double kNearlyRight = 3.0;      // times the target
constexpr double kHopeless = 40.0;        // times the target
constexpr std::size_t kVeryFewSpans = 4;  // their parametrisation may be far from arc length
constexpr std::size_t kFewSpans = 40;     // knots of more are refined where they fail, not spread again
// Cubic spans of an evenly turning curve up to which a single quartic or quintic segment is tried.
constexpr double kMostForOneSpan = 4.0;
constexpr std::size_t kPartsPerDegreeSearch = 4;
constexpr std::size_t kNarrowEnoughInParts = 8;
constexpr std::size_t kNarrowEnough = 24;     // part of the number of spans to which the fewest is found
constexpr double kManageableSpans = 10.0;     // cubic spans of an evenly turning curve in one spline
constexpr std::size_t kMostForParabolas = 8;  // control points

double cross(const Vector2& a, const Vector2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Share of a cubic's span that a segment takes up: in a curve that turns evenly a span that turns by a
/// deviates by a^4 / 500 of the radius.
double cubic_spans(const SmoothChain& chain, std::size_t segment, double length, double tolerance) {
  const double turn = std::abs(cross(chain.tangents[segment], chain.tangents[segment + 1]));
  return std::sqrt(std::sqrt(turn * turn * turn * length / (500.0 * tolerance)));
}

/// What the fit of one part of a chain tells about the next.
struct SearchHint {
  int degree = 3;
  double ratio = 1.0;     ///< spans needed to spans of an evenly turning cubic
  std::size_t parts = 0;  ///< fitted so far
};

/// One spline over a whole chain.
class SplineSearch {
 public:
  SplineSearch(const SmoothChain& chain, const SplineFitOptions& options, std::optional<SearchHint> hint)
      : chain_(chain), options_(options), hint_(hint), lengths_(segment_lengths(chain)) {
    walked_.reserve(chain.positions.size());
    walked_.push_back(0.0);
    for (std::size_t i = 0; i < lengths_.size(); ++i) {
      walked_.push_back(walked_.back() + lengths_[i]);
      evenly_turning_spans_ += cubic_spans(chain, i, lengths_[i], options.tolerance);
    }
  }

  /// After `best`.
  std::optional<SearchHint> hint() const { return hint_; }

  /// The curve with the fewest control points that holds the tolerance and its greatest distance, or nothing.
  std::optional<std::pair<PlanarCurve, double>> best() {
    for (const double share : {kSearchShare, 0.8 * kSearchShare}) {
      target_ = share * options_.tolerance;
      std::optional<Found> found = search();
      if (!found) return std::nullopt;
      const double distance = greatest_distance(*found);
      hint_ = SearchHint{
          found->curve.degree,
          std::clamp(static_cast<double>(found->spans()) / std::max(evenly_turning_spans_, 1e-3), 0.2, 5.0),
          hint_ ? hint_->parts + 1 : 1};
      if (distance <= options_.tolerance) {
        PlanarCurve curve = std::move(found->curve);
        for (Vector2& point : curve.control_points) point += chain_.positions.front();
        curve.control_points.front() = chain_.positions.front();
        curve.control_points.back() = chain_.positions.back();
        return std::make_pair(std::move(curve), distance);
      }
    }
    return std::nullopt;
  }

 private:
  /// A spline that holds the target, relative to the first node, and the samples' parameters on it.
  struct Found {
    PlanarCurve curve;
    std::vector<FitSample> samples;

    std::size_t controls() const { return curve.control_points.size(); }
    std::size_t spans() const { return controls() - static_cast<std::size_t>(curve.degree); }
  };

  /// What is known about one degree.
  struct Trial {
    int degree = 3;
    PlanarCurve curve;              ///< of the latest attempt
    std::vector<double> distances;  ///< of its spans; empty if it has no solution
    bool within = false;            ///< it holds the target
    double predicted = 0.0;         ///< spans that should hold it
    std::size_t failed = 0;         ///< the most spans that did not hold it
    std::optional<Found> best;

    std::size_t spans() const { return curve.knots.size() - 2 * static_cast<std::size_t>(degree) - 1; }
    std::size_t rounded() const { return static_cast<std::size_t>(std::ceil(predicted)); }
    double controls_expected() const { return predicted + degree; }
  };

  /// One attempt with a cubic and one with a quintic tell which of them is the likelier; its number of spans
  /// is narrowed down. The other degrees are tried with one control point less.
  std::optional<Found> search() {
    const auto allowed = [this](int degree) {
      return degree >= options_.least_degree && degree <= options_.greatest_degree;
    };
    // A single Bezier segment may meet what an evenly turning spline needs many spans for.
    for (int degree = options_.least_degree; degree <= options_.greatest_degree; ++degree) {
      if (degree > 3 && evenly_turning_spans_ > kMostForOneSpan) break;
      take_samples(static_cast<std::size_t>(degree) + 1);
      Trial trial;
      trial.degree = degree;
      attempt(trial, first_density(degree).knots(degree, 1));
      if (trial.best) return std::move(trial.best);
    }
    take_samples(expected_spans() + 3);
    std::vector<Trial> trials;
    for (const int degree : {hint_ ? hint_->degree : 3, 5, 4, 3, 2}) {
      if (!allowed(degree)) continue;
      if (trials.size() == (hint_ ? 1 : 2) ||
          (trials.size() == 1 && trials.front().best && trials.front().spans() == 1))
        break;
      Trial trial;
      trial.degree = degree;
      attempt(trial, first_density(degree).knots(degree, std::min(expected_spans(), most_spans(degree))));
      trials.push_back(std::move(trial));
    }
    std::stable_sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
      return a.controls_expected() < b.controls_expected();
    });
    narrow(trials.front(), most_spans(trials.front().degree));
    std::optional<Found> best = std::move(trials.front().best);
    const int main_degree = trials.front().degree;
    const bool settled = best && hint_ && hint_->parts % kPartsPerDegreeSearch != 0;
    for (const int degree : {3, 5, 4, 2}) {
      if (settled || !allowed(degree) || degree == main_degree) continue;
      const auto p = static_cast<std::size_t>(degree);
      std::size_t limit = most_spans(degree);
      if (best) {
        // As many control points from a lower degree are better than from a higher one.
        const std::size_t most_controls = best->controls() - (degree < best->curve.degree ? 0 : 1);
        if (most_controls <= p || (degree == 2 && most_controls > kMostForParabolas)) continue;
        limit = std::min(limit, most_controls - p);
      }
      const auto known =
          std::find_if(trials.begin(), trials.end(), [&](const Trial& t) { return t.degree == degree; });
      Trial trial;
      if (known != trials.end()) {
        trial = std::move(*known);
        if (!trial.best || trial.spans() > limit) attempt(trial, knots_by_distance(trial, limit));
      } else {
        trial.degree = degree;
        attempt(trial, first_density(degree).knots(degree, best ? limit : std::min(expected_spans(), limit)));
      }
      narrow(trial, limit);
      if (trial.best) best = std::move(trial.best);  // within the limit, so it is better
    }
    return best;
  }

  /// A spline needs fewer control points than the cubics of the segments.
  std::size_t most_spans(int degree) const {
    const std::size_t cubics = 2 * lengths_.size() + 2;
    const auto p = static_cast<std::size_t>(degree);
    return cubics > p ? cubics - p : 1;
  }

  std::size_t expected_spans() const {
    return std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(evenly_turning_spans_ * (hint_ ? hint_->ratio : 1.0))));
  }

  KnotDensity first_density(int degree) const {
    const double share = static_cast<double>(degree) / (static_cast<double>(degree) + 1.0);
    double turning = 0.0;
    for (std::size_t i = 0; i < lengths_.size(); ++i)
      turning += std::abs(cross(chain_.tangents[i], chain_.tangents[i + 1]));
    const double mean = (turning + 0.1) / walked_.back();
    std::vector<double> masses;
    masses.reserve(lengths_.size());
    for (std::size_t i = 0; i < lengths_.size(); ++i) {
      const double turn = std::abs(cross(chain_.tangents[i], chain_.tangents[i + 1]));
      const double curvature = turn / lengths_[i];
      masses.push_back(lengths_[i] * (std::pow(curvature / mean, share) + 0.2));
    }
    return {walked_, masses};
  }

  /// Looks for the fewest spans, at most `limit`, that hold the target, from the trial's latest attempt on.
  void narrow(Trial& trial, std::size_t limit) {
    if (trial.best && trial.best->spans() > limit) trial.best.reset();
    bool repeated = false;
    for (int count = 0; count < kAttempts; ++count) {
      const std::size_t held = trial.best ? trial.best->spans() : limit + 1;
      if (trial.failed + 1 >= held ||
          (trial.best && held - trial.failed <= held / (hint_ ? kNarrowEnoughInParts : kNarrowEnough)))
        break;
      const std::size_t spans = trial.spans();
      const bool badly_spread = !trial.within && trial.rounded() <= spans;
      if (badly_spread && !repeated && spans < held && spans <= kFewSpans) {
        repeated = true;
        trial.failed = spans - 1;
        attempt(trial, knots_by_distance(trial, spans));
        continue;
      }
      repeated = false;
      if (!trial.best && trial.predicted > 2.0 * static_cast<double>(limit)) break;
      std::optional<Knots> knots;
      if (badly_spread && !trial.distances.empty()) {
        Knots refined = refined_knots(trial);
        if (refined.size() < held + 2 * static_cast<std::size_t>(trial.degree) + 1)
          knots = std::move(refined);
      }
      if (!knots) {
        // A failure calls for a twentieth more at least, and tells nothing about more than twice as many.
        const std::size_t least = trial.within ? trial.failed + 1 : trial.failed + 1 + trial.failed / 20;
        const std::size_t most = std::min(held - 1, 2 * spans + 4);
        knots = knots_by_distance(trial, std::min(std::max(trial.rounded(), least), most));
      }
      attempt(trial, *knots);
    }
  }

  /// Knots spread evenly over the order-th root of the latest distances, which is proportional to the spans'
  /// lengths.
  Knots knots_by_distance(const Trial& trial, std::size_t spans) const {
    if (trial.distances.empty()) return first_density(trial.degree).knots(trial.degree, spans);
    const Knots& knots = trial.curve.knots;
    std::vector<double> masses;
    masses.reserve(trial.distances.size());
    for (const double distance : trial.distances) masses.push_back(relative_length(distance, trial.degree));
    return KnotDensity({knots.begin() + trial.degree, knots.end() - trial.degree}, masses)
        .knots(trial.degree, spans);
  }

  /// How much longer a span is than one that would just hold the target.
  double relative_length(double distance, int degree) const {
    return std::pow(std::max(distance / target_, 1e-3), 1.0 / (static_cast<double>(degree) + 1.0));
  }

  /// The knots of the latest attempt, and one more in the middle of every span that failed.
  Knots refined_knots(const Trial& trial) const {
    Knots knots = trial.curve.knots;
    const auto p = static_cast<std::size_t>(trial.degree);
    for (std::size_t i = 0; i < trial.distances.size(); ++i) {
      if (trial.distances[i] > target_)
        knots.push_back(0.5 * (trial.curve.knots[p + i] + trial.curve.knots[p + i + 1]));
    }
    std::sort(knots.begin(), knots.end());
    return knots;
  }

  /// Samples for that many control points: some of the nodes, or all of them and points of the cubics in
  /// between.
  void take_samples(std::size_t controls) {
    const std::size_t segments = lengths_.size();
    const std::size_t wanted = std::max<std::size_t>(kSamplesPerControl * controls, 24);
    const std::size_t stride = std::max<std::size_t>(1, segments / wanted);
    const std::size_t parts = (wanted + segments - 1) / segments;
    samples_.clear();
    latest_greatest_ = std::numeric_limits<double>::infinity();
    const Vector2 origin = chain_.positions.front();
    const auto add = [&](const Vector2& position, const Vector2& tangent, double walked) {
      samples_.push_back({position - origin, tangent, walked, walked});
    };
    for (std::size_t i = 0; i < segments; i += stride) {
      add(chain_.positions[i], chain_.tangents[i], walked_[i]);
      if (parts < 2) continue;
      const Cubic cubic = hermite_cubic(chain_, i);
      for (std::size_t k = 1; k < parts; ++k) {
        const double u = static_cast<double>(k) / static_cast<double>(parts);
        add(point_on(cubic, u), derivative_on(cubic, u).normalized(), walked_[i] + u * lengths_[i]);
      }
    }
    add(chain_.positions.back(), chain_.tangents.back(), walked_.back());
  }

  /// Fits with the given knots and notes in the trial what came of it.
  void attempt(Trial& trial, Knots knots) {
    trial.curve.degree = trial.degree;
    trial.curve.knots = std::move(knots);
    trial.distances.clear();
    trial.within = false;
    const std::size_t spans = trial.spans();
    const std::size_t controls = spans + static_cast<std::size_t>(trial.degree);
    if (kSamplesPerControl * controls > 2 * samples_.size()) take_samples(controls);
    // Parameters corrected for a curve that was nearly right are a better start than arc length.
    const bool keep = latest_greatest_ < kNearlyRight * target_;
    if (!keep) {
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
    for (const double distance : trial.distances) trial.predicted += relative_length(distance, trial.degree);
    if (trial.within) {
      trial.best = Found{trial.curve, samples_};
    } else {
      trial.failed = std::max(trial.failed, spans);
    }
  }

  /// Whether the curve leaves its start, or meets its end, against the tangent there: all samples may be met
  /// nevertheless.
  bool hooks_at_ends(const PlanarCurve& curve) const {
    const std::size_t last = curve.control_points.size() - 1;
    return (curve.control_points[1] - curve.control_points[0]).dot(chain_.tangents.front()) <= 0.0 ||
           (curve.control_points[last] - curve.control_points[last - 1]).dot(chain_.tangents.back()) <= 0.0;
  }

  /// Of the cubics from the curve, mm; infinite if the curve folds.
  double greatest_distance(const Found& found) const {
    return with_degree(found.curve.degree,
                       [&](auto degree) { return greatest_distance_of_degree<degree>(found); });
  }

  template <int kDegree>
  double greatest_distance_of_degree(const Found& found) const {
    constexpr auto kCount = static_cast<std::size_t>(kDegree);
    const PlanarCurve& curve = found.curve;
    const std::vector<FitSample>& samples = found.samples;
    const std::size_t segments = lengths_.size();
    const std::size_t parts = (kPlacesPerSpan * found.spans() + segments - 1) / segments;
    std::size_t sample = 0;
    std::size_t span = kCount;
    SpanBasis<kDegree> basis(curve.knots, span);
    double greatest = 0.0;
    double foot = curve.knots.front();  // of the point before
    double foot_walked = 0.0;
    bool folded = false;
    const auto measure = [&](const Vector2& point, const Vector2& tangent, double walked) {
      // The parameters of the samples on either side give a first guess.
      while (sample + 2 < samples.size() && samples[sample + 1].walked <= walked) ++sample;
      const FitSample& left = samples[sample];
      const FitSample& right = samples[sample + 1];
      double t = left.parameter +
                 (walked - left.walked) / (right.walked - left.walked) * (right.parameter - left.parameter);
      double distance = 0.0;
      double heading = 1.0;
      double way = 0.0;  // along the curve from the foot point before
      for (int newton = 0; newton < 4; ++newton) {
        const std::size_t before = span;
        while (span > kCount && t < curve.knots[span]) --span;
        while (span + 1 < curve.control_points.size() && t >= curve.knots[span + 1]) ++span;
        if (span != before) basis = SpanBasis<kDegree>(curve.knots, span);
        const BasisWindow window = basis.at(t);
        Vector2 gap = -point;
        Vector2 derivative = Vector2::Zero();
        for (std::size_t r = 0; r <= kCount; ++r) {
          gap += window.value[r] * curve.control_points[window.first + r];
          derivative += window.slope[r] * curve.control_points[window.first + r];
        }
        const double speed = derivative.norm();
        const double slip = gap.dot(derivative) / speed;
        distance = std::abs(cross(derivative, gap)) / speed;
        heading = derivative.dot(tangent) / speed;
        way = (t - slip / speed - foot) * speed;
        // A slip moves the foot by second order; what it leaves is far below the tolerance once it is this
        // small.
        if (!(std::abs(slip) > 0.05 * right.walked - 0.05 * left.walked)) break;
        distance = gap.norm();
        t = std::clamp(t - slip / speed, curve.knots.front(), curve.knots.back());
      }
      greatest = std::max(greatest, distance);
      // Near every point is not enough: the curve must run along them, or it could stray in between.
      const double walk = walked - foot_walked;
      folded = folded || !(heading >= 0.5 && way >= 0.3 * walk && way <= 3.0 * walk);
      foot = t;
      foot_walked = walked;
    };
    for (std::size_t i = 0; i < segments; ++i) {
      measure(chain_.positions[i] - chain_.positions.front(), chain_.tangents[i], walked_[i]);
      if (parts < 2) continue;
      const Cubic cubic = hermite_cubic(chain_, i);
      for (std::size_t k = 1; k < parts; ++k) {
        const double u = static_cast<double>(k) / static_cast<double>(parts);
        measure(point_on(cubic, u) - chain_.positions.front(), derivative_on(cubic, u).normalized(),
                walked_[i] + u * lengths_[i]);
      }
    }
    measure(chain_.positions.back() - chain_.positions.front(), chain_.tangents.back(), walked_.back());
    return folded ? std::numeric_limits<double>::infinity() : greatest;
  }

  const SmoothChain& chain_;
  const SplineFitOptions& options_;
  std::optional<SearchHint> hint_;
  double evenly_turning_spans_ = 0.0;
  std::vector<double> lengths_;  // of the segments
  std::vector<double> walked_;   // up to each node
  double target_ = 0.0;          // distance to hold at the samples, mm
  std::vector<FitSample> samples_;
  double latest_greatest_ = std::numeric_limits<double>::infinity();  // distance in the latest attempt
  SplineSystem system_;
};

/// Cuts a long chain at nodes into parts of nearly equal expected numbers of spans.
std::vector<SmoothChain> manageable_parts(const SmoothChain& chain, const SplineFitOptions& options) {
  const std::vector<double> lengths = segment_lengths(chain);
  std::vector<double> sums{0.0};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    sums.push_back(sums.back() + cubic_spans(chain, i, lengths[i], options.tolerance));
  }
  const double parts = std::max(1.0, std::ceil(sums.back() / kManageableSpans));
  std::vector<SmoothChain> result;
  std::size_t first = 0;
  for (double k = 1.0; k <= parts && first < lengths.size(); ++k) {
    const auto cut = std::lower_bound(sums.begin(), sums.end(), sums.back() * k / parts);
    const std::size_t last = k < parts ? static_cast<std::size_t>(cut - sums.begin()) : lengths.size();
    if (last > first) result.push_back(sub_chain(chain, first, last));
    first = std::max(first, last);
  }
  return result;
}

PlanarCurve cubic_curve(const SmoothChain& chain) {
  const Cubic cubic = hermite_cubic(chain, 0);
  const double size = segment_lengths(chain).front();
  return {3, {0.0, 0.0, 0.0, 0.0, size, size, size, size}, {cubic.begin(), cubic.end()}};
}

}  // namespace

SplineFit fit_splines(const SmoothChain& chain, const SplineFitOptions& options) {
  assert(options.tolerance > 0.0 && options.least_degree >= 2 &&
         options.greatest_degree <= kHighestWindowDegree);
  SplineFit fit;
  // Those still to be fitted, the foremost last.
  std::vector<SmoothChain> parts = manageable_parts(chain, options);
  std::reverse(parts.begin(), parts.end());
  std::optional<SearchHint> hint;
  while (!parts.empty()) {
    const SmoothChain part = std::move(parts.back());
    parts.pop_back();
    const std::size_t segments = part.positions.size() - 1;
    SplineSearch search(part, options, hint);
    if (auto best = search.best()) {
      hint = search.hint();
      fit.greatest_distance = std::max(fit.greatest_distance, best->second);
      fit.curves.push_back(std::move(best->first));
    } else if (segments == 1) {
      fit.curves.push_back(cubic_curve(part));
    } else {
      parts.push_back(sub_chain(part, segments / 2, segments));
      parts.push_back(sub_chain(part, 0, segments / 2));
    }
  }
  return fit;
}

}  // namespace lamina::engine
