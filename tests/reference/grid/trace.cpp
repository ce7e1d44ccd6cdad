#include "tests/reference/grid/trace.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace lamina::reference {
namespace {

constexpr std::size_t kShortestLoop = 4;  ///< a cell's four side neighbours, or a block of two by two
constexpr std::size_t kShortestBranch = 4;
constexpr int kWest = 6;  ///< index into kMooreNeighbours

/// Twice the area, in cells, that the chain from `begin` on encloses.
std::ptrdiff_t twice_area(const std::vector<Cell>& cells, std::size_t begin) {
  std::ptrdiff_t sum = 0;
  for (std::size_t i = begin; i < cells.size(); ++i) {
    const Cell a = cells[i];
    const Cell b = cells[i + 1 < cells.size() ? i + 1 : begin];
    sum += a.x * b.y - b.x * a.y;
  }
  return std::abs(sum);
}

/// One connected set of cells, walked as far as it goes.
struct Walk {
  std::vector<CellChain> loops;
  std::vector<CellChain> branches;  ///< what hangs on loops
  std::vector<Cell> longest;        ///< the longest walk into a dead end
  std::vector<Cell> visited;
};

class Tracer {
 public:
  Tracer(const LayerGrid& grid, CellState line)
      : grid_(grid),
        line_(line),
        marks_(static_cast<std::size_t>(grid.columns() * grid.rows()), kUnvisited) {}

  bool unvisited(Cell cell) const { return grid_.state(cell) == line_ && mark(cell) == kUnvisited; }

  void forget(const std::vector<Cell>& cells) {
    for (const Cell cell : cells) mark(cell) = kUnvisited;
  }

  Walk walk(Cell start) {
    Walk walk;
    push(start, kWest, walk);
    while (!path_.empty()) {
      if (const std::optional<int> direction = next_direction()) {
        end_branch(walk);
        push(path_.back().cell + kMooreNeighbours[*direction], (*direction + 4) % 8, walk);
      } else if (const std::optional<std::size_t> first = loop_start(walk)) {
        close_loop(*first, walk);
      } else {
        step_back(walk);
      }
    }
    end_branch(walk);
    return walk;
  }

 private:
  static constexpr std::int32_t kUnvisited = -1;
  static constexpr std::int32_t kLeft = -2;  ///< visited and no longer on the path

  struct Step {
    Cell cell;
    int came_from;  ///< neighbour index of the step before
    bool on_loop;   ///< already part of a loop
  };

  std::int32_t& mark(Cell cell) {
    return marks_[static_cast<std::size_t>(cell.y * grid_.columns() + cell.x)];
  }
  std::int32_t mark(Cell cell) const {
    return marks_[static_cast<std::size_t>(cell.y * grid_.columns() + cell.x)];
  }

  void push(Cell cell, int came_from, Walk& walk) {
    mark(cell) = static_cast<std::int32_t>(path_.size());
    path_.push_back({cell, came_from, false});
    walk.visited.push_back(cell);
  }

  std::optional<int> next_direction() const {
    for (int turn = 1; turn <= 8; ++turn) {
      const int direction = (path_.back().came_from + turn) % 8;
      if (unvisited(path_.back().cell + kMooreNeighbours[direction])) return direction;
    }
    return std::nullopt;
  }

  std::vector<Cell> path_cells(std::size_t first) const {
    std::vector<Cell> cells;
    for (std::size_t i = first; i < path_.size(); ++i) cells.push_back(path_[i].cell);
    return cells;
  }

  /// The earliest step beside the last one such that the path between encloses something; a block of two by
  /// two counts only where it is all there is.
  std::optional<std::size_t> loop_start(const Walk& walk) const {
    if (path_.size() < kShortestLoop) return std::nullopt;
    std::optional<std::size_t> first;
    for (const Cell offset : kMooreNeighbours) {
      const Cell neighbour = path_.back().cell + offset;
      if (grid_.state(neighbour) != line_ || mark(neighbour) < 0) continue;
      const auto step = static_cast<std::size_t>(mark(neighbour));
      if (step + kShortestLoop <= path_.size() && (!first || step < *first)) first = step;
    }
    if (!first) return std::nullopt;
    const bool whole = path_.size() == walk.visited.size() && *first == 0;
    return twice_area(path_cells(*first), 0) >= (whole ? 2 : 4) ? first : std::nullopt;
  }

  void close_loop(std::size_t first, Walk& walk) {
    end_branch(walk);
    walk.loops.push_back({path_cells(first), true});
    while (path_.size() > first + 1) leave();
    path_.back().on_loop = true;
  }

  void step_back(Walk& walk) {
    if (walk.loops.empty() && path_.size() > walk.longest.size()) walk.longest = path_cells(0);
    if (path_.back().on_loop) {
      end_branch(walk);
    } else {
      branch_.push_back(path_.back().cell);
    }
    leave();
  }

  void leave() {
    mark(path_.back().cell) = kLeft;
    path_.pop_back();
  }

  /// What was stepped back over, from its tip to the step that it hangs on.
  void end_branch(Walk& walk) {
    if (branch_.size() >= kShortestBranch) {
      if (!path_.empty()) branch_.push_back(path_.back().cell);
      walk.branches.push_back({branch_, false});
    }
    branch_.clear();
  }

  const LayerGrid& grid_;
  CellState line_;
  std::vector<std::int32_t> marks_;  ///< index of each cell on the path
  std::vector<Step> path_;
  std::vector<Cell> branch_;
};

std::size_t count_cells(const std::vector<CellChain>& chains) {
  std::size_t count = 0;
  for (const CellChain& chain : chains) count += chain.cells.size();
  return count;
}

}  // namespace

TraceResult trace(const LayerGrid& grid, CellState line) {
  TraceResult result;
  Tracer tracer(grid, line);
  for (std::ptrdiff_t y = 0; y < grid.rows(); ++y) {
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
      if (!tracer.unvisited({x, y})) continue;
      Walk walk = tracer.walk({x, y});
      if (walk.loops.empty()) {
        tracer.forget(walk.visited);
        walk = tracer.walk(walk.longest.back());
      }
      std::vector<CellChain> chains = std::move(walk.loops);
      if (chains.empty()) {
        chains.push_back({walk.longest, false});
      } else {
        chains.insert(chains.end(), walk.branches.begin(), walk.branches.end());
      }
      // Cells that two chains share are counted by both, hence the comparison.
      const std::size_t kept = count_cells(chains);
      if (kept < walk.visited.size()) result.dropped_spurs += walk.visited.size() - kept;
      result.chains.insert(result.chains.end(), std::make_move_iterator(chains.begin()),
                           std::make_move_iterator(chains.end()));
    }
  }
  return result;
}

}  // namespace lamina::reference
