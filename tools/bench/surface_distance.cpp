#include "tools/bench/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <Eigen/Dense>

#include "tools/bench/patch_evaluation.h"

namespace lamina::tools {
namespace {

constexpr int kMostSteps = 20;
constexpr double kNegligibleStep = 1e-10;
constexpr double kCertain = 1e-6;
constexpr double kSmallestPart = 1e-5;  // mm
constexpr int kMostParts = 20000;

engine::Vector2 coarse_start(const engine::Vector3& point, const CoarseGrid& coarse) {
  std::size_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    const double squared = (coarse[k] - point).squaredNorm();
    if (squared < nearest) {
      nearest = squared;
      best = k;
    }
  }
  return {0.5 * static_cast<double>(best / 3), 0.5 * static_cast<double>(best % 3)};
}

/// The step of Gauss and Newton on |S(u, v) - point|^2; at a side of the domain that the step would leave,
/// only along it.
engine::Vector2 projection_step(const PatchPoint& at, const engine::Vector3& point,
                                const engine::Vector2& uv) {
  const engine::Vector3 rest = point - at.point;
  Eigen::Matrix2d normal;
  normal << at.du.squaredNorm(), at.du.dot(at.dv), at.du.dot(at.dv), at.dv.squaredNorm();
  const engine::Vector2 gradient(at.du.dot(rest), at.dv.dot(rest));
  const auto blocked = [&](int axis) {
    return (uv[axis] <= 0.0 && gradient[axis] < 0.0) || (uv[axis] >= 1.0 && gradient[axis] > 0.0);
  };
  const auto along = [&](int axis) {
    return normal(axis, axis) > 0.0 ? gradient[axis] / normal(axis, axis) : 0.0;
  };
  const double determinant = normal.determinant();
  if (blocked(0) || blocked(1) || determinant <= 1e-14 * normal(0, 0) * normal(1, 1)) {
    return {blocked(0) ? 0.0 : along(0), blocked(1) ? 0.0 : along(1)};
  }
  return normal.inverse() * gradient;
}

}  // namespace

CoarseGrid coarse_grid(const engine::BezierPatch& patch) {
  CoarseGrid grid;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    grid[k] = engine::evaluate(patch, 0.5 * static_cast<double>(k / 3), 0.5 * static_cast<double>(k % 3));
  }
  return grid;
}

FootPoint foot_on_patch(const engine::Vector3& point, const engine::BezierPatch& patch,
                        const CoarseGrid& coarse) {
  engine::Vector2 uv = coarse_start(point, coarse);
  PatchPoint at = evaluate_with_derivatives(patch, uv.x(), uv.y());
  double best = (at.point - point).norm();
  for (int step = 0; step < kMostSteps; ++step) {
    engine::Vector2 move = projection_step(at, point, uv);
    // Halve the step until it brings the foot nearer; when none does, the foot is found.
    bool nearer = false;
    for (int halving = 0; halving < 8 && !nearer; ++halving, move *= 0.5) {
      const engine::Vector2 next = (uv + move).cwiseMax(0.0).cwiseMin(1.0);
      if ((next - uv).cwiseAbs().maxCoeff() < kNegligibleStep) return {best, uv};
      const PatchPoint tried = evaluate_with_derivatives(patch, next.x(), next.y());
      const double distance = (tried.point - point).norm();
      if (distance >= best) continue;
      nearer = true;
      best = distance;
      uv = next;
      at = tried;
    }
    if (!nearer) break;
  }
  return {best, uv};
}

FootPoint certain_foot_on_patch(const engine::Vector3& point, const engine::BezierPatch& patch,
                                double farthest) {
  struct Part {
    double to_box;
    engine::BezierPatch patch;
    engine::Vector2 low;  ///< corners in the whole patch
    engine::Vector2 high;
    bool operator<(const Part& other) const { return to_box > other.to_box; }
  };
  std::priority_queue<Part> parts;
  const auto add = [&](engine::BezierPatch piece, const engine::Vector2& low, const engine::Vector2& high) {
    const double to_box = engine::control_box(piece.net).exteriorDistance(point);
    parts.push({to_box, std::move(piece), low, high});
  };
  add(patch, engine::Vector2::Zero(), engine::Vector2::Ones());
  FootPoint best{farthest, {}};
  for (int count = 0; count < kMostParts && !parts.empty(); ++count) {
    const Part nearest = parts.top();
    parts.pop();
    if (nearest.to_box >= best.distance - kCertain) break;
    const FootPoint foot = foot_on_patch(point, nearest.patch, coarse_grid(nearest.patch));
    if (foot.distance < best.distance)
      best = {foot.distance, nearest.low + foot.parameters.cwiseProduct(nearest.high - nearest.low)};
    if (engine::control_box(nearest.patch.net).diagonal().norm() < kSmallestPart) continue;
    const engine::Vector2 middle = 0.5 * (nearest.low + nearest.high);
    auto [left, right] = engine::halves_in_u(nearest.patch);
    for (const bool upper_u : {false, true}) {
      auto [first, second] = engine::halves_in_v(upper_u ? right : left);
      const double from = upper_u ? middle.x() : nearest.low.x();
      const double to = upper_u ? nearest.high.x() : middle.x();
      add(std::move(first), {from, nearest.low.y()}, {to, middle.y()});
      add(std::move(second), {from, middle.y()}, {to, nearest.high.y()});
    }
  }
  return best;
}

SurfaceDistance::SurfaceDistance(const engine::Model& model) : parts_(model) {
  for (const ModelPatch& part : parts_.patches)
    candidates_.push_back({&part, engine::control_box(part.patch.net), coarse_grid(part.patch)});
}

void SurfaceDistance::select_plane(double z, double reach) {
  selected_.clear();
  std::vector<engine::Box2> boxes;
  for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
    const engine::Box3& box = candidates_[k].box;
    if (box.min().z() > z + reach || box.max().z() < z - reach) continue;
    selected_.push_back(k);
    boxes.emplace_back(engine::Vector2(box.min().head<2>()), engine::Vector2(box.max().head<2>()));
  }
  bins_ = PlanarBins(std::move(boxes));
}

/// The least of `best` and the distance to what counts of a patch whose nearest point is known.
double SurfaceDistance::distance_to(const ModelPatch& part, const engine::Vector3& point,
                                    const FootPoint& foot, double best) {
  if (foot.distance >= best) return best;
  return part.counts(foot.parameters) ? foot.distance : std::min(best, part.trim->distance_to_rim(point));
}

double SurfaceDistance::distance(const engine::Vector3& point, const Trust& trust) const {
  const double local = bins_.nearest(point.head<2>(), trust.enough, [&](std::uint32_t item, double best) {
    const Candidate& candidate = candidates_[selected_[item]];
    if (candidate.box.exteriorDistance(point) >= best) return best;
    return distance_to(*candidate.part, point, foot_on_patch(point, candidate.part->patch, candidate.coarse),
                       best);
  });
  if (local <= trust.local) return local;
  return bins_.nearest(point.head<2>(), trust.enough, [&](std::uint32_t item, double best) {
    const Candidate& candidate = candidates_[selected_[item]];
    const double bound = std::min(best, local);
    if (candidate.box.exteriorDistance(point) >= bound) return bound;
    return distance_to(*candidate.part, point, certain_foot_on_patch(point, candidate.part->patch, bound),
                       bound);
  });
}

}  // namespace lamina::tools
