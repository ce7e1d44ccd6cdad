// From a component's own grid to its contours; grids drawn by hand. Cells are 1 mm wide, the origin is the
// lower left corner.

#include "tests/reference/contour/touch_cases.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/reference/contour/contour_curve.h"
#include "tests/reference/grid/grid_text.h"

namespace lamina::tests {
namespace {

using engine::Vector2;
using reference::ComponentContours;

/// Contours of a drawing; three empty cells are put around it. `in_plane` marks all strong cells as lying in
/// the plane.
ComponentContours contours_of(const GridText& rows, bool touch, bool in_plane) {
  GridText padded(3, std::string(rows.front().size() + 6, '.'));
  for (const std::string& row : rows) padded.push_back("..." + row + "...");
  padded.insert(padded.end(), 3, std::string(rows.front().size() + 6, '.'));
  reference::LayerGrid grid = grid_from_text(padded);
  for (std::ptrdiff_t y = 0; y < grid.rows() && in_plane; ++y) {
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
      if (grid.state({x, y}) == reference::CellState::kStrongPoint) grid.set_in_plane({x, y});
    }
  }
  return reference::make_contours(grid, touch, {1.0, 2});
}

double enclosed(const engine::PlanarCurve& curve) {
  return std::abs(engine::signed_area(reference::flatten_closed(curve, 0.01)));
}

}  // namespace

TEST_CASE("one cell is a touch point at the cell's lower left corner", "[contours]") {
  const ComponentContours contours = contours_of({"#"}, true, true);
  REQUIRE(contours.points.size() == 1);
  CHECK(contours.points.front().position == Vector2(3.0, 3.0));
  CHECK(contours.closed.empty());
  CHECK(contours.open.empty());
  CHECK(contours.planar.empty());
}

TEST_CASE("a line of cells is an open contour and keeps the touch flag", "[contours]") {
  for (const bool touch : {true, false}) {
    const ComponentContours contours = contours_of({"##########"}, touch, true);
    REQUIRE(contours.open.size() == 1);
    CHECK(contours.open.front().touch == touch);
    CHECK(engine::length(engine::flatten(contours.open.front().curve, 0.01)) == Approx(9.0));
    CHECK(contours.closed.empty());
  }
}

TEST_CASE("a ring of cells is a closed contour and keeps the touch flag", "[contours]") {
  for (const bool touch : {true, false}) {
    const ComponentContours contours = contours_of({"..####..",  //
                                                    ".#....#.",  //
                                                    "#......#",  //
                                                    "#......#",  //
                                                    "#......#",  //
                                                    "#......#",  //
                                                    ".#....#.",  //
                                                    "..####.."},
                                                   touch, false);
    REQUIRE(contours.closed.size() == 1);
    CHECK(contours.closed.front().touch == touch);
    CHECK(contours.open.empty());
    CHECK(contours.boundary_cells == 20);
    // The octagon through the cells, 7 x 7 less four corners of two, and a curve within a cell of its 20
    // corners.
    CHECK(enclosed(contours.closed.front().curve) == Approx(41.0).margin(20.0));
  }
}

TEST_CASE("a filled block in the plane is a planar contour", "[contours]") {
  const GridText block(12, "############");
  const ComponentContours contours = contours_of(block, false, true);
  REQUIRE(contours.planar.size() == 1);
  CHECK(contours.planar.front().inner.empty());
  CHECK(contours.closed.empty());
  // Corner to corner 11 x 11 mm, each corner cut by a cell's half.
  CHECK(enclosed(contours.planar.front().outer) == Approx(121.0).margin(0.5 * 44.0));
}

TEST_CASE("a block in the plane with a hole is a planar contour with an inner curve", "[contours]") {
  GridText block(20, std::string(20, '#'));
  for (std::size_t row = 6; row < 14; ++row) block[row].replace(6, 8, "........");
  const ComponentContours contours = contours_of(block, false, true);
  REQUIRE(contours.planar.size() == 1);
  REQUIRE(contours.planar.front().inner.size() == 1);
  // The hole's rim runs through the cells around it: 9 x 9 mm, corners cut.
  CHECK(enclosed(contours.planar.front().inner.front()) == Approx(81.0).margin(0.5 * 36.0));
  CHECK(enclosed(contours.planar.front().outer) == Approx(361.0).margin(0.5 * 76.0));
}

TEST_CASE("a thick wall around nothing solid is the false positive: one closed contour", "[contours]") {
  GridText wall(20, std::string(20, '#'));
  for (std::size_t row = 2; row < 18; ++row) wall[row].replace(2, 16, std::string(16, '.'));
  wall[10][18] = '.';  // one cell thick here
  const ComponentContours contours = contours_of(wall, false, true);
  CHECK(contours.planar.empty());
  CHECK(contours.closed.size() == 1);
}

}  // namespace lamina::tests
