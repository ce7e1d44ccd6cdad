#include "engine/scan/scan_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include <Eigen/Eigenvalues>

namespace lamina::engine {
namespace {

/// Neighbours that a plane is laid through, the point itself among them.
constexpr std::size_t kPlanePoints = 17;
/// Neighbours that a normal is compared with, the point itself among them.
constexpr std::size_t kCompared = 9;

Eigen::Vector3f plane_normal(const std::vector<Eigen::Vector3f>& points,
                             const std::vector<PointTree::Neighbour>& neighbours) {
  Vector3 mean = Vector3::Zero();
  for (const auto& neighbour : neighbours) mean += points[neighbour.point].cast<double>();
  mean /= static_cast<double>(neighbours.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& neighbour : neighbours) {
    const Vector3 away = points[neighbour.point].cast<double>() - mean;
    spread += away * away.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread);
  return solver.eigenvectors().col(0).cast<float>();
}

/// A step of the spanning tree: from a point that has its direction to one that has none yet.
struct Step {
  float disagreement;
  std::uint32_t to;
  std::uint32_t from;

  bool operator>(const Step& other) const {
    return std::tie(disagreement, to, from) > std::tie(other.disagreement, other.to, other.from);
  }
};

void agree_with_neighbours(const std::vector<Eigen::Vector3f>& points, const PointTree& tree,
                           std::vector<Eigen::Vector3f>& normals) {
  std::vector<std::uint32_t> from_top(points.size());
  std::iota(from_top.begin(), from_top.end(), 0U);
  std::stable_sort(from_top.begin(), from_top.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return points[a].z() > points[b].z(); });
  std::vector<bool> is_set(points.size(), false);
  std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
  const auto set = [&](std::uint32_t point) {
    is_set[point] = true;
    for (const auto& neighbour : tree.nearest(points[point], kCompared)) {
      if (is_set[neighbour.point]) continue;
      steps.push({1.0F - std::abs(normals[point].dot(normals[neighbour.point])), neighbour.point, point});
    }
  };
  for (const std::uint32_t top : from_top) {
    if (is_set[top]) continue;
    if (normals[top].z() < 0.0F) normals[top] = -normals[top];
    set(top);
    while (!steps.empty()) {
      const Step step = steps.top();
      steps.pop();
      if (is_set[step.to]) continue;
      if (normals[step.to].dot(normals[step.from]) < 0.0F) normals[step.to] = -normals[step.to];
      set(step.to);
    }
  }
}

}  // namespace

std::vector<Eigen::Vector3f> estimated_normals(const std::vector<Eigen::Vector3f>& points,
                                               const PointTree& tree) {
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(points.size());
  for (const Eigen::Vector3f& point : points)
    normals.push_back(plane_normal(points, tree.nearest(point, kPlanePoints)));
  agree_with_neighbours(points, tree, normals);
  return normals;
}

double contradictions(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                      const PointTree& tree) {
  std::size_t pairs = 0;
  std::size_t opposite = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const auto& neighbour : tree.nearest(points[i], kCompared)) {
      if (neighbour.point == i) continue;
      ++pairs;
      opposite += normals[i].dot(normals[neighbour.point]) < 0.0F ? 1U : 0U;
    }
  }
  return pairs > 0 ? static_cast<double>(opposite) / static_cast<double>(pairs) : 0.0;
}

void turn_outwards(const std::vector<Eigen::Vector3f>& points, std::vector<Eigen::Vector3f>& normals) {
  float outwards = 0.0F;
  for (const Eigen::Index axis : {0, 1, 2}) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(),
        [axis](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a[axis] < b[axis]; });
    outwards += normals[static_cast<std::size_t>(high - points.begin())][axis];
    outwards -= normals[static_cast<std::size_t>(low - points.begin())][axis];
  }
  if (outwards >= 0.0F) return;
  for (Eigen::Vector3f& normal : normals) normal = -normal;
}

}  // namespace lamina::engine
