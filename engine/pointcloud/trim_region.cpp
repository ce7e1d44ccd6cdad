#include "engine/pointcloud/trim_region.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "engine/geometry/bspline_basis.h"
#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

constexpr double kRelativeTolerance = 1e-4;
constexpr int kDeepestHalving = 12;
constexpr std::size_t kFewBreaks = 4;

Vector2 at(const NurbsCurve& curve, double t) {
  return evaluate(curve, t).head<2>();
}

double distance_to_line(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a;
  const double length = along.norm();
  if (length == 0.0) return (p - a).norm();
  return std::abs(along.x() * (p - a).y() - along.y() * (p - a).x()) / length;
}

}  // namespace

TrimRegion::TrimRegion(const Surface& surface, std::uint32_t number)
    : surface_(surface.nurbs), number_(number) {
  const Vector2 size(surface_.last_u() - surface_.first_u(), surface_.last_v() - surface_.first_v());
  const double tolerance = kRelativeTolerance * size.minCoeff();
  for (const TrimLoop& loop : surface.trim) {
    if (loop.curves.empty()) continue;
    const auto first = static_cast<std::uint32_t>(edges_.size());
    for (const NurbsCurve& curve : loop.curves) {
      edges_.push_back(curve);
      sample_edge(curve, tolerance);
    }
    const auto last = static_cast<std::uint32_t>(edges_.size());
    loops_.emplace_back(first, last);
    for (std::uint32_t e = first; e < last; ++e) {
      const std::vector<EdgeSample>& edge = samples_[e];
      for (std::size_t k = 1; k < edge.size(); ++k) {
        chords_.push_back({edge[k - 1].parameters, edge[k].parameters, e, static_cast<std::uint32_t>(k - 1)});
      }
      const Vector2& next = samples_[e + 1 == last ? first : e + 1].front().parameters;
      if (edge.back().parameters != next) chords_.push_back({edge.back().parameters, next, kNoEdge, 0});
    }
  }
  z_min_ = std::numeric_limits<double>::infinity();
  z_max_ = -z_min_;
  for (const auto& edge : samples_) {
    const auto [low, high] = std::minmax_element(
        edge.begin(), edge.end(),
        [](const EdgeSample& a, const EdgeSample& b) { return a.position.z() < b.position.z(); });
    const auto& [bottom, top] = heights_.emplace_back(low->position.z(), high->position.z());
    if (top - bottom <= 2.0 * kModelTolerance)
      level_edges_.push_back(static_cast<std::uint32_t>(heights_.size() - 1));
    z_min_ = std::min(z_min_, bottom);
    z_max_ = std::max(z_max_, top);
  }
  const Box3 box = control_box(surface_.net);
  level_ = box.max().z() - box.min().z() <= kModelTolerance;
  fill_buckets();
}

void TrimRegion::sample_edge(const NurbsCurve& curve, double tolerance) {
  std::vector<EdgeSample>& samples = samples_.emplace_back();
  const auto lifted = [&](double t, const Vector2& p) {
    return EdgeSample{t, p, evaluate(surface_, p.x(), p.y())};
  };
  const std::vector<double> breaks = break_points(curve.knots, curve.degree);
  // A curve of few spans may turn more often than two points tell.
  const int least_depth = curve.degree > 1 && breaks.size() <= kFewBreaks ? 2 : 0;
  samples.push_back(lifted(breaks.front(), at(curve, breaks.front())));
  // Halves a span until its chords are near, looking at two points so that an inflection is not overlooked.
  const auto halve = [&](auto&& self, const EdgeSample& from, const EdgeSample& to, int depth) -> void {
    const double step = to.t - from.t;
    const auto is_near = [&](const Vector2& point) {
      return distance_to_line(point, from.parameters, to.parameters) <= tolerance;
    };
    const double t = from.t + 0.5 * step;
    const Vector2 middle = at(curve, t);
    if (depth >= kDeepestHalving ||
        (depth >= least_depth && is_near(middle) && is_near(at(curve, from.t + 0.27 * step)))) {
      samples.push_back(to);
      return;
    }
    const EdgeSample between = lifted(t, middle);
    self(self, from, between, depth + 1);
    self(self, between, to, depth + 1);
  };
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    const EdgeSample from = samples.back();
    halve(halve, from, lifted(breaks[k], at(curve, breaks[k])), 0);
  }
}

void TrimRegion::fill_buckets() {
  double high = -std::numeric_limits<double>::infinity();
  v_low_ = -high;
  for (const Chord& chord : chords_) {
    v_low_ = std::min({v_low_, chord.a.y(), chord.b.y()});
    high = std::max({high, chord.a.y(), chord.b.y()});
  }
  const std::size_t count = 1 + chords_.size() / 4;
  bucket_height_ = std::max((high - v_low_) / static_cast<double>(count), std::numeric_limits<double>::min());
  bucket_ends_.assign(count + 1, 0);
  const auto for_each_bucket = [&](const Chord& chord, auto visit) {
    const auto [low, top] = std::minmax(chord.a.y(), chord.b.y());
    for (std::size_t k = bucket_of(low); k <= bucket_of(top); ++k) visit(k);
  };
  for (const Chord& chord : chords_) for_each_bucket(chord, [&](std::size_t k) { ++bucket_ends_[k + 1]; });
  std::partial_sum(bucket_ends_.begin(), bucket_ends_.end(), bucket_ends_.begin());
  bucket_chords_.resize(bucket_ends_.back());
  std::vector<std::uint32_t> next(bucket_ends_.begin(), bucket_ends_.end() - 1);
  for (std::uint32_t c = 0; c < chords_.size(); ++c)
    for_each_bucket(chords_[c], [&](std::size_t k) { bucket_chords_[next[k]++] = c; });
}

