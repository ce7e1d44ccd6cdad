#include "tools/bench/true_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "tools/bench/patch_evaluation.h"

namespace lamina::tools {
namespace {

constexpr int kBisections = 60;
constexpr double kSolved = 1e-7;  // mm along the line
constexpr double kFewestIntervals = 3.0;
constexpr double kMostIntervals = 400.0;
/// Points this near the plane lie in it, mm: the engine's own word on what a plane touches.
constexpr double kInPlane = engine::kModelTolerance;

double longest_line(const engine::ControlNet& net, bool along_u) {
  double longest = 0.0;
  const std::size_t lines = along_u ? net.count_v : net.count_u;
  const std::size_t count = along_u ? net.count_u : net.count_v;
  for (std::size_t line = 0; line < lines; ++line) {
    double length = 0.0;
    for (std::size_t k = 1; k < count; ++k) {
      const engine::Vector4& a = along_u ? net.at(k - 1, line) : net.at(line, k - 1);
      const engine::Vector4& b = along_u ? net.at(k, line) : net.at(line, k);
      length += (b.head<3>() / b.w() - a.head<3>() / a.w()).norm();
    }
    longest = std::max(longest, length);
  }
  return longest;
}

}  // namespace

TrueSectioner::TrueSectioner(const engine::Model& model, unsigned seed) : parts_(model), random_(seed) {
  for (const ModelPatch& part : parts_.patches) {
    candidates_.push_back({&part, engine::control_box(part.patch.net), longest_line(part.patch.net, true),
                           longest_line(part.patch.net, false)});
  }
}

TrueSection TrueSectioner::at(double z, double spacing) {
  TrueSection section;
  for (const Candidate& candidate : candidates_) {
    if (candidate.box.min().z() <= z + kInPlane && candidate.box.max().z() >= z - kInPlane)
      cut(candidate, z, spacing, section);
  }
  for (const TrimOutline& outline : parts_.outlines) {
    const std::vector<engine::Vector2> rim = outline.crossings(z);
    section.crossings.insert(section.crossings.end(), rim.begin(), rim.end());
  }
  return section;
}

/// From 0 to 1, evenly but for a random part of the spacing.
std::vector<double> TrueSectioner::places(double size, double spacing) {
  const double intervals = std::clamp(std::ceil(size / spacing), kFewestIntervals, kMostIntervals);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  std::vector<double> result;
  for (double k = 0.0; k <= intervals; ++k) {
    const bool end = k == 0.0 || k == intervals;
    result.push_back((k + (end ? 0.0 : shift(random_))) / intervals);
  }
  return result;
}

void TrueSectioner::cut(const Candidate& candidate, double z, double spacing, TrueSection& section) {
  const std::vector<double> us = places(candidate.size_u, spacing);
  const std::vector<double> vs = places(candidate.size_v, spacing);
  const std::size_t columns = vs.size();
  const engine::BezierPatch& patch = candidate.part->patch;
  const auto counts = [&](const engine::Vector2& uv) { return candidate.part->counts(uv); };
  std::vector<double> heights;
  heights.reserve(us.size() * columns);
  for (const double u : us) {
    for (const double v : vs) {
      const engine::Vector3 point = evaluate_point(patch, u, v);
      heights.push_back(point.z() - z);
      if (std::abs(heights.back()) <= kInPlane && counts({u, v}))
        section.in_plane.emplace_back(point.head<2>());
    }
  }
  const auto height = [&](std::size_t i, std::size_t j) { return heights[i * columns + j]; };
  const auto crosses = [&](double a, double b) {
    return std::min(a, b) < -kInPlane && std::max(a, b) > kInPlane;
  };
  const double size = std::max(candidate.size_u, candidate.size_v);
  const auto solve = [&](engine::Vector2 low, engine::Vector2 high, bool rising) {
    for (int k = 0; k < kBisections; ++k) {
      const engine::Vector2 middle = 0.5 * (low + high);
      const double above = evaluate_point(patch, middle.x(), middle.y()).z() - z;
      if ((middle - low).cwiseAbs().maxCoeff() * size < kSolved) return middle;
      ((above > 0.0) == rising ? high : low) = middle;
    }
    return low;
  };
  // The crossing on the side of a cell from one grid point to its neighbour in u or in v; nothing where it is
  // trimmed away.
  const auto crossing = [&](std::size_t i, std::size_t j, bool along_u) -> std::optional<engine::Vector2> {
    const std::size_t i2 = along_u ? i + 1 : i;
    const std::size_t j2 = along_u ? j : j + 1;
    if (!crosses(height(i, j), height(i2, j2))) return std::nullopt;
    const engine::Vector2 uv = solve({us[i], vs[j]}, {us[i2], vs[j2]}, height(i, j) < 0.0);
    if (!counts(uv)) return std::nullopt;
    section.crossings.emplace_back(evaluate_point(patch, uv.x(), uv.y()).head<2>());
    return section.crossings.back();
  };
  std::vector<std::optional<engine::Vector2>> on_u(heights.size());
  std::vector<std::optional<engine::Vector2>> on_v(heights.size());
  for (std::size_t i = 0; i < us.size(); ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      if (i + 1 < us.size()) on_u[i * columns + j] = crossing(i, j, true);
      if (j + 1 < columns) on_v[i * columns + j] = crossing(i, j, false);
    }
  }
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    for (std::size_t j = 0; j + 1 < columns; ++j) {
      // Around the cell counter-clockwise in (u, v).
      struct Side {
        double from, to;
        const std::optional<engine::Vector2>* place;
      };
      const std::array<Side, 4> sides{{{height(i, j), height(i + 1, j), &on_u[i * columns + j]},
                                       {height(i + 1, j), height(i + 1, j + 1), &on_v[(i + 1) * columns + j]},
                                       {height(i + 1, j + 1), height(i, j + 1), &on_u[i * columns + j + 1]},
                                       {height(i, j + 1), height(i, j), &on_v[i * columns + j]}}};
      const std::optional<engine::Vector2>* falling = nullptr;
      const std::optional<engine::Vector2>* rising = nullptr;
      int count = 0;
      for (const Side& side : sides) {
        if (!crosses(side.from, side.to)) continue;
        ++count;
        (side.from < 0.0 ? rising : falling) = side.place;
      }
      // Walking from the falling side to the rising one keeps what is above the plane on the left in (u, v),
      // and the direction is e_z x normal (du, dv, normal being right-handed), solid on the left.
      if (count == 2 && falling != nullptr && rising != nullptr && *falling && *rising) {
        section.pieces.emplace_back(**rising, **falling);
        section.solids.push_back(candidate.part->solid);
      }
    }
  }
}

