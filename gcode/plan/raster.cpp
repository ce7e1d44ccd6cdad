#include "gcode/plan/raster.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>

namespace lamina::gcode {
namespace {

using engine::Loop;
using engine::Polyline;
using engine::Vector2;

/// Where a line meets the boundary.
struct End {
  Vector2 point;
  long line = 0;         ///< Which of the parallel lines.
  std::size_t loop = 0;  ///< Which loop of the polygon.
  std::size_t side = 0;  ///< Side of that loop: from vertex `side` to the next.
  double along = 0.0;    ///< Distance from the loop's first vertex along the loop, mm.
};

/// A way along the boundary from one end to the next one on the same loop.
struct Link {
  std::size_t from = 0;
  std::size_t to = 0;
  double length = 0.0;
  long line = 0;  ///< The lower of the two ends' lines.
};

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

Loop turned(const Loop& loop, double angle) {
  const Eigen::Rotation2Dd rotation(angle);
  Loop result;
  result.reserve(loop.size());
  for (const Vector2& vertex : loop) result.push_back(rotation * vertex);
  return result;
}

/// Ends of every line on one loop, in the order of the loop. A side owns its lower vertex and not its upper
/// one, so that a line through a vertex is counted an even number of times.
std::vector<End> ends_on_loop(const Loop& loop, std::size_t loop_number, const RasterLines& lines) {
  const auto rank = [&](double y) { return (y - lines.phase) / lines.spacing - 0.5; };
  std::vector<End> ends;
  double walked = 0.0;
  for (std::size_t side = 0; side < loop.size(); ++side) {
    const Vector2& a = loop[side];
    const Vector2& b = loop[(side + 1) % loop.size()];
    const long first = static_cast<long>(std::ceil(rank(std::min(a.y(), b.y()))));
    const long last = static_cast<long>(std::ceil(rank(std::max(a.y(), b.y())))) - 1;
    const long count = std::max(0L, last - first + 1);
    for (long i = 0; i < count; ++i) {
      const long line = a.y() < b.y() ? first + i : last - i;
      const double y = lines.phase + (static_cast<double>(line) + 0.5) * lines.spacing;
      const double t = std::clamp((y - a.y()) / (b.y() - a.y()), 0.0, 1.0);
      const Vector2 point(a.x() + t * (b.x() - a.x()), y);
      ends.push_back({point, line, loop_number, side, walked + t * (b - a).norm()});
    }
    walked += (b - a).norm();
  }
  return ends;
}

/// Pairs the ends of each line from left to right: pieces inside the polygon.
std::vector<std::pair<std::size_t, std::size_t>> pieces_of(const std::vector<End>& ends) {
  std::vector<std::size_t> order(ends.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (ends[a].line != ends[b].line) return ends[a].line < ends[b].line;
    return ends[a].point.x() < ends[b].point.x();
  });
  std::vector<std::pair<std::size_t, std::size_t>> pieces;
  for (std::size_t i = 0; i + 1 < order.size(); i += 2) pieces.emplace_back(order[i], order[i + 1]);
  return pieces;
}

/// The chosen link at each end, as the number of the link.
class Chains {
 public:
  explicit Chains(std::size_t pieces) : leader_(pieces) { std::iota(leader_.begin(), leader_.end(), 0); }

  /// Joins the chains of two pieces; false when they are the same chain already.
  bool join(std::size_t a, std::size_t b) {
    const std::size_t first = find(a);
    const std::size_t second = find(b);
    leader_[second] = first;
    return first != second;
  }

 private:
  std::size_t find(std::size_t piece) {
    while (leader_[piece] != piece) piece = leader_[piece] = leader_[leader_[piece]];
    return piece;
  }
  std::vector<std::size_t> leader_;
};

/// Candidates on one loop: from each end to the one after it. Ends of a loop lie together in `ends`.
void append_links(const std::vector<End>& ends, std::size_t begin, std::size_t end, double loop_length,
                  double max_link, std::vector<Link>& links) {
  const std::size_t count = end - begin;
  if (count < 2) return;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = begin + i;
    const std::size_t to = begin + (i + 1) % count;
    double way = ends[to].along - ends[from].along;
    if (way < 0.0) way += loop_length;
    if (way > max_link || ends[from].line == ends[to].line) continue;
    links.push_back({from, to, way, std::min(ends[from].line, ends[to].line)});
  }
}

/// Vertices of the loop passed on the way of a link, in the loop's direction.
Polyline way_between(const Loop& loop, const End& from, const End& to) {
  Polyline way;
  const bool wraps = to.along < from.along;
  std::size_t side = from.side;
  while (side != to.side || (wraps && way.empty())) {
    side = (side + 1) % loop.size();
    way.push_back(loop[side]);
    if (way.size() > loop.size()) break;
  }
  return way;
}

}  // namespace

std::vector<Polyline> raster(const engine::Polygon& polygon, const RasterLines& lines, double max_link) {
  std::vector<Loop> loops{turned(polygon.outer, -lines.angle)};
  for (const Loop& hole : polygon.holes) loops.push_back(turned(hole, -lines.angle));

  std::vector<End> ends;
  std::vector<Link> links;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const std::size_t begin = ends.size();
    const std::vector<End> more = ends_on_loop(loops[i], i, lines);
    ends.insert(ends.end(), more.begin(), more.end());
    append_links(ends, begin, ends.size(), engine::perimeter(loops[i]), max_link, links);
  }

  const auto pieces = pieces_of(ends);
  std::vector<std::size_t> piece_of(ends.size(), kNone);
  for (std::size_t i = 0; i < pieces.size(); ++i) piece_of[pieces[i].first] = piece_of[pieces[i].second] = i;

  // From the lowest line up, so that the links alternate between the two flanks instead of taking the
  // shortest ones first and stranding every third line.
  std::stable_sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
    return a.line != b.line ? a.line < b.line : a.length < b.length;
  });
  std::vector<std::size_t> link_at(ends.size(), kNone);
  Chains chains(pieces.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    if (link_at[link.from] != kNone || link_at[link.to] != kNone) continue;
    if (piece_of[link.from] == kNone || piece_of[link.to] == kNone) continue;
    if (chains.join(piece_of[link.from], piece_of[link.to])) link_at[link.from] = link_at[link.to] = i;
  }

  const Eigen::Rotation2Dd back(lines.angle);
  std::vector<Polyline> result;
  std::vector<bool> used(pieces.size(), false);
  for (std::size_t first = 0; first < pieces.size(); ++first) {
    if (used[first]) continue;
    const auto [left, right] = pieces[first];
    if (link_at[left] != kNone && link_at[right] != kNone) continue;  // the middle of a chain
    Polyline chain;
    std::size_t entry = link_at[left] == kNone ? left : right;
    while (true) {
      const std::size_t piece = piece_of[entry];
      used[piece] = true;
      const std::size_t exit = pieces[piece].first == entry ? pieces[piece].second : pieces[piece].first;
      chain.push_back(back * ends[entry].point);
      chain.push_back(back * ends[exit].point);
      if (link_at[exit] == kNone) break;
      const Link& link = links[link_at[exit]];
      Polyline way = way_between(loops[ends[exit].loop], ends[link.from], ends[link.to]);
      if (link.from != exit) std::reverse(way.begin(), way.end());
      for (const Vector2& vertex : way) chain.push_back(back * vertex);
      entry = link.from == exit ? link.to : link.from;
    }
    result.push_back(std::move(chain));
  }
  return result;
}

}  // namespace lamina::gcode
