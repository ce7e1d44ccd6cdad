#include "engine/grid/meetings.h"

#include <algorithm>
#include <tuple>

#include "engine/geometry/cross_product.h"
#include "engine/geometry/segment_distance.h"
#include "engine/grid/cell_walk.h"

namespace lamina::engine {
namespace {

std::size_t segment_count(const NodeChain& chain) {
  return chain.nodes.size() - (chain.closed ? 0 : 1);
}

const Vector2& segment_end(const NodeChain& chain, std::size_t segment) {
  return chain.nodes[segment + 1 == chain.nodes.size() ? 0 : segment + 1].position;
}

/// Draws a chain: `enter(segment, cell)` for every cell that it enters. Cells that it is in already, because
/// a segment begins where the last one ended, are not entered again.
template <typename Enter>
void draw(const NodeChain& chain, double epsilon, Enter enter) {
  if (chain.nodes.empty()) return;
  const std::size_t count = segment_count(chain);
  const TileCell origin = cell_at(chain.nodes.front().position, epsilon);
  bool begun = false;
  bool left_origin = false;
  TileCell current;
  for (std::size_t s = 0; s < count; ++s) {
    const bool last = chain.closed && s + 1 == count;
    walk_cells(chain.nodes[s].position, segment_end(chain, s), epsilon, [&](TileCell cell) {
      if (begun && cell == current) return;
      begun = true;
      current = cell;
      left_origin = left_origin || !(cell == origin);
      if (last && left_origin && cell == origin) return;
      enter(s, cell);
    });
  }
}

bool segments_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d, double tolerance) {
  const double abc = cross(b - a, c - a);
  const double abd = cross(b - a, d - a);
  const double cda = cross(d - c, a - c);
  const double cdb = cross(d - c, b - c);
  if ((abc > 0.0) != (abd > 0.0) && (cda > 0.0) != (cdb > 0.0)) return true;
  const double limit = tolerance * tolerance;
  return squared_distance(a, c, d) <= limit || squared_distance(b, c, d) <= limit ||
         squared_distance(c, a, b) <= limit || squared_distance(d, a, b) <= limit;
}

}  // namespace

Meetings MeetingFinder::find(const std::vector<NodeChain>& chains, double tolerance) {
  Meetings meetings;
  drawn_.clear();
  std::vector<TileCell> shared;
  for (const NodeChain& chain : chains) {
    draw(chain, epsilon_, [&](std::size_t, TileCell cell) {
      if (drawn_.test_and_set(cell)) shared.push_back(cell);
    });
  }
  if (shared.empty()) return meetings;

  shared_.clear();
  for (const TileCell cell : shared) {
    if (!shared_.test_and_set(cell)) ++meetings.shared_cells;
  }
  entries_.clear();
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    const std::size_t count = segment_count(chains[c]);
    for (std::uint32_t s = 0; s < count; ++s) {
      walk_cells(chains[c].nodes[s].position, segment_end(chains[c], s), epsilon_, [&](TileCell cell) {
        if (shared_.test(cell)) entries_.push_back({cell, c, s});
      });
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.cell.x, a.cell.y, a.chain, a.segment) <
           std::tie(b.cell.x, b.cell.y, b.chain, b.segment);
  });
  for (std::size_t begin = 0; begin < entries_.size();) {
    std::size_t end = begin;
    while (end < entries_.size() && entries_[end].cell == entries_[begin].cell) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        const Entry& a = entries_[i];
        const Entry& b = entries_[j];
        const NodeChain& first = chains[a.chain];
        const NodeChain& second = chains[b.chain];
        if (a.chain == b.chain) {
          const std::size_t count = segment_count(first);
          const std::size_t apart = b.segment - a.segment;
          if (apart <= 1 || (first.closed && apart + 1 >= count)) continue;
        }
        if (segments_meet(first.nodes[a.segment].position, segment_end(first, a.segment),
                          second.nodes[b.segment].position, segment_end(second, b.segment), tolerance)) {
          meetings.chains.emplace_back(a.chain, b.chain);
        } else {
          ++meetings.close_places;
        }
      }
    }
    begin = end;
  }
  std::sort(meetings.chains.begin(), meetings.chains.end());
  meetings.chains.erase(std::unique(meetings.chains.begin(), meetings.chains.end()), meetings.chains.end());
  return meetings;
}

}  // namespace lamina::engine
