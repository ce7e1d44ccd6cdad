#include "tools/bench/joined_loops.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace lamina::tools {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Number 2k begins line k, 2k + 1 ends it.
const engine::Vector2& place_of(const std::vector<engine::Polyline>& lines, std::size_t end) {
  const engine::Polyline& line = lines[end / 2];
  return end % 2 == 0 ? line.front() : line.back();
}

struct Pair {
  double distance = 0.0;
  std::size_t a = 0;
  std::size_t b = 0;
};

std::vector<Pair> pairs_within(const std::vector<engine::Polyline>& lines, double widest) {
  std::vector<std::size_t> by_x(2 * lines.size());
  for (std::size_t end = 0; end < by_x.size(); ++end) by_x[end] = end;
  std::sort(by_x.begin(), by_x.end(),
            [&](std::size_t a, std::size_t b) { return place_of(lines, a).x() < place_of(lines, b).x(); });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < by_x.size(); ++i) {
    for (std::size_t j = i + 1; j < by_x.size(); ++j) {
      const engine::Vector2 apart = place_of(lines, by_x[j]) - place_of(lines, by_x[i]);
      if (apart.x() > widest) break;
      if (apart.norm() <= widest)
        pairs.push_back({apart.norm(), std::min(by_x[i], by_x[j]), std::max(by_x[i], by_x[j])});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
    return std::tie(p.distance, p.a, p.b) < std::tie(q.distance, q.a, q.b);
  });
  return pairs;
}

}  // namespace

JoinedLoops joined_loops(const std::vector<engine::Polyline>& lines, double widest_gap) {
  JoinedLoops joined;
  std::vector<std::size_t> partner(2 * lines.size(), kNone);
  for (const Pair& pair : pairs_within(lines, widest_gap)) {
    if (partner[pair.a] != kNone || partner[pair.b] != kNone) continue;
    partner[pair.a] = pair.b;
    partner[pair.b] = pair.a;
    joined.widest_gap = pair.distance;
  }
  std::vector<bool> used(lines.size(), false);
  const auto follow = [&](std::size_t first_end) {
    engine::Loop loop;
    std::size_t end = first_end;
    while (end != kNone && !used[end / 2]) {
      used[end / 2] = true;
      const engine::Polyline& line = lines[end / 2];
      if (end % 2 == 0) {
        loop.insert(loop.end(), line.begin(), line.end());
      } else {
        loop.insert(loop.end(), line.rbegin(), line.rend());
      }
      end = partner[end ^ 1U];
    }
    return loop;
  };
  for (std::size_t end = 0; end < partner.size(); ++end) {
    if (partner[end] != kNone || used[end / 2]) continue;
    joined.open.push_back(follow(end));
  }
  for (std::size_t line = 0; line < lines.size(); ++line) {
    if (!used[line]) joined.loops.push_back(follow(2 * line));
  }
  return joined;
}

}  // namespace lamina::tools
