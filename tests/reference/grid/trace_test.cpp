#include "tests/reference/grid/trace.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "tests/reference/grid/boundary.h"
#include "tests/reference/grid/grid_text.h"
#include "tests/reference/grid/polyomino.h"

namespace lamina::tests {
namespace {

using reference::Cell;
using reference::CellChain;
using reference::CellState;
using reference::LayerGrid;
using reference::TraceResult;

TraceResult traced(const GridText& rows) {
  return reference::trace(grid_from_text(rows), CellState::kBoundary);
}

bool are_neighbours(Cell a, Cell b) {
  return a != b && std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1;
}

std::set<std::pair<std::ptrdiff_t, std::ptrdiff_t>> places(const CellChain& chain) {
  std::set<std::pair<std::ptrdiff_t, std::ptrdiff_t>> set;
  for (const Cell cell : chain.cells) set.emplace(cell.x, cell.y);
  return set;
}

/// What every chain must be: cells of the line, each once, in walking order.
void check_chain(const CellChain& chain, const LayerGrid& grid) {
  CHECK(places(chain).size() == chain.cells.size());
  for (std::size_t k = 0; k < chain.cells.size(); ++k) {
    CHECK(grid.state(chain.cells[k]) == CellState::kBoundary);
    if (k > 0) CHECK(are_neighbours(chain.cells[k - 1], chain.cells[k]));
  }
  if (chain.closed) CHECK(are_neighbours(chain.cells.front(), chain.cells.back()));
}

}  // namespace

TEST_CASE("a ring is one closed chain, walked clockwise from the lower left", "[trace]") {
  const TraceResult result = traced({".ooo.",  //
                                     "o...o",  //
                                     "o...o",  //
                                     ".ooo."});
  REQUIRE(result.chains.size() == 1);
  CHECK(result.chains[0].closed);
  CHECK(result.chains[0].cells ==
        std::vector<Cell>{{1, 0}, {0, 1}, {0, 2}, {1, 3}, {2, 3}, {3, 3}, {4, 2}, {4, 1}, {3, 0}, {2, 0}});
  CHECK(result.dropped_spurs == 0);
}

TEST_CASE("a figure of eight comes apart into two closed chains", "[trace]") {
  const GridText eight{".o...o.",  //
                       "o.o.o.o",  //
                       "o..o..o",  //
                       "o.o.o.o",  //
                       ".o...o."};
  const TraceResult result = traced(eight);
  REQUIRE(result.chains.size() == 2);
  for (const CellChain& chain : result.chains) {
    CHECK(chain.closed);
    CHECK(chain.cells.size() == 8);
    CHECK(std::count(chain.cells.begin(), chain.cells.end(), Cell{3, 2}) == 1);
    check_chain(chain, grid_from_text(eight));
  }
  CHECK(result.dropped_spurs == 0);
}

TEST_CASE("a line that is entered in its middle is walked from end to end", "[trace]") {
  const TraceResult result = traced({"o.....o",  //
                                     ".o...o.",  //
                                     "..o.o..",  //
                                     "...o..."});
  REQUIRE(result.chains.size() == 1);
  CHECK_FALSE(result.chains[0].closed);
  std::vector<Cell> cells = result.chains[0].cells;
  if (cells.front().x > cells.back().x) std::reverse(cells.begin(), cells.end());
  CHECK(cells == std::vector<Cell>{{0, 3}, {1, 2}, {2, 1}, {3, 0}, {4, 1}, {5, 2}, {6, 3}});
}

TEST_CASE("a straight line is an open chain", "[trace]") {
  for (const GridText& line : {GridText{"oooooo"}, GridText{"o", "o", "o", "o", "o", "o"}}) {
    const TraceResult result = traced(line);
    REQUIRE(result.chains.size() == 1);
    CHECK_FALSE(result.chains[0].closed);
    CHECK(result.chains[0].cells.size() == 6);
    check_chain(result.chains[0], grid_from_text(line));
  }
}

TEST_CASE("a single cell is a chain of one", "[trace]") {
  const TraceResult result = traced({"...", ".o.", "..."});
  REQUIRE(result.chains.size() == 1);
  CHECK(result.chains[0].cells == std::vector<Cell>{{1, 1}});
  CHECK_FALSE(result.chains[0].closed);
}

TEST_CASE("a block of two by two is a closed chain", "[trace]") {
  const TraceResult result = traced({"oo", "oo"});
  REQUIRE(result.chains.size() == 1);
  CHECK(result.chains[0].closed);
  CHECK(result.chains[0].cells.size() == 4);
}

TEST_CASE("a short spur on a ring is dropped and counted", "[trace]") {
  const TraceResult result = traced({"..o....",  //
                                     ".o.o...",  //
                                     "o...ooo",  //
                                     ".o.o...",  //
                                     "..o...."});
  REQUIRE(result.chains.size() == 1);
  CHECK(result.chains[0].closed);
  CHECK(result.dropped_spurs == 2);
  for (const Cell cell : result.chains[0].cells) CHECK(cell.x <= 4);
}

TEST_CASE("a tail on a ring is a chain of its own", "[trace]") {
  const GridText tail{"..o........",  //
                      ".o.o.......",  //
                      "o...ooooooo",  //
                      ".o.o.......",  //
                      "..o........"};
  const TraceResult result = traced(tail);
  REQUIRE(result.chains.size() == 2);
  const auto& ring = result.chains[0].closed ? result.chains[0] : result.chains[1];
  const auto& branch = result.chains[0].closed ? result.chains[1] : result.chains[0];
  CHECK(ring.closed);
  CHECK(ring.cells.size() == 8);
  CHECK_FALSE(branch.closed);
  CHECK(places(branch).count({10, 2}) == 1);
  CHECK(branch.cells.size() >= 6);
  check_chain(ring, grid_from_text(tail));
  check_chain(branch, grid_from_text(tail));
}

TEST_CASE("a tail is found whether the walk begins on it or on the ring", "[trace]") {
  // The first cell from the lower left is the tail's end.
  const GridText tail{".....ooo.",  //
                      "....o...o",  //
                      "....o...o",  //
                      ".....ooo.",  //
                      "....o....",  //
                      "...o.....",  //
                      "..o......",  //
                      ".o.......",  //
                      "o........"};
  const TraceResult result = traced(tail);
  REQUIRE(result.chains.size() == 2);
  CHECK(std::count_if(result.chains.begin(), result.chains.end(),
                      [](const CellChain& c) { return c.closed; }) == 1);
  CHECK(result.dropped_spurs == 0);
}

TEST_CASE("separate lines are separate chains", "[trace]") {
  const TraceResult result = traced({"ooo..oo",  //
                                     ".......",  //
                                     "ooooooo"});
  CHECK(result.chains.size() == 3);
}

TEST_CASE("only cells of the line are walked", "[trace]") {
  const LayerGrid grid = grid_from_text({"ii,",  //
                                         "o,i",  //
                                         "ooi"});
  const TraceResult interior = reference::trace(grid, CellState::kInteriorBoundary);
  REQUIRE(interior.chains.size() == 1);
  CHECK(interior.chains[0].cells.size() == 4);
  CHECK_FALSE(interior.chains[0].closed);
}

TEST_CASE("rings of many sizes and places are one closed chain through all their cells", "[trace]") {
  constexpr unsigned kSeed = 88;
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  std::uniform_real_distribution<double> phase(0.0, 1.0);
  for (int round = 0; round < 60; ++round) {
    // The cells that a circle passes through: their outer rim, thinned.
    const double radius = 3.0 + 0.5 * round;
    const double middle = radius + 3.0 + phase(random);
    const auto size = static_cast<std::ptrdiff_t>(2 * middle + 2);
    LayerGrid grid({0.0, 0.0}, 1.0, size, size);
    for (int k = 0; k < 4000; ++k) {
      const double angle = k * 2 * 3.14159265358979 / 4000;
      grid.set(grid.cell_at({middle + radius * std::cos(angle), middle + radius * std::sin(angle)}),
               CellState::kStrongPoint);
    }
    reference::identify_boundary(grid);
    reference::eliminate_polyominoes(grid, CellState::kBoundary);
    std::size_t cells = 0;
    for (std::ptrdiff_t y = 0; y < size; ++y) {
      for (std::ptrdiff_t x = 0; x < size; ++x) cells += grid.state({x, y}) == CellState::kBoundary ? 1U : 0U;
    }
    const TraceResult result = reference::trace(grid, CellState::kBoundary);
    CAPTURE(radius, middle);
    REQUIRE(result.chains.size() == 1);
    CHECK(result.chains[0].closed);
    CHECK(result.chains[0].cells.size() + result.dropped_spurs == cells);
    CHECK(result.dropped_spurs <= 1);
    check_chain(result.chains[0], grid);
  }
}

TEST_CASE("whatever the cells are, chains are chains and no cell is lost unsaid", "[trace]") {
  constexpr unsigned kSeed = 89;
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  std::bernoulli_distribution filled(0.3);
  for (int round = 0; round < 200; ++round) {
    LayerGrid grid({0.0, 0.0}, 1.0, 15, 15);
    std::size_t cells = 0;
    for (std::ptrdiff_t y = 0; y < 15; ++y) {
      for (std::ptrdiff_t x = 0; x < 15; ++x) {
        if (!filled(random)) continue;
        grid.set({x, y}, CellState::kBoundary);
        ++cells;
      }
    }
    const TraceResult result = reference::trace(grid, CellState::kBoundary);
    std::size_t walked = 0;
    for (const CellChain& chain : result.chains) {
      check_chain(chain, grid);
      walked += chain.cells.size();
    }
    CHECK(walked + result.dropped_spurs >= cells);
  }
}

}  // namespace lamina::tests
