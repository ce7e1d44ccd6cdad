#include "tests/reference/grid/separate.h"

#include <catch2/catch.hpp>

#include "tests/reference/grid/grid_text.h"

namespace lamina::tests {
namespace {

using reference::Cell;
using reference::Component;
using reference::LayerGrid;

std::vector<Component> parts(const GridText& rows) {
  return reference::separate(grid_from_text(rows));
}

}  // namespace

TEST_CASE("cells that meet at a corner belong together", "[separate]") {
  CHECK(parts({"#..",  //
               ".#.",  //
               "..#"})
            .size() == 1);
  CHECK(parts({"..#",  //
               ".#.",  //
               "#.."})
            .size() == 1);
}

TEST_CASE("one empty cell between keeps intersections apart", "[separate]") {
  const std::vector<Component> components = parts({"##.##",  //
                                                   "##.##",  //
                                                   ".....",  //
                                                   "#####"});
  REQUIRE(components.size() == 3);
  // In order of the first cell from the lower left.
  CHECK(components[0].cells.size() == 5);
  CHECK(components[1].cells.front() == Cell{0, 2});
  CHECK(components[2].cells.front() == Cell{3, 2});
}

TEST_CASE("a ring and what lies in it are two intersections", "[separate]") {
  const std::vector<Component> components = parts({"#####",  //
                                                   "#...#",  //
                                                   "#.#.#",  //
                                                   "#...#",  //
                                                   "#####"});
  REQUIRE(components.size() == 2);
  CHECK(components[0].cells.size() == 16);
  CHECK(components[1].cells.size() == 1);
}

TEST_CASE("only strong cells are separated", "[separate]") {
  CHECK(parts({"^v.", "v^."}).empty());
  CHECK(parts({}).empty());
  CHECK(parts({"^#v"}).front().cells.size() == 1);
}

TEST_CASE("what lies beside an intersection tells whether it is a touch", "[separate]") {
  const auto only = [](const GridText& rows) {
    const std::vector<Component> components = parts(rows);
    REQUIRE(components.size() == 1);
    return components.front();
  };
  CHECK(only({"vvv", "v#v", "vvv"}).touch());
  CHECK(only({"^^^", "^#^", "^^^"}).touch());
  CHECK(only({"v..", ".#.", "..."}).touch());  // a corner is enough
  CHECK_FALSE(only({"^^^", "^#v", "vvv"}).touch());
  CHECK_FALSE(only({"^..", ".#.", "..v"}).touch());
  CHECK_FALSE(only({"...", ".#.", "..."}).touch());  // upright: no mark on either side
  CHECK_FALSE(only({"v....", ".....", "..#.."}).touch());
}

TEST_CASE("where the model passes through the plane there is no touch", "[separate]") {
  LayerGrid grid = grid_from_text({"vvv", "v#v", "vvv"});
  grid.set_well_above({1, 1});
  CHECK(reference::separate(grid).front().touch());
  grid.set_well_below({1, 1});
  CHECK_FALSE(reference::separate(grid).front().touch());
}

TEST_CASE("a component moves to its own grid with three empty cells around it", "[separate]") {
  const GridText rows{"#....",  //
                      "...^.",  //
                      "..##.",  //
                      "..#.."};
  LayerGrid layer_grid = grid_from_text(rows);
  layer_grid.set_in_plane({3, 1});
  const std::vector<Component> components = reference::separate(layer_grid);
  REQUIRE(components.size() == 2);
  const LayerGrid grid = reference::component_grid(layer_grid, components[0]);
  CHECK(text_of(grid) == GridText{"........",  //
                                  "........",  //
                                  "........",  //
                                  "...##...",  //
                                  "...#....",  //
                                  "........",  //
                                  "........",  //
                                  "........"});
  CHECK(grid.in_plane({4, 4}));
  CHECK_FALSE(grid.in_plane({3, 4}));
  // A cell stands for the same place in both grids.
  CHECK((grid.location({3, 3}) - layer_grid.location({2, 0})).norm() < 1e-12);
  CHECK(grid.epsilon() == layer_grid.epsilon());
}

}  // namespace lamina::tests
