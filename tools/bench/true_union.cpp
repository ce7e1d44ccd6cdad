#include "tools/bench/true_union.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "gcode/region/polygon_clipping.h"

namespace lamina::tools {
namespace {

constexpr unsigned kSeed = 31;
constexpr double kJoined = 1e-5;         // mm
constexpr double kFinestSpacing = 0.01;  // mm

/// Ends of pieces by place: piece 2k begins, 2k + 1 ends.
class Ends {
 public:
  explicit Ends(const std::vector<SectionPiece>& pieces)
      : pieces_(pieces), partner_(2 * pieces.size(), kNone) {
    for (std::size_t end = 0; end < partner_.size(); ++end) cells_[cell_of(place(end))].push_back(end);
    for (std::size_t end = 0; end < partner_.size(); ++end) {
      if (partner_[end] == kNone) pair(end);
    }
  }

  static constexpr std::size_t kNone = ~std::size_t{0};

  const engine::Vector2& place(std::size_t end) const {
    return end % 2 == 0 ? pieces_[end / 2].first : pieces_[end / 2].second;
  }
  std::size_t partner(std::size_t end) const { return partner_[end]; }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;

  static Cell cell_of(const engine::Vector2& place) {
    return {std::llround(place.x() / kJoined), std::llround(place.y() / kJoined)};
  }

  void pair(std::size_t end) {
    const Cell home = cell_of(place(end));
    double nearest = kJoined;
    std::size_t best = kNone;
    for (std::int64_t x = home.first - 1; x <= home.first + 1; ++x) {
      for (std::int64_t y = home.second - 1; y <= home.second + 1; ++y) {
        const auto found = cells_.find({x, y});
        if (found == cells_.end()) continue;
        for (const std::size_t other : found->second) {
          if (other / 2 == end / 2 || partner_[other] != kNone) continue;
          const double distance = (place(other) - place(end)).norm();
          if (distance <= nearest) {
            nearest = distance;
            best = other;
          }
        }
      }
    }
    if (best == kNone) return;
    partner_[end] = best;
    partner_[best] = end;
  }

  const std::vector<SectionPiece>& pieces_;
  std::vector<std::size_t> partner_;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

double mean_width(const engine::Loop& loop) {
  return 2.0 * std::abs(engine::signed_area(loop)) / engine::perimeter(loop);
}

engine::Region without_narrow(engine::Region region, double narrowest) {
  std::erase_if(region,
                [&](const engine::Polygon& polygon) { return mean_width(polygon.outer) < narrowest; });
  for (engine::Polygon& polygon : region) {
    std::erase_if(polygon.holes, [&](const engine::Loop& hole) { return mean_width(hole) < narrowest; });
  }
  return region;
}

}  // namespace

std::optional<std::vector<engine::Loop>> loops_of(const std::vector<SectionPiece>& pieces) {
  const Ends ends(pieces);
  std::vector<engine::Loop> loops;
  std::vector<bool> used(pieces.size(), false);
  for (std::size_t first = 0; first < pieces.size(); ++first) {
    if (used[first]) continue;
    engine::Loop loop;
    for (std::size_t end = 2 * first; !used[end / 2];) {
      used[end / 2] = true;
      loop.push_back(ends.place(end));
      const std::size_t next = ends.partner(end ^ 1U);
      if (next == Ends::kNone) return std::nullopt;
      end = next;
    }
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

std::optional<std::vector<engine::Region>> true_regions(const std::vector<engine::Model>& parts, double z,
                                                        double spacing) {
  std::vector<engine::Region> regions;
  for (const engine::Model& part : parts) {
    TrueSectioner sectioner(part, kSeed);
    std::optional<std::vector<engine::Loop>> loops;
    for (double fine = spacing; !loops && fine >= kFinestSpacing; fine *= 0.6)
      loops = loops_of(sectioner.at(z, fine).pieces);
    if (!loops) return std::nullopt;
    regions.push_back(gcode::fill_even_odd(*loops));
  }
  return regions;
}

engine::Region true_union(const std::vector<engine::Region>& regions, double narrowest) {
  return without_narrow(gcode::unite(regions), narrowest);
}

engine::Region true_nesting(const std::vector<engine::Region>& regions, double narrowest) {
  // Polygons that meet are one; then each lies apart from, or inside, every other.
  std::vector<engine::Region> groups;
  for (const engine::Region& region : regions) {
    for (const engine::Polygon& polygon : region) groups.push_back({polygon});
  }
  const auto meet = [&](const engine::Region& a, const engine::Region& b) {
    return engine::area(gcode::intersect(a, b)) > 0.0 && engine::area(gcode::subtract(a, b)) > 0.0 &&
           engine::area(gcode::subtract(b, a)) > 0.0;
  };
  for (bool joined = true; joined;) {
    joined = false;
    for (std::size_t a = 0; a < groups.size() && !joined; ++a) {
      for (std::size_t b = a + 1; b < groups.size() && !joined; ++b) {
        if (!meet(groups[a], groups[b])) continue;
        groups[a] = gcode::unite({groups[a], groups[b]});
        groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(b));
        joined = true;
      }
    }
  }
  std::vector<engine::Loop> loops;
  for (const engine::Region& group : groups) {
    for (const engine::Polygon& polygon : group) {
      loops.push_back(polygon.outer);
      loops.insert(loops.end(), polygon.holes.begin(), polygon.holes.end());
    }
  }
  return without_narrow(gcode::fill_even_odd(loops), narrowest);
}

}  // namespace lamina::tools
