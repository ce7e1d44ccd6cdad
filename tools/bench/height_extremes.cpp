#include "tools/bench/height_extremes.h"

#include <algorithm>
#include <cstddef>

#include "tools/bench/patch_evaluation.h"

namespace lamina::tools {
namespace {

/// A polynomial of degree p has p - 1 extremes on a line at most.
constexpr int kIntervalsPerDegree = 4;
constexpr double kFinestStep = 1e-9;
constexpr int kMostMoves = 1000;
/// Lines nearer to each other are one.
constexpr double kSameLine = 1e-6;

/// Steps of a search: along the sides of the patch that it is bound to, or all around.
using Ways = std::vector<engine::Vector2>;

/// From `uv` as high as `ways` lead, inside the patch; `sign` -1: as low.
engine::Vector2 climbed(const engine::BezierPatch& patch, engine::Vector2 uv, double step, double sign,
                        const Ways& ways) {
  const auto height = [&](const engine::Vector2& at) {
    return sign * evaluate_point(patch, at.x(), at.y()).z();
  };
  double best = height(uv);
  for (int move = 0; move < kMostMoves && step > kFinestStep; ++move) {
    engine::Vector2 highest = uv;
    for (const engine::Vector2& way : ways) {
      const engine::Vector2 tried = (uv + step * way).cwiseMax(0.0).cwiseMin(1.0);
      const double there = height(tried);
      if (there <= best) continue;
      best = there;
      highest = tried;
    }
    if (highest == uv) step *= 0.5;
    uv = highest;
  }
  return uv;
}

/// Heights at the places of an even grid over the patch.
class HeightGrid {
 public:
  explicit HeightGrid(const engine::BezierPatch& patch)
      : patch_(patch),
        intervals_u_(kIntervalsPerDegree * static_cast<int>(patch.net.count_u - 1)),
        intervals_v_(kIntervalsPerDegree * static_cast<int>(patch.net.count_v - 1)) {
    for (int i = 0; i <= intervals_u_; ++i) {
      for (int j = 0; j <= intervals_v_; ++j)
        heights_.push_back(evaluate_point(patch, at(i, j).x(), at(i, j).y()).z());
    }
  }

  /// Climbs from each place that is no lower than those next to it that `ways` lead to, and is not level with
  /// all of them; from all places with i a multiple of `every_u` and j one of `every_v`.
  void climb(double sign, const Ways& ways, int every_u, int every_v, ParameterLines& lines) const {
    for (int i = 0; i <= intervals_u_; i += every_u) {
      for (int j = 0; j <= intervals_v_; j += every_v) {
        if (!is_extreme(i, j, sign, ways)) continue;
        const engine::Vector2 top =
            climbed(patch_, at(i, j), 1.0 / std::max(intervals_u_, intervals_v_), sign, ways);
        lines.us.push_back(top.x());
        lines.vs.push_back(top.y());
      }
    }
  }

  int intervals_u() const { return intervals_u_; }
  int intervals_v() const { return intervals_v_; }

 private:
  engine::Vector2 at(int i, int j) const {
    return {static_cast<double>(i) / intervals_u_, static_cast<double>(j) / intervals_v_};
  }
  double height(int i, int j) const { return heights_[static_cast<std::size_t>(i * (intervals_v_ + 1) + j)]; }

  bool is_extreme(int i, int j, double sign, const Ways& ways) const {
    bool higher = false;
    for (const engine::Vector2& way : ways) {
      const int next_i = i + static_cast<int>(way.x());
      const int next_j = j + static_cast<int>(way.y());
      if (next_i < 0 || next_i > intervals_u_ || next_j < 0 || next_j > intervals_v_) continue;
      const double over = sign * (height(i, j) - height(next_i, next_j));
      if (over < 0.0) return false;
      higher = higher || over > 0.0;
    }
    return higher;
  }

  const engine::BezierPatch& patch_;
  int intervals_u_;
  int intervals_v_;
  std::vector<double> heights_;
};

/// Whether the height does nothing but rise, or nothing but fall, in one direction, as the net shows; false
/// where it does not show it.
bool is_monotone(const engine::ControlNet& net, bool along_u) {
  const double weight = net.points.front().w();
  bool rises = false;
  bool falls = false;
  for (std::size_t i = 0; i < net.count_u; ++i) {
    for (std::size_t j = 0; j < net.count_v; ++j) {
      const engine::Vector4& point = net.at(i, j);
      if (point.w() != weight) return false;
      if (along_u ? i == 0 : j == 0) continue;
      const double rise = point.z() - (along_u ? net.at(i - 1, j) : net.at(i, j - 1)).z();
      rises = rises || rise > 0.0;
      falls = falls || rise < 0.0;
    }
  }
  return !rises || !falls;
}

void make_lines(std::vector<double>& places) {
  std::sort(places.begin(), places.end());
  std::vector<double> lines;
  for (const double place : places) {
    if (place > kSameLine && place < 1.0 - kSameLine && (lines.empty() || place > lines.back() + kSameLine))
      lines.push_back(place);
  }
  places = std::move(lines);
}

}  // namespace

ParameterLines lines_through_extremes(const engine::BezierPatch& patch) {
  const Ways along_u{{1, 0}, {-1, 0}};
  const Ways along_v{{0, 1}, {0, -1}};
  const Ways around{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  const bool waves_u = !is_monotone(patch.net, true);
  const bool waves_v = !is_monotone(patch.net, false);
  ParameterLines lines;
  if (!waves_u && !waves_v) return lines;
  const HeightGrid grid(patch);
  for (const double sign : {1.0, -1.0}) {
    if (waves_u && waves_v) grid.climb(sign, around, 1, 1, lines);
    if (waves_u) grid.climb(sign, along_u, 1, grid.intervals_v(), lines);
    if (waves_v) grid.climb(sign, along_v, grid.intervals_u(), 1, lines);
  }
  make_lines(lines.us);
  make_lines(lines.vs);
  return lines;
}

}  // namespace lamina::tools
