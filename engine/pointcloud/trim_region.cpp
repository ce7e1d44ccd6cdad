#include "engine/pointcloud/trim_region.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/bspline_basis.h"

namespace lamina::engine {
namespace {

constexpr double kRelativeTolerance = 1e-4;
constexpr int kDeepestHalving = 12;

Vector2 at(const NurbsCurve& curve, double t) {
  return evaluate(curve, t).head<2>();
}

double distance_to_line(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a;
  const double length = along.norm();
  if (length == 0.0) return (p - a).norm();
  return std::abs(along.x() * (p - a).y() - along.y() * (p - a).x()) / length;
}

double cross(const Vector2& a, const Vector2& b) {
  return a.x() * b.y() - a.y() * b.x();
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
        chords_.push_back({edge[k - 1].parameters, edge[k].parameters, e, edge[k - 1].t, edge[k].t});
      }
      const Vector2& next = samples_[e + 1 == last ? first : e + 1].front().parameters;
      if (edge.back().parameters != next)
        chords_.push_back({edge.back().parameters, next, kNoEdge, 0.0, 0.0});
    }
  }
  z_min_ = std::numeric_limits<double>::infinity();
  z_max_ = -z_min_;
  for (const auto& edge : samples_) {
    for (const EdgeSample& sample : edge) {
      z_min_ = std::min(z_min_, sample.position.z());
      z_max_ = std::max(z_max_, sample.position.z());
    }
  }
  const Box3 box = control_box(surface_.net);
  level_ = box.max().z() - box.min().z() <= kModelTolerance;
  fill_buckets();
}

void TrimRegion::sample_edge(const NurbsCurve& curve, double tolerance) {
  std::vector<EdgeSample>& samples = samples_.emplace_back();
  const auto lifted = [&](double t) {
    const Vector2 p = at(curve, t);
    return EdgeSample{t, p, evaluate(surface_, p.x(), p.y())};
  };
  const std::vector<double> breaks = break_points(curve.knots, curve.degree);
  samples.push_back(lifted(breaks.front()));
  // Halves a span until its chords are near, looking at two points so that an inflection is not overlooked.
  const auto halve = [&](auto&& self, const EdgeSample& from, const EdgeSample& to, int depth) -> void {
    const double step = to.t - from.t;
    const bool near =
        distance_to_line(at(curve, from.t + 0.5 * step), from.parameters, to.parameters) <= tolerance &&
        distance_to_line(at(curve, from.t + 0.27 * step), from.parameters, to.parameters) <= tolerance;
    if (depth >= kDeepestHalving || (near && depth >= (curve.degree > 1 ? 2 : 0))) {
      samples.push_back(to);
      return;
    }
    const EdgeSample middle = lifted(0.5 * (from.t + to.t));
    self(self, from, middle, depth + 1);
    self(self, middle, to, depth + 1);
  };
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    const EdgeSample from = samples.back();
    halve(halve, from, lifted(breaks[k]), 0);
  }
}

void TrimRegion::fill_buckets() {
  double high = -std::numeric_limits<double>::infinity();
  v_low_ = -high;
  for (const Chord& chord : chords_) {
    v_low_ = std::min({v_low_, chord.a.y(), chord.b.y()});
    high = std::max({high, chord.a.y(), chord.b.y()});
  }
  buckets_.resize(1 + chords_.size() / 4);
  bucket_height_ =
      std::max((high - v_low_) / static_cast<double>(buckets_.size()), std::numeric_limits<double>::min());
  for (std::uint32_t c = 0; c < chords_.size(); ++c) {
    const auto [low, top] = std::minmax(chords_[c].a.y(), chords_[c].b.y());
    for (std::size_t k = bucket_of(low); k <= bucket_of(top); ++k) buckets_[k].push_back(c);
  }
}

std::size_t TrimRegion::bucket_of(double v) const {
  const double k = std::floor((v - v_low_) / bucket_height_);
  return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(buckets_.size() - 1)));
}

template <typename Visit>
void TrimRegion::for_each_chord(double v_low, double v_high, Visit visit) const {
  const std::size_t first = bucket_of(v_low);
  const std::size_t last = bucket_of(v_high);
  for (std::size_t k = first; k <= last; ++k) {
    for (const std::uint32_t c : buckets_[k]) {
      const Chord& chord = chords_[c];
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
  bool cut = false;
  for_each_chord(low.y(), high.y(), [&](const Chord& chord) {
    cut = cut ||
          (std::max(chord.a.x(), chord.b.x()) >= low.x() && std::min(chord.a.x(), chord.b.x()) <= high.x() &&
           std::max(chord.a.y(), chord.b.y()) >= low.y() && std::min(chord.a.y(), chord.b.y()) <= high.y());
  });
  if (cut) return TrimPlace::kCut;
  return contains(0.5 * (low + high)) ? TrimPlace::kInside : TrimPlace::kOutside;
}

std::vector<TrimCrossing> TrimRegion::crossings(const Vector2& from, const Vector2& to) const {
  std::vector<TrimCrossing> result;
  const Vector2 line = to - from;
  for_each_chord(std::min(from.y(), to.y()), std::max(from.y(), to.y()), [&](const Chord& chord) {
    const Vector2 side = chord.b - chord.a;
    const double side_a = cross(line, chord.a - from);
    const double side_b = cross(line, chord.b - from);
    if ((side_a > 0.0) == (side_b > 0.0)) return;
    const double determinant = cross(line, side);
    if (determinant == 0.0) return;
    const double along = cross(chord.a - from, side) / determinant;
    if (!(along >= 0.0 && along <= 1.0)) return;
    result.push_back({along, chord.edge, chord.low, chord.high});
  });
  std::sort(result.begin(), result.end(),
            [](const TrimCrossing& a, const TrimCrossing& b) { return a.along < b.along; });
  return result;
}

}  // namespace lamina::engine