bool in_known_solid(const TrueSection& section, const engine::Vector2& place) {
  // Along no side of a common part: beside the rims of trimmed surfaces a piece may be missing.
  constexpr std::size_t kRays = 9;
  constexpr double kFirstAngle = 0.2718;
  std::array<engine::Vector2, kRays> ways;
  for (std::size_t k = 0; k < kRays; ++k) {
    const double angle = kFirstAngle + 2.0 * std::numbers::pi * static_cast<double>(k) / kRays;
    ways[k] = {std::cos(angle), std::sin(angle)};
  }
  std::map<std::uint32_t, std::array<bool, kRays>> odd;
  for (std::size_t p = 0; p < section.pieces.size(); ++p) {
    if (section.solids[p] == 0) continue;
    const engine::Vector2 a = section.pieces[p].first - place;
    const engine::Vector2 b = section.pieces[p].second - place;
    for (std::size_t k = 0; k < kRays; ++k) {
      const double side_a = ways[k].x() * a.y() - ways[k].y() * a.x();
      const double side_b = ways[k].x() * b.y() - ways[k].y() * b.x();
      if ((side_a > 0.0) == (side_b > 0.0)) continue;
      const engine::Vector2 hit = a + side_a / (side_a - side_b) * (b - a);
      if (hit.dot(ways[k]) > 0.0) odd[section.solids[p]][k] = !odd[section.solids[p]][k];
    }
  }
  return std::any_of(odd.begin(), odd.end(), [](const auto& solid) {
    return 2 * std::count(solid.second.begin(), solid.second.end(), true) >
           static_cast<std::ptrdiff_t>(kRays);
  });
}

double winding_number(const TrueSection& section, const engine::Vector2& place) {
  double turned = 0.0;
  for (std::size_t k = 0; k < section.pieces.size(); ++k) {
    if (section.solids[k] != 0) continue;
    const engine::Vector2 a = section.pieces[k].first - place;
    const engine::Vector2 b = section.pieces[k].second - place;
    turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return turned / (2.0 * std::numbers::pi);
}

}  // namespace lamina::tools
