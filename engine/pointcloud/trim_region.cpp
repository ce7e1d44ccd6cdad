#include "engine/pointcloud/trim_region.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

/// Deviation of the chords in parts of the domain, and about in mm.
constexpr double kMostOfDomain = 4e-4;
constexpr double kMostOnSurface = 0.005;

}  // namespace

TrimRegion::TrimRegion(const Surface& surface, std::uint32_t number)
    : surface_(surface.nurbs), number_(number) {
  const Vector2 size(surface_.last_u() - surface_.first_u(), surface_.last_v() - surface_.first_v());
  const Box3 box = control_box(surface_.net);
  level_ = box.max().z() - box.min().z() <= kModelTolerance;
  const double tolerance = std::min(kMostOfDomain, kMostOnSurface / box.diagonal().norm()) * size.minCoeff();
  std::vector<TrimChord> chords;
  for (const TrimLoop& loop : surface.trim) {
    if (loop.curves.empty()) continue;
    const auto first = static_cast<std::uint32_t>(edges_.size());
    for (const NurbsCurve& curve : loop.curves) {
      edges_.push_back(bezier_chain(curve));
      samples_.push_back(edge_samples(surface_, edges_.back(), tolerance));
    }
    const auto last = static_cast<std::uint32_t>(edges_.size());
    loops_.emplace_back(first, last);
    for (std::uint32_t e = first; e < last; ++e) {
      const std::vector<EdgeSample>& edge = samples_[e];
      for (std::size_t k = 1; k < edge.size(); ++k) {
        chords.push_back({edge[k - 1].parameters, edge[k].parameters, e, static_cast<std::uint32_t>(k - 1)});
      }
      const Vector2& next = samples_[e + 1 == last ? first : e + 1].front().parameters;
      if (edge.back().parameters != next) chords.push_back({edge.back().parameters, next});
    }
  }
  chords_ = TrimChords(std::move(chords));
  z_min_ = std::numeric_limits<double>::infinity();
  z_max_ = -z_min_;
  for (const auto& edge : samples_) {
    const auto [low, high] = std::minmax_element(
        edge.begin(), edge.end(),
        [](const EdgeSample& a, const EdgeSample& b) { return a.position.z() < b.position.z(); });
    const auto& [bottom, top] = heights_.emplace_back(low->position.z(), high->position.z());
    if (top - bottom <= 2.0 * kModelTolerance) {
      level_edges_.push_back(static_cast<std::uint32_t>(heights_.size() - 1));
    } else {
      for (std::size_t k = 1; k + 1 < edge.size(); ++k) {
        const double z = edge[k].position.z();
        if ((edge[k - 1].position.z() - z) * (edge[k + 1].position.z() - z) > 0.0)
          turning_points_.push_back(edge[k].position);
      }
    }
    z_min_ = std::min(z_min_, bottom);
    z_max_ = std::max(z_max_, top);
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

}  // namespace lamina::engine
