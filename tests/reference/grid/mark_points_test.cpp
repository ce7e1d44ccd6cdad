#include "tests/reference/grid/mark_points.h"

#include <catch2/catch.hpp>

#include "tests/reference/grid/grid_text.h"

namespace lamina::tests {
namespace {

using engine::Vector3;
using reference::CellState;
using reference::LayerGrid;

constexpr double kEpsilon = 0.1;
constexpr double kPlane = 5.0;
constexpr double kAbove = kPlane + 0.04;
constexpr double kBelow = kPlane - 0.04;

/// One cell, marked by points at these heights.
LayerGrid marked(const std::vector<double>& heights) {
  LayerGrid grid({0.0, 0.0}, kEpsilon, 1, 1);
  std::vector<Vector3> points;
  points.reserve(heights.size());
  for (const double z : heights) points.emplace_back(0.05, 0.05, z);
  reference::mark_points(grid, points, kPlane);
  return grid;
}

CellState state_of(const std::vector<double>& heights) {
  return marked(heights).state({0, 0});
}

GridText joined(const GridText& rows) {
  LayerGrid grid = grid_from_text(rows);
  reference::join_opposite_neighbours(grid);
  return text_of(grid);
}

}  // namespace

TEST_CASE("a cell's state follows from the sides its points lie on", "[mark-points]") {
  CHECK(state_of({}) == CellState::kEmptyPoint);
  CHECK(state_of({kAbove}) == CellState::kAbovePoint);
  CHECK(state_of({kBelow}) == CellState::kBelowPoint);
  CHECK(state_of({kPlane}) == CellState::kStrongPoint);
  CHECK(state_of({kAbove, kAbove}) == CellState::kAbovePoint);
  CHECK(state_of({kBelow, kBelow}) == CellState::kBelowPoint);
  CHECK(state_of({kAbove, kBelow}) == CellState::kStrongPoint);
  CHECK(state_of({kBelow, kAbove}) == CellState::kStrongPoint);
  CHECK(state_of({kPlane, kAbove}) == CellState::kStrongPoint);
  CHECK(state_of({kAbove, kPlane}) == CellState::kStrongPoint);
  CHECK(state_of({kBelow, kPlane}) == CellState::kStrongPoint);
  CHECK(state_of({kAbove, kBelow, kAbove}) == CellState::kStrongPoint);
  CHECK(state_of({kPlane, kBelow, kBelow}) == CellState::kStrongPoint);
}

TEST_CASE("points farther than epsilon from the plane leave no mark", "[mark-points]") {
  CHECK(state_of({kPlane + 0.101, kPlane - 0.101}) == CellState::kEmptyPoint);
  CHECK(state_of({kPlane + 0.099, kPlane - 0.101}) == CellState::kAbovePoint);
  CHECK(state_of({kPlane + 0.101, kPlane - 0.099}) == CellState::kBelowPoint);

  LayerGrid grid({0.0, 0.0}, kEpsilon, 1, 1);
  const std::vector<Vector3> points{
      {0, 0, kPlane + 0.2}, {0, 0, kAbove}, {0, 0, kBelow}, {0, 0, kPlane - 3.0}};
  CHECK(reference::mark_points(grid, points, kPlane) == 2);
}

TEST_CASE("a point within the model tolerance lies in the plane", "[mark-points]") {
  CHECK(marked({kPlane + 0.9e-6}).in_plane({0, 0}));
  CHECK(marked({kPlane - 0.9e-6}).in_plane({0, 0}));
  CHECK_FALSE(marked({kPlane + 1.1e-6}).in_plane({0, 0}));
  CHECK(state_of({kPlane - 0.9e-6}) == CellState::kStrongPoint);
  CHECK(state_of({kPlane - 1.1e-6}) == CellState::kBelowPoint);
}

TEST_CASE("a cell is crossed where points lie more than a quarter of epsilon off on both sides",
          "[mark-points]") {
  CHECK(marked({kAbove, kBelow}).crossed({0, 0}));
  CHECK_FALSE(marked({kAbove, kPlane}).crossed({0, 0}));
  CHECK_FALSE(marked({kAbove, kPlane - 0.02}).crossed({0, 0}));
  CHECK_FALSE(marked({kPlane + 0.02, kBelow}).crossed({0, 0}));
}

TEST_CASE("marks from several patches add up", "[mark-points]") {
  LayerGrid grid({0.0, 0.0}, kEpsilon, 3, 1);
  reference::mark_points(grid, {{0.05, 0.05, kAbove}, {0.15, 0.05, kAbove}}, kPlane);
  reference::mark_points(grid, {{0.15, 0.05, kBelow}, {0.25, 0.05, kBelow}}, kPlane);
  CHECK(text_of(grid) == GridText{"^#v"});
}

TEST_CASE("neighbours on opposite sides become strong", "[mark-points]") {
  CHECK(joined({"^v"}) == GridText{"##"});
  CHECK(joined({"v^"}) == GridText{"##"});
  CHECK(joined({"^",  //
                "v"}) == GridText{"#", "#"});
  CHECK(joined({"v",  //
                "^"}) == GridText{"#", "#"});
}

TEST_CASE("neighbours on the same side, diagonal ones and those of strong cells stay as they are",
          "[mark-points]") {
  for (const GridText& unchanged :
       {GridText{"^^", "^^"}, GridText{"vv", "vv"}, GridText{"^.", ".v"}, GridText{".^", "v."},
        GridText{"^#v"}, GridText{"v#^"}, GridText{"^.v"}, GridText{"...", ".#.", "..."}}) {
    CHECK(joined(unchanged) == unchanged);
  }
}

TEST_CASE("a shallow surface between a row above and a row below gives a line two cells wide",
          "[mark-points]") {
  CHECK(joined({"^^^^",                       //
                "^^^^",                       //
                "vvvv",                       //
                "vvvv"}) == GridText{"^^^^",  //
                                     "####",  //
                                     "####",  //
                                     "vvvv"});
}

TEST_CASE("a step in a shallow line stays connected", "[mark-points]") {
  CHECK(joined({"^^^^^",                        //
                "^^^vv",                        //
                "vvvvv"}) == GridText{"^^^##",  //
                                      "#####",  //
                                      "###vv"});
}

TEST_CASE("a cell has one opposite neighbour to its right and one above", "[mark-points]") {
  // Strong cells do not spread further: the cell in the middle makes both of its neighbours strong, they
  // nobody else.
  CHECK(joined({".v.",                      //
                ".^v",                      //
                "..."}) == GridText{".#.",  //
                                    ".##",  //
                                    "..."});
  CHECK(joined({"^v^v"}) == GridText{"####"});
  CHECK(joined({"^v^"}) == GridText{"##^"});
}

TEST_CASE("joined cells are crossed together", "[mark-points]") {
  LayerGrid grid({0.0, 0.0}, kEpsilon, 2, 1);
  reference::mark_points(grid, {{0.05, 0.05, kAbove}, {0.15, 0.05, kBelow}}, kPlane);
  CHECK_FALSE(grid.crossed({0, 0}));
  reference::join_opposite_neighbours(grid);
  CHECK(grid.crossed({0, 0}));
  CHECK(grid.crossed({1, 0}));
}

}  // namespace lamina::tests