std::size_t TrimRegion::bucket_of(double v) const {
  const double k = std::floor((v - v_low_) / bucket_height_);
  return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(bucket_ends_.size() - 2)));
}

template <typename Visit>
void TrimRegion::for_each_chord(double v_low, double v_high, Visit visit) const {
  const std::size_t first = bucket_of(v_low);
  const std::size_t last = bucket_of(v_high);
  for (std::size_t k = first; k <= last; ++k) {
    for (std::uint32_t at = bucket_ends_[k]; at < bucket_ends_[k + 1]; ++at) {
      const Chord& chord = chords_[bucket_chords_[at]];
      const double low = std::min(chord.a.y(), chord.b.y());
      // In the first bucket of the interval that holds it.
      if (k == std::max(first, bucket_of(low))) visit(chord);
    }
  }
}

double TrimRegion::turning(std::size_t loop) const {
  double twice_area = 0.0;
  Vector2 before = samples_[loops_[loop].second - 1].back().parameters;
  for (std::uint32_t e = loops_[loop].first; e < loops_[loop].second; ++e) {
    for (const EdgeSample& sample : samples_[e]) {
      twice_area += cross(before, sample.parameters);
      before = sample.parameters;
    }
  }
  return twice_area;
}

bool TrimRegion::is_level(std::uint32_t edge, double z) const {
  const auto [low, high] = heights_[edge];
  return std::abs(low - z) <= kModelTolerance && std::abs(high - z) <= kModelTolerance;
}

std::vector<std::uint32_t> TrimRegion::edges_in_plane(double z) const {
  std::vector<std::uint32_t> edges;
  std::copy_if(level_edges_.begin(), level_edges_.end(), std::back_inserter(edges),
               [&](std::uint32_t edge) { return is_level(edge, z); });
  return edges;
}

bool TrimRegion::contains(const Vector2& p) const {
  bool inside = false;
  for_each_chord(p.y(), p.y(), [&](const Chord& chord) {
    const Vector2& a = chord.a;
    const Vector2& b = chord.b;
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  });
  return inside;
}

TrimPlace TrimRegion::place_of(const Vector2& low, const Vector2& high) const {
  const Box2 box(low, high);
  bool cut = false;
  for_each_chord(low.y(), high.y(), [&](const Chord& chord) { cut = cut || chord.meets(box); });
  if (cut) return TrimPlace::kCut;
  return contains(0.5 * (low + high)) ? TrimPlace::kInside : TrimPlace::kOutside;
}

void TrimRegion::cross_chord(const Vector2& from, const Vector2& to, std::size_t side, const Chord& chord,
                             std::vector<TrimCrossing>& found) const {
  const Vector2 line = to - from;
  const Vector2 way = chord.b - chord.a;
  const double side_a = cross(line, chord.a - from);
  const double side_b = cross(line, chord.b - from);
  if ((side_a > 0.0) == (side_b > 0.0)) return;
  const double determinant = cross(line, way);
  if (determinant == 0.0) return;
  const double along = cross(chord.a - from, way) / determinant;
  if (along >= 0.0 && along <= 1.0) found.push_back({side, along, chord.edge, chord.sample});
}

/// Of the points [first, last] of the line. `near` holds, from `first_near` on, the chords that may meet it.
void TrimRegion::find_crossings(const std::vector<Vector2>& line, std::size_t first, std::size_t last,
                                std::size_t first_near, std::vector<std::uint32_t>& near,
                                std::vector<TrimCrossing>& found) const {
  Box2 box;
  for (std::size_t k = first; k <= last; ++k) box.extend(line[k]);
  const std::size_t end = near.size();
  for (std::size_t k = first_near; k < end; ++k) {
    if (chords_[near[k]].meets(box)) near.push_back(near[k]);
  }
  if (near.size() > end && last - first > 1) {
    const std::size_t middle = (first + last) / 2;
    find_crossings(line, first, middle, end, near, found);
    find_crossings(line, middle, last, end, near, found);
  } else {
    const std::size_t before = found.size();
    for (std::size_t k = end; k < near.size(); ++k)
      cross_chord(line[first], line[last], first, chords_[near[k]], found);
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(),
              [](const TrimCrossing& a, const TrimCrossing& b) { return a.along < b.along; });
  }
  near.resize(end);
}

std::vector<TrimCrossing> TrimRegion::crossings(const std::vector<Vector2>& line) const {
  Box2 box;
  for (const Vector2& point : line) box.extend(point);
  std::vector<std::uint32_t> near;
  for_each_chord(box.min().y(), box.max().y(), [&](const Chord& chord) {
    if (chord.meets(box)) near.push_back(static_cast<std::uint32_t>(&chord - chords_.data()));
  });
  std::vector<TrimCrossing> found;
  if (!near.empty()) find_crossings(line, 0, line.size() - 1, 0, near, found);
  return found;
}

}  // namespace lamina::engine
