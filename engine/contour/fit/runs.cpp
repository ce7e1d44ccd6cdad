#include "engine/contour/fit/runs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

using std::numbers::pi;

/// A tangent off by the angle d moves the cubic of a segment of length h by at most (4/27) d h.
constexpr double kTangentShare = 27.0 / 4.0;
constexpr double kRelaxation = 64.0;
constexpr double kGreatestExcess = 0.3;
constexpr std::size_t kLeastLineSegments = 1;
constexpr std::size_t kLeastArcSegments = 2;

struct Line {
  Vector2 origin;
  Vector2 direction;

  double deviation(const Vector2& point) const { return std::abs(cross(direction, point - origin)); }
  /// Sine of the angle between tangent and line; large where it points backwards.
  double slant(const Vector2&, const Vector2& tangent) const {
    return direction.dot(tangent) > 0.0 ? std::abs(cross(direction, tangent)) : 2.0;
  }
};

struct Circle {
  Vector2 centre;
  double radius;
  double turning;

  double deviation(const Vector2& point) const {
    return std::abs((point - centre).squaredNorm() - radius * radius) / (2.0 * radius);
  }
  double slant(const Vector2& point, const Vector2& tangent) const {
    const Vector2 spoke = point - centre;
    return turning * cross(spoke, tangent) > 0.0 ? std::abs(spoke.dot(tangent)) / radius : 2.0;
  }
};

/// Whether the ends of an arc lie closer together than its end and its middle: it turns by more than 240
/// degrees.
bool nearly_round(const SmoothChain& chain, std::size_t first, std::size_t last) {
  const Vector2& start = chain.positions[first];
  const Vector2& middle = chain.positions[first + (last - first) / 2];
  return (chain.positions[last] - start).squaredNorm() < (middle - start).squaredNorm();
}

std::optional<Circle> circle_through(const SmoothChain& chain, std::size_t first, std::size_t last) {
  const std::size_t count = last - first;
  const bool round = nearly_round(chain, first, last);
  if (round && count < 3) return std::nullopt;
  const Vector2& start = chain.positions[first];
  const Vector2 to_middle = chain.positions[first + (round ? count / 3 : count / 2)] - start;
  const Vector2 to_end = chain.positions[round ? first + 2 * count / 3 : last] - start;
  const double area = 2.0 * cross(to_middle, to_end);
  if (area == 0.0) return std::nullopt;
  const Vector2 spoke = (to_middle.squaredNorm() * Vector2(to_end.y(), -to_end.x()) -
                         to_end.squaredNorm() * Vector2(to_middle.y(), -to_middle.x())) /
                        area;
  return Circle{start + spoke, spoke.norm(), area > 0.0 ? 1.0 : -1.0};
}

std::optional<Line> line_through(const SmoothChain& chain, std::size_t first, std::size_t last) {
  const Vector2 chord = chain.positions[last] - chain.positions[first];
  const double size = chord.norm();
  if (size == 0.0) return std::nullopt;
  return Line{chain.positions[first], chord / size};
}

class RunFinder {
 public:
  RunFinder(const SmoothChain& chain, double tolerance)
      : chain_(chain), tolerance_(tolerance), last_(chain.positions.size() - 1) {
    walked_.reserve(chain.positions.size());
    walked_.push_back(0.0);
    for (std::size_t i = 1; i <= last_; ++i) {
      walked_.push_back(walked_.back() + (chain.positions[i] - chain.positions[i - 1]).norm());
    }
  }

  std::vector<Run> find() const {
    std::vector<Run> runs;
    std::size_t covered = 0;  // the nodes up to here belong to runs
    std::size_t from = 0;
    while (from < last_) {
      std::optional<Run> run = longest_from(from, covered);
      if (!run) {
        ++from;
      } else if (!genuine(*run, covered)) {
        from = std::max(from + 1, run->last - 1);  // a true run that begins inside is extended back
      } else {
        if (run->first > covered)
          runs.push_back({RunShape::kFree, covered, run->first, Vector2::Zero(), 0.0, 0.0});
        covered = from = run->last;
        runs.push_back(*run);
      }
    }
    if (covered < last_) runs.push_back({RunShape::kFree, covered, last_, Vector2::Zero(), 0.0, 0.0});
    return runs;
  }

 private:
  double spacing(std::size_t segment) const { return walked_[segment + 1] - walked_[segment]; }

  /// Whether `node` fits, with the tangent weighed by the segments beside it that belong to [first, last].
  template <typename Shape>
  bool node_fits(const Shape& shape, std::size_t node, std::size_t first, std::size_t last) const {
    const double before = node > first ? spacing(node - 1) : 0.0;
    const double after = node < last ? spacing(node) : 0.0;
    const Vector2& position = chain_.positions[node];
    return shape.deviation(position) <= tolerance_ &&
           shape.slant(position, chain_.tangents[node]) * std::max(before, after) <=
               kTangentShare * tolerance_;
  }

  template <typename Shape>
  bool all_fit(const std::optional<Shape>& shape, std::size_t first, std::size_t last) const {
    if (!shape) return false;
    for (std::size_t node = first; node <= last; ++node) {
      if (!node_fits(*shape, node, first, last)) return false;
    }
    return true;
  }

  /// The last node up to which `holds(last)` from `first` on: doubling, then halving. `first` if not even
  /// `least` segments.
  template <typename Holds>
  std::size_t gallop(std::size_t first, std::size_t least, Holds holds) const {
    if (first + least > last_ || !holds(first + least)) return first;
    std::size_t good = first + least;
    std::size_t bad = last_ + 1;
    while (good < last_) {
      const std::size_t next = std::min(last_, first + 2 * (good - first));
      if (!holds(next)) {
        bad = next;
        break;
      }
      good = next;
    }
    while (good + 1 < bad) {
      const std::size_t middle = good + (bad - good) / 2;
      (holds(middle) ? good : bad) = middle;
    }
    return good;
  }

