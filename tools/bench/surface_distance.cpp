#include "tools/bench/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace lamina::tools {
namespace {

constexpr int kCoarseIntervals = 2;
constexpr int kMostSteps = 20;
constexpr double kNegligibleStep = 1e-10;
constexpr std::ptrdiff_t kMostBinsPerSide = 256;

engine::NurbsSurface as_surface(const engine::BezierPatch& patch) {
  const auto bezier_knots = [](int degree) {
    engine::Knots knots(static_cast<std::size_t>(degree) + 1, 0.0);
    knots.resize(2 * knots.size(), 1.0);
    return knots;
  };
  return {patch.degree_u, patch.degree_v, bezier_knots(patch.degree_u), bezier_knots(patch.degree_v),
          patch.net};
}

engine::Vector2 coarse_start(const engine::Vector3& point, const engine::NurbsSurface& patch) {
  engine::Vector2 best(0.5, 0.5);
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kCoarseIntervals; ++i) {
    for (int j = 0; j <= kCoarseIntervals; ++j) {
      const engine::Vector2 uv(i / static_cast<double>(kCoarseIntervals),
                               j / static_cast<double>(kCoarseIntervals));
      const double squared = (engine::evaluate(patch, uv.x(), uv.y()) - point).squaredNorm();
      if (squared < nearest) {
        nearest = squared;
        best = uv;
      }
    }
  }
  return best;
}

/// The step of Gauss and Newton on |S(u, v) - point|^2; at a side of the domain that the step would leave,
/// only along it.
engine::Vector2 projection_step(const engine::SurfaceDerivatives& at, const engine::Vector3& point,
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

double distance_to_box(const engine::Vector3& point, const engine::Box3& box) {
  return box.exteriorDistance(point);
}

}  // namespace

double distance_to_patch(const engine::Vector3& point, const engine::NurbsSurface& patch) {
  engine::Vector2 uv = coarse_start(point, patch);
  engine::SurfaceDerivatives at = engine::evaluate_derivatives(patch, uv.x(), uv.y());
  double best = (at.point - point).norm();
  for (int step = 0; step < kMostSteps; ++step) {
    engine::Vector2 move = projection_step(at, point, uv);
    // Halve the step until it brings the foot nearer; when none does, the foot is found.
    bool nearer = false;
    for (int halving = 0; halving < 8 && !nearer; ++halving, move *= 0.5) {
      const engine::Vector2 next = (uv + move).cwiseMax(0.0).cwiseMin(1.0);
      if ((next - uv).cwiseAbs().maxCoeff() < kNegligibleStep) return best;
      const engine::SurfaceDerivatives tried = engine::evaluate_derivatives(patch, next.x(), next.y());
      const double distance = (tried.point - point).norm();
      if (distance >= best) continue;
      nearer = true;
      best = distance;
      uv = next;
      at = tried;
    }
    if (!nearer) break;
  }
  return best;
}

SurfaceDistance::SurfaceDistance(const std::vector<engine::BezierPatch>& patches) {
  candidates_.reserve(patches.size());
  for (const engine::BezierPatch& patch : patches) {
    candidates_.push_back({as_surface(patch), engine::control_box(patch.net)});
  }
}

void SurfaceDistance::select_plane(double z, double reach) {
  std::vector<std::size_t> selected;
  selected_box_.setEmpty();
  double side_sum = 0.0;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const engine::Box3& box = candidates_[k].box;
    if (box.min().z() > z + reach || box.max().z() < z - reach) continue;
    selected.push_back(k);
    selected_box_.extend(engine::Vector2(box.min().head<2>()));
    selected_box_.extend(engine::Vector2(box.max().head<2>()));
    side_sum += box.sizes().head<2>().maxCoeff();
  }
  bins_.clear();
  columns_ = rows_ = 0;
  if (selected.empty()) return;
  const double longest_side = std::max(selected_box_.sizes().maxCoeff(), 1e-9);
  bin_size_ = std::max({side_sum / static_cast<double>(selected.size()), reach,
                        longest_side / static_cast<double>(kMostBinsPerSide)});
  columns_ = static_cast<std::ptrdiff_t>(selected_box_.sizes().x() / bin_size_) + 1;
  rows_ = static_cast<std::ptrdiff_t>(selected_box_.sizes().y() / bin_size_) + 1;
  bins_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (const std::size_t k : selected) {
    const engine::Vector2 low = (candidates_[k].box.min().head<2>() - selected_box_.min()) / bin_size_;
    const engine::Vector2 high = (candidates_[k].box.max().head<2>() - selected_box_.min()) / bin_size_;
    for (auto y = static_cast<std::ptrdiff_t>(low.y()); y <= static_cast<std::ptrdiff_t>(high.y()); ++y) {
      for (auto x = static_cast<std::ptrdiff_t>(low.x()); x <= static_cast<std::ptrdiff_t>(high.x()); ++x) {
        bin(x, y).push_back(k);
      }
    }
  }
}

double SurfaceDistance::distance(const engine::Vector3& point) const {
  double best = std::numeric_limits<double>::infinity();
  if (bins_.empty()) return best;
  const engine::Vector2 place = (point.head<2>() - selected_box_.min()) / bin_size_;
  const auto home_x =
      std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(place.x())), 0, columns_ - 1);
  const auto home_y =
      std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(place.y())), 0, rows_ - 1);
  std::vector<std::pair<double, std::size_t>> near;
  // Rings of bins around the point's own, until the ring is farther than what was found.
  for (std::ptrdiff_t ring = 0; ring <= std::max(columns_, rows_); ++ring) {
    if (static_cast<double>(ring - 1) * bin_size_ > best) break;
    near.clear();
    for (std::ptrdiff_t y = home_y - ring; y <= home_y + ring; ++y) {
      for (std::ptrdiff_t x = home_x - ring; x <= home_x + ring; ++x) {
        const bool on_ring = std::max(std::abs(x - home_x), std::abs(y - home_y)) == ring;
        if (!on_ring || x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
        for (const std::size_t k : bins_[static_cast<std::size_t>(y * columns_ + x)]) {
          near.emplace_back(distance_to_box(point, candidates_[k].box), k);
        }
      }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const auto& [to_box, k] : near) {
      if (to_box >= best) break;
      best = std::min(best, distance_to_patch(point, candidates_[k].surface));
    }
  }
  return best;
}

}  // namespace lamina::tools
