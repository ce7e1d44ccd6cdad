#include "engine/pointcloud/scan_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "engine/scan/scan_field.h"

namespace lamina::engine {
namespace {

/// Side of a grid cell, in spacings.
constexpr double kCell = 0.5;
/// Spacings around a point in which the section is looked for.
constexpr double kAround = 1.5;
/// Spacings from the nearest point beyond which the scan has a hole: among points at random one place of some
/// hundred thousand is so far from all of them.
constexpr double kHole = 2.0;
/// Spacings from the nearest point at which such a hole begins.
constexpr double kRim = 1.0;
/// How many times as long as the way across a chain must be that is closed.
constexpr double kClosing = 3.0;
constexpr int kMostRootSteps = 16;
/// Of a cell's side: error of a node on the grid line.
constexpr double kRootError = 1e-4;

/// A vertex of the grid, a cell by its lower corner, or a side: of lower end `at`, along x or y.
struct GridPlace {
  std::int32_t i = 0;
  std::int32_t j = 0;

  std::uint64_t key() const {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32U | static_cast<std::uint32_t>(j);
  }
  GridPlace operator+(const GridPlace& by) const { return {i + by.i, j + by.j}; }
};

/// A place where the section crosses a side of the grid.
struct Crossing {
  SectionNode node;
  double clearance = 0.0;  ///< distance of the nearest point, in spacings
  std::array<std::uint32_t, 2> next{};
  std::uint8_t links = 0;
};

/// Follows the zero line of the field through the cells of a grid (marching squares; Lorensen and Cline,
/// 1987, in the plane), from cells with points of the scan on, into holes as well.
class ScanCutter {
 public:
  ScanCutter(const FrontScan& scan, double z, double widest_hole)
      : field_(*scan.field),
        z_(z),
        widest_hole_(widest_hole),
        farthest_(0.5 * widest_hole),
        side_(kCell * field_.cloud().spacing) {
    farthest_ = std::max(farthest_, kHole * field_.cloud().spacing);
    for (const std::uint32_t point : scan.points) start_around(point);
    for (std::size_t k = 0; k < cells_.size(); ++k) follow(cells_[k]);
  }

  /// Appends the crossings in chains.
  std::vector<BridgedGap> append(std::uint32_t surface, Section& section) {
    section.cells += visited_.size();
    std::vector<bool> taken(crossings_.size(), false);
    std::vector<std::vector<std::uint32_t>> open;
    std::vector<std::vector<std::uint32_t>> rings;
    // Chains with ends first: what is left are rings.
    for (const bool has_ends : {true, false}) {
      for (std::uint32_t c = 0; c < crossings_.size(); ++c) {
        if (taken[c] || (has_ends && crossings_[c].links != 1)) continue;
        auto chain = has_ends ? trimmed(chain_from(c, taken)) : ring_from(c, taken);
        if (chain.size() > 1) (has_ends ? open : rings).push_back(std::move(chain));
      }
    }
    std::vector<BridgedGap> holes;
    if (open.size() == 1) close_across(open.front(), holes);
    for (auto* chains : {&open, &rings}) {
      for (auto& chain : *chains) emit(chain, surface, section, holes);
    }
    return holes;
  }

 private:
  Vector2 position(const GridPlace& vertex) const { return side_ * Vector2(vertex.i, vertex.j); }

  std::optional<double> height(const GridPlace& vertex) {
    const auto [known, is_new] = heights_.try_emplace(vertex.key());
    if (is_new) {
      const Vector2 at = position(vertex);
      if (const auto value = field_.at({at.x(), at.y(), z_}, farthest_)) known->second = value->distance;
    }
    return known->second;
  }

  /// Cells around a point near the plane, where the section crosses them beside points of the scan.
  void start_around(std::uint32_t point) {
    const Vector3 at = field_.cloud().points[point].cast<double>();
    const double around = kAround * static_cast<double>(field_.cloud().spacings[point]);
    const double away = at.z() - z_;
    if (std::abs(away) > around) return;
    const double reach = std::sqrt(around * around - away * away);
    const auto cell_of = [&](double value) { return static_cast<std::int32_t>(std::floor(value / side_)); };
    for (std::int32_t i = cell_of(at.x() - reach); i <= cell_of(at.x() + reach); ++i) {
      for (std::int32_t j = cell_of(at.y() - reach); j <= cell_of(at.y() + reach); ++j) {
        const GridPlace cell{i, j};
        if (seen_.insert(cell.key()).second && crosses_scanned(cell)) enqueue(cell);
      }
    }
  }

  void enqueue(const GridPlace& cell) {
    if (visited_.insert(cell.key()).second) cells_.push_back(cell);
  }

