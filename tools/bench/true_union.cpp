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
/// Planes beside one that a corner of patches lies in: which side it is on is for rounding to say.
constexpr double kBeside[] = {0.0, 1e-5, -1e-5};  // mm

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
    for (double fine = spacing; !loops && fine >= kFinestSpacing; fine *= 0.6) {
      for (const double beside : kBeside) {
        if (!loops) loops = loops_of(sectioner.at(z + beside, fine).pieces);
      }
    }
    if (!loops) return std::nullopt;
    regions.push_back(gcode::fill_even_odd(*loops));
  }
  return regions;
}

engine::Region true_union(const std::vector<engine::Region>& regions, double narrowest) {
  return without_narrow(gcode::unite(regions), narrowest);
}

engine::Region true_nesting(const std::vector<engine::Region>& regions, double narrowest) {
  struct Outline {
    engine::Loop loop;
    engine::Region disc;
    std::size_t part = 0;
    std::size_t group = 0;
  };
  std::vector<Outline> outlines;
  const auto add = [&](const engine::Loop& loop, std::size_t part) {
    outlines.push_back({loop, gcode::fill_even_odd({loop}), part, outlines.size()});
  };
  for (std::size_t part = 0; part < regions.size(); ++part) {
    for (const engine::Polygon& polygon : regions[part]) {
      add(polygon.outer, part);
      for (const engine::Loop& hole : polygon.holes) add(hole, part);
    }
  }
  const auto meet = [&](const Outline& a, const Outline& b) {
    return engine::area(gcode::intersect(a.disc, b.disc)) > 0.0 &&
           engine::area(gcode::subtract(a.disc, b.disc)) > 0.0 &&
           engine::area(gcode::subtract(b.disc, a.disc)) > 0.0;
  };
  for (std::size_t a = 0; a < outlines.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const std::size_t group = outlines[a].group;
      if (group == outlines[b].group || !meet(outlines[a], outlines[b])) continue;
      for (Outline& outline : outlines) {
        if (outline.group == group) outline.group = outlines[b].group;
      }
    }
  }
  // Of each group what its parts fill together; the groups' outlines do not meet and nest by parity.
  std::map<std::size_t, std::map<std::size_t, std::vector<engine::Loop>>> groups;
  for (Outline& outline : outlines) groups[outline.group][outline.part].push_back(std::move(outline.loop));
  std::vector<engine::Loop> loops;
  for (const auto& [group, parts] : groups) {
    std::vector<engine::Region> filled;
    for (const auto& [part, its_loops] : parts) filled.push_back(gcode::fill_even_odd(its_loops));
    for (const engine::Polygon& polygon : gcode::unite(filled)) {
      loops.push_back(polygon.outer);
      loops.insert(loops.end(), polygon.holes.begin(), polygon.holes.end());
    }
  }
  return without_narrow(gcode::fill_even_odd(loops), narrowest);
}

}  // namespace lamina::tools
