#include "engine/scan/prepare_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "engine/scan/point_tree.h"
#include "engine/scan/scan_field.h"
#include "engine/scan/scan_normals.h"

namespace lamina::engine {
namespace {

/// Neighbours that tell how dense the points are.
constexpr std::size_t kNeighbours = 8;
/// Median spacings of a point that stands alone.
constexpr double kAlone = 6.0;
/// Median spacings beyond which points are beside a hole.
constexpr double kWidest = 1.5;
/// A point this many deviations, and one median spacing, off its neighbours' surface is none of it.
constexpr double kFarOff = 6.0;
/// Given normals of which more contradict their neighbours are of no use.
constexpr double kMostContradictions = 0.2;
constexpr double kMost = 0.75;
constexpr int kMostRounds = 4;

double quantile(std::vector<double> values, double part) {
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Keeps the points that `keep` says, and what belongs to them.
void keep_points(PointCloud& cloud, const std::vector<bool>& keep) {
  const auto filter = [&](auto& values) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      if (keep[i]) values[kept++] = values[i];
    }
    values.resize(kept);
  };
  filter(cloud.points);
  filter(cloud.normals);
  filter(cloud.spacings);
}

std::size_t count_off(const std::vector<bool>& keep) {
  return static_cast<std::size_t>(std::count(keep.begin(), keep.end(), false));
}

/// Of points in one place the first stays.
std::vector<bool> first_of_each_place(const std::vector<Eigen::Vector3f>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) { return std::tuple(points[i].x(), points[i].y(), points[i].z()); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<bool> keep(points.size(), true);
  for (std::size_t k = 1; k < order.size(); ++k) keep[order[k]] = key(order[k]) != key(order[k - 1]);
  return keep;
}

/// Puts neighbours near each other in memory, where they will be looked for.
void put_in_order(PointCloud& cloud) {
  const std::vector<std::uint32_t> order = PointTree(cloud.points).order();
  const auto reorder = [&](std::vector<Eigen::Vector3f>& values) {
    if (values.empty()) return;
    std::vector<Eigen::Vector3f> ordered;
    ordered.reserve(values.size());
    for (const std::uint32_t i : order) ordered.push_back(values[i]);
    values = std::move(ordered);
  };
  reorder(cloud.points);
  reorder(cloud.normals);
}

/// The spacing around each point: its nearest neighbours share a disc as wide as they reach.
std::vector<float> spacings_of(const std::vector<Eigen::Vector3f>& points, const PointTree& tree) {
  std::vector<float> spacings;
  spacings.reserve(points.size());
  const auto share = static_cast<float>(std::sqrt(std::numbers::pi / static_cast<double>(kNeighbours)));
  for (const Eigen::Vector3f& point : points)
    spacings.push_back(share * std::sqrt(tree.nearest(point, kNeighbours + 1).back().squared));
  return spacings;
}

/// The same without chance: the mean of the neighbours'; and not the width of the scan's holes.
std::vector<float> smoothed(const std::vector<float>& spacings, const std::vector<Eigen::Vector3f>& points,
                            const PointTree& tree) {
  const auto widest = static_cast<float>(kWidest * quantile({spacings.begin(), spacings.end()}, 0.5));
  std::vector<float> result;
  result.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    float sum = 0.0F;
    const auto neighbours = tree.nearest(points[i], kNeighbours + 1);
    for (const auto& neighbour : neighbours) sum += std::min(spacings[neighbour.point], widest);
    result.push_back(sum / static_cast<float>(neighbours.size()));
  }
  return result;
}

std::vector<bool> not_alone(const std::vector<float>& spacings) {
  const double most = kAlone * quantile({spacings.begin(), spacings.end()}, 0.5);
  std::vector<bool> keep;
  keep.reserve(spacings.size());
  for (const float spacing : spacings) keep.push_back(spacing <= most);
  return keep;
}

bool are_usable(const std::vector<Eigen::Vector3f>& normals) {
  return !normals.empty() && std::all_of(normals.begin(), normals.end(), [](const Eigen::Vector3f& normal) {
    return normal.allFinite() && normal.squaredNorm() > 0.0F;
  });
}

/// Distance of each point from the surface of the others.
std::vector<double> distances_from_others(const PointCloud& cloud) {
  const ScanField field(cloud);
  std::vector<double> distances;
  distances.reserve(cloud.points.size());
  for (std::uint32_t i = 0; i < cloud.points.size(); ++i) {
    const auto value = field.at(cloud.points[i].cast<double>(), std::numeric_limits<double>::infinity(), i);
    distances.push_back(value ? std::abs(value->distance) : 0.0);
  }
  return distances;
}

/// Measures the noise; whether each point lies on the surface of the others.
std::vector<bool> near_others(PointCloud& cloud) {
  constexpr double kDeviation = 1.4826;  // of a normal distribution, in median absolute deviations
  const std::vector<double> distances = distances_from_others(cloud);
  cloud.noise = kDeviation * quantile(distances, 0.5);
  const double far_off =
      std::max(kFarOff * cloud.noise, quantile({cloud.spacings.begin(), cloud.spacings.end()}, 0.5));
  std::vector<bool> near;
  near.reserve(distances.size());
  for (const double distance : distances) near.push_back(distance <= far_off);
  return near;
}

}  // namespace

PreparedScan prepare_scan(ScannedPoints scanned) {
  PreparedScan prepared;
  PointCloud& cloud = prepared.cloud;
  cloud.points = std::move(scanned.points);
  cloud.normals = std::move(scanned.normals);
  const std::vector<bool> once = first_of_each_place(cloud.points);
  prepared.repeated = count_off(once);
  keep_points(cloud, once);
  if (cloud.points.size() < kFewestScanPoints) return {{}, prepared.repeated, 0, false};

  put_in_order(cloud);
  cloud.spacings = spacings_of(cloud.points, PointTree(cloud.points));
  const std::vector<bool> among_others = not_alone(cloud.spacings);
  prepared.outliers = count_off(among_others);
  if (prepared.outliers > 0) {
    keep_points(cloud, among_others);
    if (cloud.points.size() < kFewestScanPoints) return {{}, prepared.repeated, prepared.outliers, false};
    cloud.spacings = spacings_of(cloud.points, PointTree(cloud.points));
  }

  {
    const PointTree tree(cloud.points);
    cloud.spacings = smoothed(cloud.spacings, cloud.points, tree);
    bool is_given = are_usable(cloud.normals);
    if (is_given) {
      for (Eigen::Vector3f& normal : cloud.normals) normal.normalize();
      is_given = contradictions(cloud.points, cloud.normals, tree) <= kMostContradictions;
    }
    prepared.estimated_normals = !is_given;
    if (!is_given) cloud.normals = estimated_normals(cloud.points, tree);
    turn_outwards(cloud.points, cloud.normals);
  }

  // Where outliers lie together, the first to go leaves the next alone.
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<bool> on_surface = near_others(cloud);
    const std::size_t off = count_off(on_surface);
    if (off == 0) break;
    prepared.outliers += off;
    keep_points(cloud, on_surface);
  }
  cloud.spacing = quantile({cloud.spacings.begin(), cloud.spacings.end()}, kMost);
  return prepared;
}

double served_epsilon(const PointCloud& cloud) {
  return 0.5 * cloud.spacing + 2.0 * cloud.noise;
}

}  // namespace lamina::engine
