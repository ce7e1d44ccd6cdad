#include "tests/reference/grid/seed_fill.h"

#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/reference/grid/boundary.h"
#include "tests/reference/grid/grid_text.h"

namespace lamina::tests {
namespace {

using reference::Cell;
using reference::CellState;
using reference::LayerGrid;
using reference::SeedFill;

struct Filled {
  GridText text;
  SeedFill fill;
};

Filled filled(const GridText& rows, Cell seed, CellState rim) {
  LayerGrid grid = grid_from_text(rows);
  const SeedFill fill = reference::seed_fill(grid, seed, rim);
  return {text_of(grid), fill};
}

GridText boundary_of(const GridText& rows) {
  LayerGrid grid = grid_from_text(rows);
  reference::identify_boundary(grid);
  return text_of(grid);
}

}  // namespace

TEST_CASE("a fill spreads by sides, not by corners, and marks the strong cells beside it", "[seed-fill]") {
  const Filled result = filled({"..#.",  //
                                "..#.",  //
                                "##..",  //
                                "...."},
                               {0, 0}, CellState::kBoundary);
  CHECK(result.text == GridText{"..o,",  //
                                "..o,",  //
                                "oo,,",  //
                                ",,,,"});
  CHECK(result.fill.filled == 8);
  CHECK_FALSE(result.fill.reached_boundary);
}

TEST_CASE("a fill goes around corners and into bays", "[seed-fill]") {
  CHECK(filled({".......",  //
                ".#####.",  //
                ".#...#.",  //
                ".#.#.#.",  //
                ".#.#...",  //
                ".#.###.",  //
                "......."},
               {0, 0}, CellState::kBoundary)
            .text == GridText{",,,,,,,",  //
                              ",ooooo,",  //
                              ",o,,,o,",  //
                              ",o,o,o,",  //
                              ",o,o,,,",  //
                              ",o,ooo,",  //
                              ",,,,,,,"});
}

TEST_CASE("a fill from inside says whether it reached a boundary", "[seed-fill]") {
  const Filled inside = filled({"ooooo",  //
                                "o###o",  //
                                "o#.#o",  //
                                "o###o",  //
                                "ooooo"},
                               {2, 2}, CellState::kInteriorBoundary);
  CHECK(inside.text == GridText{"ooooo",  //
                                "o#i#o",  //
                                "oi,io",  //
                                "o#i#o",  //
                                "ooooo"});
  CHECK_FALSE(inside.fill.reached_boundary);
  CHECK(filled({"ooo",  //
                "o.o",  //
                "ooo"},
               {1, 1}, CellState::kInteriorBoundary)
            .fill.reached_boundary);
}

TEST_CASE("a seed that is not empty fills nothing", "[seed-fill]") {
  const Filled result = filled({"#."}, {0, 0}, CellState::kBoundary);
  CHECK(result.text == GridText{"#."});
  CHECK(result.fill.filled == 0);
}

TEST_CASE("a fill of random cells is the side-connected set around the seed", "[seed-fill]") {
  constexpr unsigned kSeed = 3;
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  std::bernoulli_distribution strong(0.4);
  for (int round = 0; round < 50; ++round) {
    LayerGrid grid({0.0, 0.0}, 1.0, 23, 17);
    for (std::ptrdiff_t y = 0; y < 17; ++y) {
      for (std::ptrdiff_t x = 0; x < 23; ++x) {
        if ((x != 0 || y != 0) && strong(random)) grid.set({x, y}, CellState::kStrongPoint);
      }
    }
    // An independent flood, cell by cell.
    LayerGrid expected = grid;
    std::vector<Cell> open{{0, 0}};
    expected.set({0, 0}, CellState::kExterior);
    while (!open.empty()) {
      const Cell cell = open.back();
      open.pop_back();
      for (const Cell side : reference::kSideNeighbours) {
        const Cell next = cell + side;
        if (expected.state(next) == CellState::kEmptyPoint) {
          expected.set(next, CellState::kExterior);
          open.push_back(next);
        } else if (expected.state(next) == CellState::kStrongPoint) {
          expected.set(next, CellState::kBoundary);
        }
      }
    }
    reference::seed_fill(grid, {0, 0}, CellState::kBoundary);
    CHECK(text_of(grid) == text_of(expected));
  }
}

TEST_CASE("the boundary of a blob are the cells that border the outside by a side", "[boundary]") {
  CHECK(boundary_of({".......",                          //
                     ".####..",                          //
                     ".#####.",                          //
                     ".#####.",                          //
                     "..###..",                          //
                     "......."}) == GridText{",,,,,,,",  //
                                             ",oooo,,",  //
                                             ",o###o,",  //
                                             ",o###o,",  //
                                             ",,ooo,,",  //
                                             ",,,,,,,"});
}

TEST_CASE("the hole of a ring is no outside", "[boundary]") {
  CHECK(boundary_of({".......",                          //
                     ".#####.",                          //
                     ".#####.",                          //
                     ".##.##.",                          //
                     ".#####.",                          //
                     ".#####.",                          //
                     "......."}) == GridText{",,,,,,,",  //
                                             ",ooooo,",  //
                                             ",o###o,",  //
                                             ",o#.#o,",  //
                                             ",o###o,",  //
                                             ",ooooo,",  //
                                             ",,,,,,,"});
}

}  // namespace lamina::tests