  struct Side {
    GridPlace from;
    bool along_x = true;

    GridPlace to() const { return from + (along_x ? GridPlace{1, 0} : GridPlace{0, 1}); }
    /// The cell beyond it: for a side of `cell`.
    GridPlace beyond(const GridPlace& cell) const {
      if (along_x) return {cell.i, from.j == cell.j ? cell.j - 1 : cell.j + 1};
      return {from.i == cell.i ? cell.i - 1 : cell.i + 1, cell.j};
    }
  };

  /// Sides of a cell, counter-clockwise from below.
  static std::array<Side, 4> sides_of(const GridPlace& cell) {
    return {Side{cell, true}, Side{cell + GridPlace{1, 0}, false}, Side{cell + GridPlace{0, 1}, true},
            Side{cell, false}};
  }

  bool is_crossed(const Side& side) {
    const auto from = height(side.from);
    const auto to = height(side.to());
    return from && to && (*from >= 0.0) != (*to >= 0.0);
  }

  bool crosses_scanned(const GridPlace& cell) {
    for (const Side& side : sides_of(cell)) {
      if (!is_crossed(side)) continue;
      const auto crossing = crossing_on(side);
      if (crossing && crossings_[*crossing].clearance <= kHole) return true;
    }
    return false;
  }

  /// The crossing of a side that is crossed; nothing where the field breaks off between its ends.
  std::optional<std::uint32_t> crossing_on(const Side& side) {
    auto& numbers = side.along_x ? on_x_ : on_y_;
    const auto [known, is_new] = numbers.try_emplace(side.from.key());
    if (!is_new) return known->second;
    const Vector2 from = position(side.from);
    const Vector2 way = position(side.to()) - from;
    double low = 0.0;
    double high = 1.0;
    double f_low = *height(side.from);
    double f_high = *height(side.to());
    double part = 0.0;
    bool moved_high = false;
    std::optional<ScanField::Value> value;
    // Illinois (Dowell and Jarratt, 1971).
    for (int step = 0; step < kMostRootSteps; ++step) {
      part = (low * f_high - high * f_low) / (f_high - f_low);
      if (!(part > low && part < high)) part = 0.5 * (low + high);
      const Vector2 at = from + part * way;
      value = field_.at({at.x(), at.y(), z_}, farthest_);
      if (!value) return std::nullopt;
      if (std::abs(value->distance) <= kRootError * side_ || high - low <= kRootError) break;
      const bool moves_high = (value->distance >= 0.0) == (f_high >= 0.0);
      // An end that stays twice counts half.
      if (step > 0 && moves_high == moved_high) (moves_high ? f_low : f_high) *= 0.5;
      (moves_high ? high : low) = part;
      (moves_high ? f_high : f_low) = value->distance;
      moved_high = moves_high;
    }
    Crossing crossing;
    crossing.node.position = from + part * way;
    // Across the normal, the outside on its right.
    const Vector2 tangent(-value->normal.y(), value->normal.x());
    const double length = tangent.norm();
    crossing.node.tangent = length > 1e-6 ? Vector2(tangent / length) : Vector2(Vector2::Zero());
    crossing.clearance = value->clearance / field_.cloud().spacing;
    known->second = static_cast<std::uint32_t>(crossings_.size());
    crossings_.push_back(crossing);
    return known->second;
  }

  void link(std::uint32_t a, std::uint32_t b) {
    crossings_[a].next[crossings_[a].links++] = b;
    crossings_[b].next[crossings_[b].links++] = a;
  }

  /// Links the crossings of a cell, and goes on to the cells beyond them.
  void follow(const GridPlace cell) {
    const std::array<Side, 4> sides = sides_of(cell);
    std::vector<std::uint32_t> found;
    for (const Side& side : sides) {
      if (!height(side.from) || !height(side.to())) return;
    }
    for (const Side& side : sides) {
      if (!is_crossed(side)) continue;
      const auto crossing = crossing_on(side);
      if (!crossing) return;
      found.push_back(*crossing);
    }
    if (found.size() == 2) {
      link(found[0], found[1]);
    } else if (found.size() == 4) {
      // Two lines: the middle tells which corners are on one side with it.
      const Vector2 middle = position(cell) + Vector2::Constant(0.5 * side_);
      const auto value = field_.at({middle.x(), middle.y(), z_}, farthest_);
      const bool joins_first = value && (value->distance >= 0.0) == (*height(cell) >= 0.0);
      // The first corner lies between the last side and the first.
      link(found[0], found[joins_first ? 1 : 3]);
      link(found[2], found[joins_first ? 3 : 1]);
    }
    for (const Side& side : sides) {
      if (is_crossed(side)) enqueue(side.beyond(cell));
    }
  }

