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
/// A trimmed surface that does not go on so far on both sides of the plane may end in it, mm.
constexpr double kBeside = 1e-5;
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
  for (Candidate& candidate : candidates_) {
    if (candidate.box.min().z() <= z + kInPlane && candidate.box.max().z() >= z - kInPlane)
      cut(candidate, z, spacing, section);
  }
  for (const TrimOutline& outline : parts_.outlines) {
    const TrimOutline::Crossings rim = outline.crossings(z);
    section.crossings.insert(section.crossings.end(), rim.through.begin(), rim.through.end());
    section.in_plane.insert(section.in_plane.end(), rim.in_plane.begin(), rim.in_plane.end());
  }
  return section;
}

/// From 0 to 1, evenly but for a random part of the spacing, and at the extremes.
std::vector<double> TrueSectioner::places(double size, double spacing, const std::vector<double>& extremes) {
  const double intervals = std::clamp(std::ceil(size / spacing), kFewestIntervals, kMostIntervals);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  std::vector<double> result;
  for (double k = 0.0; k <= intervals; ++k) {
    const bool end = k == 0.0 || k == intervals;
    result.push_back((k + (end ? 0.0 : shift(random_))) / intervals);
  }
  result.insert(result.end(), extremes.begin(), extremes.end());
  std::sort(result.begin(), result.end());
  return result;
}

void TrueSectioner::cut(Candidate& candidate, double z, double spacing, TrueSection& section) {
  if (!candidate.extremes) candidate.extremes = lines_through_extremes(candidate.part->patch);
  const std::vector<double> us = places(candidate.size_u, spacing, candidate.extremes->us);
  const std::vector<double> vs = places(candidate.size_v, spacing, candidate.extremes->vs);
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
  struct Crossing {
    engine::Vector2 uv;
    engine::Vector2 place;
    bool counts = false;  ///< false: trimmed away
  };
  // On the side of a cell from one grid point to its neighbour in u or in v.
  const auto crossing = [&](std::size_t i, std::size_t j, bool along_u) -> std::optional<Crossing> {
    const std::size_t i2 = along_u ? i + 1 : i;
    const std::size_t j2 = along_u ? j : j + 1;
    if (!crosses(height(i, j), height(i2, j2))) return std::nullopt;
    const engine::Vector2 uv = solve({us[i], vs[j]}, {us[i2], vs[j2]}, height(i, j) < 0.0);
    const Crossing found{uv, evaluate_point(patch, uv.x(), uv.y()).head<2>(), counts(uv)};
    if (!found.counts) return found;
    const engine::Vector2 step = along_u ? engine::Vector2(kBeside / candidate.size_u, 0.0)
                                         : engine::Vector2(0.0, kBeside / candidate.size_v);
    const bool passes = counts(uv - step) && counts(uv + step);
    (passes ? section.crossings : section.in_plane).push_back(found.place);
    return found;
  };
  std::vector<std::optional<Crossing>> on_u(heights.size());
  std::vector<std::optional<Crossing>> on_v(heights.size());
  for (std::size_t i = 0; i < us.size(); ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      if (i + 1 < us.size()) on_u[i * columns + j] = crossing(i, j, true);
      if (j + 1 < columns) on_v[i * columns + j] = crossing(i, j, false);
    }
  }
  // Where the piece between two crossings, one of which is trimmed away, meets the rim.
  const auto at_rim = [&](engine::Vector2 inside, engine::Vector2 outside) -> engine::Vector2 {
    for (int k = 0; k < kBisections && (outside - inside).cwiseAbs().maxCoeff() * size > kSolved; ++k) {
      const engine::Vector2 middle = 0.5 * (inside + outside);
      (counts(middle) ? inside : outside) = middle;
    }
    return evaluate_point(patch, inside.x(), inside.y()).head<2>();
  };
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    for (std::size_t j = 0; j + 1 < columns; ++j) {
      // Around the cell counter-clockwise in (u, v).
      struct Side {
        double from;
        const std::optional<Crossing>& crossing;
      };
      const std::array<Side, 4> sides{{{height(i, j), on_u[i * columns + j]},
                                       {height(i + 1, j), on_v[(i + 1) * columns + j]},
                                       {height(i + 1, j + 1), on_u[i * columns + j + 1]},
                                       {height(i, j + 1), on_v[i * columns + j]}}};
      const Crossing* falling = nullptr;
      const Crossing* rising = nullptr;
      int count = 0;
      for (const Side& side : sides) {
        if (!side.crossing) continue;
        ++count;
        (side.from < 0.0 ? rising : falling) = &*side.crossing;
      }
      // Walking from the falling side to the rising one keeps what is above the plane on the left in (u, v),
      // and the direction is e_z x normal (du, dv, normal being right-handed), solid on the left.
      if (count != 2 || falling == nullptr || rising == nullptr) continue;
      if (!falling->counts && !rising->counts) continue;
      section.pieces.emplace_back(rising->counts ? rising->place : at_rim(falling->uv, rising->uv),
                                  falling->counts ? falling->place : at_rim(rising->uv, falling->uv));
      section.solids.push_back(candidate.part->solid);
    }
  }
}

KnownSolids::KnownSolids(const TrueSection& section) {
  std::map<std::uint32_t, Solid> by_number;
  for (std::size_t k = 0; k < section.pieces.size(); ++k) {
    if (section.solids[k] == 0) continue;
    Solid& solid = by_number[section.solids[k]];
    solid.pieces.push_back(section.pieces[k]);
    solid.box.extend(section.pieces[k].first).extend(section.pieces[k].second);
  }
  for (auto& [number, solid] : by_number) solids_.push_back(std::move(solid));
}

bool KnownSolids::contains(const engine::Vector2& place) const {
  return std::any_of(solids_.begin(), solids_.end(), [&](const Solid& solid) {
    return solid.box.contains(place) && contains(solid.pieces, place);
  });
}

bool KnownSolids::contains(const std::vector<SectionPiece>& pieces, const engine::Vector2& place) {
  // Along no side of a common part. Where a feature of the trim loops is smaller than a cell a piece may be
  // missing, hence several rays.
  constexpr std::size_t kRays = 9;
  constexpr double kFirstAngle = 0.2718;
  std::array<engine::Vector2, kRays> ways;
  for (std::size_t k = 0; k < kRays; ++k) {
    const double angle = kFirstAngle + 2.0 * std::numbers::pi * static_cast<double>(k) / kRays;
    ways[k] = {std::cos(angle), std::sin(angle)};
  }
  std::array<bool, kRays> odd{};
  for (const SectionPiece& piece : pieces) {
    const engine::Vector2 a = piece.first - place;
    const engine::Vector2 b = piece.second - place;
    for (std::size_t k = 0; k < kRays; ++k) {
      const double side_a = ways[k].x() * a.y() - ways[k].y() * a.x();
      const double side_b = ways[k].x() * b.y() - ways[k].y() * b.x();
      if ((side_a > 0.0) == (side_b > 0.0)) continue;
      const engine::Vector2 hit = a + side_a / (side_a - side_b) * (b - a);
      if (hit.dot(ways[k]) > 0.0) odd[k] = !odd[k];
    }
  }
  return 2 * std::count(odd.begin(), odd.end(), true) > static_cast<std::ptrdiff_t>(kRays);
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
