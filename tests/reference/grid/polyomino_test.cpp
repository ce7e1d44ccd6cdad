#include "tests/reference/grid/polyomino.h"

#include <random>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/reference/grid/grid_text.h"
#include "tests/reference/grid/separate.h"

namespace lamina::tests {
namespace {

using reference::Cell;
using reference::CellState;
using reference::LayerGrid;

GridText turned(const GridText& rows) {
  GridText result(rows.front().size(), std::string(rows.size(), '.'));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      result[column][rows.size() - 1 - row] = rows[row][column];
    }
  }
  return result;
}

/// The angle tromino and the Z and S tetrominoes whose corner is the middle cell, in each of four rotations
/// (dissertation, figure 6.16).
std::set<GridText> twelve_polyominoes() {
  std::set<GridText> shapes;
  for (GridText shape : {GridText{".o.",  //
                                  ".oo",  //
                                  "..."},
                         GridText{"oo.",  //
                                  ".oo",  //
                                  "..."},
                         GridText{".o.",  //
                                  ".oo",  //
                                  "..o"}}) {
    for (int turn = 0; turn < 4; ++turn) {
      shapes.insert(shape);
      shape = turned(shape);
    }
  }
  return shapes;
}

GridText around(const LayerGrid& grid, Cell centre) {
  GridText rows;
  for (std::ptrdiff_t dy = 1; dy >= -1; --dy) {
    rows.emplace_back();
    for (std::ptrdiff_t dx = -1; dx <= 1; ++dx) {
      rows.back() += grid.state({centre.x + dx, centre.y + dy}) == CellState::kBoundary ? 'o' : '.';
    }
  }
  return rows;
}

GridText thinned(const GridText& rows) {
  LayerGrid grid = grid_from_text(rows);
  reference::eliminate_polyominoes(grid, CellState::kBoundary);
  return text_of(grid);
}

/// A random walk's cells as boundary, a connected blob of at least two cells.
LayerGrid random_blob(std::mt19937& random, int steps) {
  LayerGrid grid({0.0, 0.0}, 1.0, 24, 24);
  std::uniform_int_distribution<std::size_t> direction(0, 7);
  Cell cell{12, 12};
  grid.set(cell, CellState::kBoundary);
  grid.set({13, 12}, CellState::kBoundary);
  for (int k = 0; k < steps; ++k) {
    const Cell next = cell + reference::kMooreNeighbours[direction(random)];
    if (!grid.contains(next)) continue;
    cell = next;
    grid.set(cell, CellState::kBoundary);
  }
  return grid;
}

std::size_t moore_components(const LayerGrid& grid) {
  LayerGrid strong({0.0, 0.0}, 1.0, grid.columns(), grid.rows());
  for (std::ptrdiff_t y = 0; y < grid.rows(); ++y) {
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
      if (grid.state({x, y}) == CellState::kBoundary) strong.set({x, y}, CellState::kStrongPoint);
    }
  }
  return reference::separate(strong).size();
}

}  // namespace

TEST_CASE("each of the twelve polyominoes loses one middle cell", "[polyomino]") {
  const std::set<GridText> shapes = twelve_polyominoes();
  REQUIRE(shapes.size() == 12);
  for (const GridText& shape : shapes) {
    CAPTURE(shape);
    LayerGrid grid = grid_from_text(shape);
    CHECK(reference::eliminate_polyominoes(grid, CellState::kBoundary) == 1);
    // A tetromino has two middle cells and loses the one that the sweep meets first. What is left hangs
    // together.
    CHECK(moore_components(grid) == 1);
    for (std::ptrdiff_t y = 0; y < 3; ++y) {
      for (std::ptrdiff_t x = 0; x < 3; ++x) {
        const Cell cell{x, y};
        if (grid.state(cell) != CellState::kRepairedExterior) continue;
        CHECK(shapes.count(around(grid_from_text(shape), cell)) == 1);
      }
    }
  }
}

TEST_CASE("straight, diagonal and bent lines keep their cells", "[polyomino]") {
  for (const GridText& line : {GridText{"ooooo"}, GridText{"o", "o", "o"}, GridText{"..o", ".o.", "o.."},
                               GridText{"..oo", "oo.."}, GridText{"o..", "o..", ".oo"}}) {
    CHECK(thinned(line) == line);
  }
}

TEST_CASE("a staircase becomes a diagonal", "[polyomino]") {
  CHECK(thinned({"..oo",                       //
                 ".oo.",                       //
                 "oo..",                       //
                 "o..."}) == GridText{"..ro",  //
                                      ".ro.",  //
                                      "ro..",  //
                                      "o..."});
}

TEST_CASE("a rectangle's corners are cut", "[polyomino]") {
  CHECK(thinned({".......",                          //
                 ".ooooo.",                          //
                 ".o...o.",                          //
                 ".o...o.",                          //
                 ".ooooo.",                          //
                 "......."}) == GridText{".......",  //
                                         ".rooor.",  //
                                         ".o...o.",  //
                                         ".o...o.",  //
                                         ".rooor.",  //
                                         "......."});
}

TEST_CASE("floating cells go unless one is all there is", "[polyomino]") {
  CHECK(thinned({".....", "..o..", "....."}) == GridText{".....", "..o..", "....."});
  CHECK(thinned({"o....", ".....", "..ooo"}) == GridText{"r....", ".....", "..ooo"});
  CHECK(thinned({"..ooo", ".....", "o...."}) == GridText{"..ooo", ".....", "r...."});
  CHECK(thinned({"....o", ".....", "o...."}) == GridText{"....r", ".....", "o...."});
}

TEST_CASE("other states are not touched", "[polyomino]") {
  LayerGrid grid = grid_from_text({".i.",  //
                                   ".ii",  //
                                   "#,o"});
  CHECK(reference::eliminate_polyominoes(grid, CellState::kInteriorBoundary) == 1);
  CHECK(text_of(grid) == GridText{".i.",  //
                                  ".ri",  //
                                  "#,o"});
}

TEST_CASE("a sweep over random blobs takes out what the drawings say", "[polyomino]") {
  constexpr unsigned kSeed = 612;
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  const std::set<GridText> shapes = twelve_polyominoes();
  for (int round = 0; round < 200; ++round) {
    LayerGrid grid = random_blob(random, 20 + round);
    LayerGrid expected = grid;
    for (std::ptrdiff_t y = 0; y < grid.rows(); ++y) {
      for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
        const bool matches =
            expected.state({x, y}) == CellState::kBoundary && shapes.count(around(expected, {x, y})) > 0;
        if (matches) expected.set({x, y}, CellState::kRepairedExterior);
      }
    }
    reference::eliminate_polyominoes(grid, CellState::kBoundary);
    REQUIRE(text_of(grid) == text_of(expected));
  }
}

TEST_CASE("random blobs stay in one piece", "[polyomino]") {
  constexpr unsigned kSeed = 1207;
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  for (int round = 0; round < 500; ++round) {
    LayerGrid grid = random_blob(random, 5 + round % 150);
    REQUIRE(moore_components(grid) == 1);
    reference::eliminate_polyominoes(grid, CellState::kBoundary);
    CAPTURE(round);
    REQUIRE(moore_components(grid) == 1);
  }
}

}  // namespace lamina::tests