  std::vector<std::uint32_t> chain_from(std::uint32_t first, std::vector<bool>& taken) const {
    std::vector<std::uint32_t> chain;
    for (std::optional<std::uint32_t> c = first; c;) {
      taken[*c] = true;
      chain.push_back(*c);
      std::optional<std::uint32_t> next;
      for (std::uint8_t k = 0; k < crossings_[*c].links && !next; ++k) {
        if (!taken[crossings_[*c].next[k]]) next = crossings_[*c].next[k];
      }
      c = next;
    }
    return chain;
  }

  bool is_scanned(std::uint32_t c) const { return crossings_[c].clearance <= kRim; }
  bool is_in_hole(std::uint32_t c) const { return crossings_[c].clearance > kHole; }

  /// Without what runs out beyond the last points: that is no surface.
  std::vector<std::uint32_t> trimmed(std::vector<std::uint32_t> chain) const {
    const auto scanned = [this](std::uint32_t c) { return is_scanned(c); };
    chain.erase(std::find_if(chain.rbegin(), chain.rend(), scanned).base(), chain.end());
    chain.erase(chain.begin(), std::find_if(chain.begin(), chain.end(), scanned));
    return chain;
  }

  /// From a crossing with points on, and back to it; nothing where there are no points.
  std::vector<std::uint32_t> ring_from(std::uint32_t first, std::vector<bool>& taken) const {
    std::vector<std::uint32_t> ring = chain_from(first, taken);
    const auto start =
        std::find_if(ring.begin(), ring.end(), [this](std::uint32_t c) { return is_scanned(c); });
    if (start == ring.end()) return {};
    std::rotate(ring.begin(), start, ring.end());
    ring.push_back(ring.front());
    return ring;
  }

  /// Closes the only chain with ends where these are not farther apart than a hole may be wide.
  void close_across(std::vector<std::uint32_t>& chain, std::vector<BridgedGap>& holes) const {
    const BridgedGap gap{crossings_[chain.back()].node.position, crossings_[chain.front()].node.position};
    double length = 0.0;
    for (std::size_t k = 1; k < chain.size(); ++k)
      length += (crossings_[chain[k]].node.position - crossings_[chain[k - 1]].node.position).norm();
    if (gap.width() > widest_hole_ || length < kClosing * gap.width()) return;
    holes.push_back(gap);
    chain.push_back(chain.front());
  }

  void emit(std::vector<std::uint32_t>& chain, std::uint32_t surface, Section& section,
            std::vector<BridgedGap>& holes) const {
    double along = 0.0;
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const SectionNode& a = crossings_[chain[k - 1]].node;
      const SectionNode& b = crossings_[chain[k]].node;
      along += (b.position - a.position).dot(a.tangent + b.tangent);
    }
    if (along < 0.0) std::reverse(chain.begin(), chain.end());
    SectionArc arc{static_cast<std::uint32_t>(section.nodes.size()), 0, surface, ArcKind::kCrossing, false};
    const auto end_arc = [&](std::size_t nodes) {
      section.nodes.resize(nodes);
      arc.count = static_cast<std::uint32_t>(nodes) - arc.first;
      if (arc.count > 1) section.arcs.push_back(arc);
      arc.first = static_cast<std::uint32_t>(nodes);
    };
    std::size_t rim = section.nodes.size();
    bool in_hole = false;
    for (const std::uint32_t c : chain) {
      in_hole = in_hole || is_in_hole(c);
      if (is_scanned(c)) {
        if (in_hole) {
          const BridgedGap hole{section.nodes[rim].position, crossings_[c].node.position};
          if (hole.width() > widest_hole_) {
            end_arc(rim + 1);
          } else {
            holes.push_back(hole);
          }
        }
        rim = section.nodes.size();
        in_hole = false;
      }
      section.nodes.push_back(crossings_[c].node);
    }
    end_arc(section.nodes.size());
  }

  const ScanField& field_;
  double z_;
  double widest_hole_;
  double farthest_;
  double side_;
  std::unordered_map<std::uint64_t, std::optional<double>> heights_;
  std::unordered_map<std::uint64_t, std::optional<std::uint32_t>> on_x_;
  std::unordered_map<std::uint64_t, std::optional<std::uint32_t>> on_y_;
  std::vector<Crossing> crossings_;
  std::unordered_set<std::uint64_t> seen_;
  std::unordered_set<std::uint64_t> visited_;
  std::vector<GridPlace> cells_;
};

}  // namespace

std::vector<BridgedGap> cut_scan(const FrontScan& scan, std::uint32_t surface, double z, double widest_hole,
                                 Section& section) {
  return ScanCutter(scan, z, widest_hole).append(surface, section);
}

}  // namespace lamina::engine
