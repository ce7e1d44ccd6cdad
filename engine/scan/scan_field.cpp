#include "engine/scan/scan_field.h"

#include <algorithm>
#include <cmath>

namespace lamina::engine {
namespace {

/// Spacings within which points count.
constexpr double kSupport = 4.0;
/// Where the nearest point is far, points up to this many times as far count.
constexpr double kBeyondNearest = 2.0;

/// Weighted sums of points and normals, seen from the place that is asked about.
struct Moments {
  double weight = 0.0;
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::Zero();
  double along = 0.0;    ///< point times normal
  double squared = 0.0;  ///< point times point

  void add(double w, const Vector3& p, const Vector3& n) {
    weight += w;
    point += w * p;
    normal += w * n;
    along += w * p.dot(n);
    squared += w * p.squaredNorm();
  }
};

}  // namespace

ScanField::ScanField(const PointCloud& cloud) : cloud_(cloud), tree_(cloud_.points) {}

std::optional<ScanField::Value> ScanField::at(const Vector3& place, double farthest,
                                              std::uint32_t left_out) const {
  const Eigen::Vector3f near_place = place.cast<float>();
  auto nearest = tree_.nearest(near_place, left_out == kNone ? 1 : 2, static_cast<float>(farthest));
  std::erase_if(nearest, [&](const PointTree::Neighbour& n) { return n.point == left_out; });
  if (nearest.empty()) return std::nullopt;
  const double away = std::sqrt(static_cast<double>(nearest.front().squared));
  const auto spacing = static_cast<double>(cloud_.spacings[nearest.front().point]);
  const Vector3 facing = cloud_.normals[nearest.front().point].cast<double>();
  const double radius = std::max(kSupport * spacing, kBeyondNearest * away);

  // Beside the points, beyond an edge or in a hole, the nearest one does not know what faces what.
  const Vector3 way = place - cloud_.points[nearest.front().point].cast<double>();
  const double slant = away > 0.0 ? std::abs(way.dot(facing)) / away : 1.0;
  const double beside = std::clamp(away / spacing - 1.0, 0.0, 1.0) * (1.0 - slant * slant);

  Moments sums;
  tree_.for_each_within(near_place, static_cast<float>(radius), [&](std::uint32_t i, float squared) {
    if (i == left_out) return;
    const Vector3 normal = cloud_.normals[i].cast<double>();
    const double inside = 1.0 - static_cast<double>(squared) / (radius * radius);
    const double agreement = std::max(0.0, normal.dot(facing));
    const double facing_too = beside + (1.0 - beside) * agreement * agreement;
    if (inside <= 0.0 || facing_too <= 0.0) return;
    const double falling = inside * inside;
    sums.add(falling * falling * facing_too, cloud_.points[i].cast<double>() - place, normal);
  });
  if (!(sums.weight > 0.0)) return std::nullopt;

  // The sphere constant + linear x + quadratic x^2 = 0 (equations 5 of the paper).
  const double w = sums.weight;
  const double spread = sums.squared - sums.point.squaredNorm() / w;
  const double quadratic = spread > 1e-12 * radius * radius * w
                               ? 0.5 * (sums.along - sums.point.dot(sums.normal) / w) / spread
                               : 0.0;
  const Vector3 linear = (sums.normal - 2.0 * quadratic * sums.point) / w;
  const double constant = -(linear.dot(sums.point) + quadratic * sums.squared) / w;
  const double slope = linear.norm();
  if (!(slope > 0.0)) return std::nullopt;
  const double root = std::sqrt(std::max(0.0, slope * slope - 4.0 * quadratic * constant));
  return Value{2.0 * constant / (slope + root), linear / slope, away};
}

}  // namespace lamina::engine