  std::optional<Run> longest_from(std::size_t first, std::size_t covered) const {
    const std::size_t line_end = gallop(first, kLeastLineSegments, [&](std::size_t last) {
      return all_fit(line_through(chain_, first, last), first, last);
    });
    const std::size_t arc_end = gallop(first, kLeastArcSegments, [&](std::size_t last) {
      return all_fit(circle_through(chain_, first, last), first, last);
    });
    Run run;
    run.first = first;
    if (line_end > first && line_end >= arc_end) {
      run.shape = RunShape::kLine;
      run.last = line_end;
      extend_back(run, *line_through(chain_, first, line_end), covered);
      return run;
    }
    if (arc_end == first) return std::nullopt;
    const Circle circle = *circle_through(chain_, first, arc_end);
    run = {RunShape::kArc, first, arc_end, circle.centre, circle.radius, circle.turning};
    if (!nearly_round(chain_, first, arc_end)) extend_back(run, circle, covered);
    return run;
  }

  template <typename Shape>
  void extend_back(Run& run, const Shape& shape, std::size_t covered) const {
    while (run.first > covered && node_fits(shape, run.first - 1, run.first - 1, run.last)) --run.first;
  }

  bool genuine(const Run& run, std::size_t covered) const {
    if (run.shape == RunShape::kLine)
      return genuine(*line_through(chain_, run.first, run.last), run, covered);
    return genuine(Circle{run.centre, run.radius, run.turning}, run, covered);
  }

  /// Whether the run is hardly longer under a relaxed tolerance.
  template <typename Shape>
  bool genuine(const Shape& shape, const Run& run, std::size_t covered) const {
    const double relaxed = kRelaxation * tolerance_;
    const double allowed = kGreatestExcess * (walked_[run.last] - walked_[run.first]);
    double excess = 0.0;
    std::size_t end = run.last;
    while (end < last_ && excess <= allowed && shape.deviation(chain_.positions[end + 1]) <= relaxed) {
      excess = walked_[++end] - walked_[run.last];
    }
    if (excess > allowed) return false;
    if (end < last_) excess += spacing(end) * share_within(shape, end, true, relaxed);
    std::size_t begin = run.first;
    const double after = excess;
    while (begin > covered && excess <= allowed && shape.deviation(chain_.positions[begin - 1]) <= relaxed) {
      excess = after + walked_[run.first] - walked_[--begin];
    }
    if (excess > allowed) return false;
    if (begin > covered) excess += spacing(begin - 1) * share_within(shape, begin - 1, false, relaxed);
    return excess <= allowed;
  }

  /// How much of a segment's cubic, from its start or its end, stays within `relaxed` of the shape.
  template <typename Shape>
  double share_within(const Shape& shape, std::size_t segment, bool from_start, double relaxed) const {
    const Cubic cubic = hermite_cubic(chain_, segment);
    double good = 0.0;
    double bad = 1.0;
    for (int halving = 0; halving < 7; ++halving) {
      const double middle = 0.5 * (good + bad);
      const bool within = shape.deviation(point_on(cubic, from_start ? middle : 1.0 - middle)) <= relaxed;
      (within ? good : bad) = middle;
    }
    return good;
  }

  const SmoothChain& chain_;
  double tolerance_;
  std::size_t last_;
  std::vector<double> walked_;  // chord lengths summed up to each node
};

/// A closed chain that begins at another of its nodes.
SmoothChain turned(const SmoothChain& chain, std::size_t start) {
  SmoothChain result = chain;
  const auto turn = [start](std::vector<Vector2>& values) {
    values.pop_back();
    std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(start), values.end());
    values.push_back(values.front());
  };
  turn(result.positions);
  turn(result.tangents);
  return result;
}

CircularArc arc_between(const SmoothChain& chain, const Run& run, std::size_t first, std::size_t last) {
  CircularArc arc{chain.positions[first], chain.positions[last], run.centre, 0.0};
  const Vector2 from = arc.start - arc.centre;
  const Vector2 to = arc.end - arc.centre;
  arc.sweep = std::atan2(cross(from, to), from.dot(to));
  if (arc.sweep * run.turning <= 0.0) arc.sweep += run.turning * 2.0 * pi;
  return arc;
}

}  // namespace

RunCover recognise_runs(SmoothChain chain, double tolerance) {
  RunCover cover{std::move(chain), {}};
  cover.runs = RunFinder(cover.chain, tolerance).find();
  if (!cover.chain.closed || cover.runs.size() == 1) return cover;
  // A line or arc that contains the arbitrary first node was found in two parts: begin where one begins or
  // ends.
  const Run& found = cover.runs.front().shape == RunShape::kFree ? cover.runs[1] : cover.runs.front();
  cover.chain = turned(cover.chain, found.first > 0 ? found.first : found.last);
  cover.runs = RunFinder(cover.chain, tolerance).find();
  return cover;
}

std::vector<CurvePiece> exact_pieces(const SmoothChain& chain, const Run& run) {
  if (run.shape == RunShape::kLine)
    return {LineSegment{chain.positions[run.first], chain.positions[run.last]}};
  if (!nearly_round(chain, run.first, run.last)) return {arc_between(chain, run, run.first, run.last)};
  const std::size_t middle = run.first + (run.last - run.first) / 2;
  return {arc_between(chain, run, run.first, middle), arc_between(chain, run, middle, run.last)};
}

}  // namespace lamina::engine
