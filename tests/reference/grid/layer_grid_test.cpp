#include "tests/reference/grid/layer_grid.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

namespace lamina::tests {

using engine::Box2;
using engine::Vector2;
using reference::Cell;
using reference::CellState;
using reference::LayerGrid;

TEST_CASE("a new grid is empty and of the size asked for", "[layer-grid]") {
  const LayerGrid grid({1.0, 2.0}, 0.5, 4, 3);
  CHECK(grid.columns() == 4);
  CHECK(grid.rows() == 3);
  for (std::ptrdiff_t y = 0; y < 3; ++y) {
    for (std::ptrdiff_t x = 0; x < 4; ++x) {
      CHECK(grid.state({x, y}) == CellState::kEmptyPoint);
      CHECK_FALSE(grid.in_plane({x, y}));
      CHECK_FALSE(grid.crossed({x, y}));
    }
  }
}

TEST_CASE("cells outside are outside the grid", "[layer-grid]") {
  const LayerGrid grid({0.0, 0.0}, 1.0, 4, 3);
  for (const Cell cell : {Cell{-1, 0}, Cell{0, -1}, Cell{4, 0}, Cell{0, 3}, Cell{-5, 10}}) {
    CHECK(grid.state(cell) == CellState::kOutsideGrid);
    CHECK_FALSE(grid.contains(cell));
    CHECK_FALSE(grid.in_plane(cell));
    CHECK_FALSE(grid.crossed(cell));
  }
}

TEST_CASE("each cell keeps its own state and marks", "[layer-grid]") {
  LayerGrid grid({0.0, 0.0}, 1.0, 5, 2);
  const CellState states[] = {
      CellState::kEmptyPoint,       CellState::kBelowPoint, CellState::kAbovePoint,
      CellState::kStrongPoint,      CellState::kExterior,   CellState::kBoundary,
      CellState::kInteriorBoundary, CellState::kPlanar,     CellState::kRepairedExterior};
  for (std::ptrdiff_t k = 0; k < 9; ++k) grid.set({k % 5, k / 5}, states[k]);
  grid.set_in_plane({2, 1});
  for (std::ptrdiff_t k = 0; k < 9; ++k) {
    CHECK(grid.state({k % 5, k / 5}) == states[k]);
    CHECK(grid.in_plane({k % 5, k / 5}) == (k == 7));
  }
  grid.set({2, 1}, CellState::kExterior);
  CHECK(grid.in_plane({2, 1}));
}

TEST_CASE("a cell is crossed by points well above and well below, its own or a neighbour's", "[layer-grid]") {
  LayerGrid grid({0.0, 0.0}, 1.0, 3, 1);
  grid.set_well_above({0, 0});
  CHECK_FALSE(grid.crossed({0, 0}));
  grid.set_well_below({1, 0});
  CHECK_FALSE(grid.crossed({1, 0}));
  grid.share_crossing({0, 0}, {1, 0});
  CHECK(grid.crossed({0, 0}));
  CHECK(grid.crossed({1, 0}));
  CHECK_FALSE(grid.crossed({2, 0}));
  CHECK(grid.state({0, 0}) == CellState::kEmptyPoint);
}

TEST_CASE("a point falls into the cell whose square it lies in", "[layer-grid]") {
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  std::uniform_real_distribution<double> place(-3.0, 5.0);
  const LayerGrid grid = LayerGrid::covering(Box2(Vector2(-3.0, -3.0), Vector2(5.0, 5.0)), 0.07);
  for (int k = 0; k < 2000; ++k) {
    const Vector2 point(place(random), place(random));
    const Cell cell = grid.cell_at(point);
    REQUIRE(grid.contains(cell));
    const Vector2 corner = grid.location(cell);
    CHECK(point.x() >= corner.x() - 1e-12);
    CHECK(point.y() >= corner.y() - 1e-12);
    CHECK(point.x() < corner.x() + 0.07 + 1e-12);
    CHECK(point.y() < corner.y() + 0.07 + 1e-12);
  }
}

TEST_CASE("a covering grid has a cell for every point of the box, its edges included", "[layer-grid]") {
  for (const double epsilon : {0.1, 0.05, 0.3, 0.01}) {
    const Box2 box(Vector2(-1.0, 0.2), Vector2(2.0, 3.2));  // a whole number of cells for most
    const LayerGrid grid = LayerGrid::covering(box, epsilon);
    for (const Vector2& point :
         {Vector2(box.min()), Vector2(box.max()), Vector2(-1.0, 3.2), Vector2(2.0, 0.2)}) {
      CHECK(grid.contains(grid.cell_at(point)));
    }
    // ceil(size / epsilon), dissertation p. 136, of the box grown by the model tolerance on each side.
    CHECK(static_cast<double>(grid.columns()) == std::ceil((3.0 + 2e-6) / epsilon));
    CHECK(static_cast<double>(grid.rows()) == std::ceil((3.0 + 2e-6) / epsilon));
  }
}

TEST_CASE("a point on a cell's edge falls into one cell whichever way it was rounded", "[layer-grid]") {
  const LayerGrid grid = LayerGrid::covering(Box2(Vector2(0.0, 0.0), Vector2(10.0, 10.0)), 0.1);
  for (int k = 0; k <= 100; ++k) {
    const double edge = 0.1 * k;
    const Cell low = grid.cell_at({edge * (1.0 - 1e-14) - 1e-14, 5.0});
    const Cell high = grid.cell_at({edge * (1.0 + 1e-14) + 1e-14, 5.0});
    CHECK(low == high);
  }
}

}  // namespace lamina::tests
