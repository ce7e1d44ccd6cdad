#include "tests/reference/grid/planar.h"

#include <catch2/catch.hpp>

#include "tests/reference/grid/boundary.h"
#include "tests/reference/grid/grid_text.h"

namespace lamina::tests {
namespace {

using reference::CellState;
using reference::LayerGrid;
using reference::PlanarCase;

enum class Points { kInPlane, kOnBothSides };

struct Identified {
  PlanarCase planar;
  GridText text;
};

/// Boundary and planar case of a component whose strong cells have points in the plane, or only above and
/// below it.
Identified identified(const GridText& rows, Points points) {
  LayerGrid grid = grid_from_text(rows);
  for (std::ptrdiff_t y = 0; y < grid.rows(); ++y) {
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
      if (points == Points::kInPlane && grid.state({x, y}) == CellState::kStrongPoint)
        grid.set_in_plane({x, y});
    }
  }
  reference::identify_boundary(grid);
  const PlanarCase planar = reference::identify_planar(grid);
  return {planar, text_of(grid)};
}

}  // namespace

TEST_CASE("a filled set of cells in the plane is a face without holes", "[planar]") {
  const Identified face = identified({".......",  //
                                      ".#####.",  //
                                      ".#####.",  //
                                      ".#####.",  //
                                      ".#####.",  //
                                      "......."},
                                     Points::kInPlane);
  CHECK(face.planar == PlanarCase::kWithoutHoles);
  CHECK(face.text == GridText{",,,,,,,",  //
                              ",ooooo,",  //
                              ",opppo,",  //
                              ",opppo,",  //
                              ",ooooo,",  //
                              ",,,,,,,"});
}

TEST_CASE("a face with a hole has an interior boundary around it", "[planar]") {
  const Identified face = identified({"...........",  //
                                      ".#########.",  //
                                      ".#########.",  //
                                      ".#########.",  //
                                      ".###...###.",  //
                                      ".###...###.",  //
                                      ".#########.",  //
                                      ".#########.",  //
                                      ".#########.",  //
                                      "..........."},
                                     Points::kInPlane);
  CHECK(face.planar == PlanarCase::kWithHoles);
  CHECK(face.text == GridText{",,,,,,,,,,,",  //
                              ",ooooooooo,",  //
                              ",opppppppo,",  //
                              ",oppiiippo,",  //
                              ",opi,,,ipo,",  //
                              ",opi,,,ipo,",  //
                              ",oppiiippo,",  //
                              ",opppppppo,",  //
                              ",ooooooooo,",  //
                              ",,,,,,,,,,,"});
}

TEST_CASE("a ring one cell thick is a curve", "[planar]") {
  for (const Points points : {Points::kInPlane, Points::kOnBothSides}) {
    const Identified ring = identified({".......",  //
                                        ".#####.",  //
                                        ".#...#.",  //
                                        ".#...#.",  //
                                        ".#####.",  //
                                        "......."},
                                       points);
    CHECK(ring.planar == PlanarCase::kNone);
    CHECK(ring.text == GridText{",,,,,,,",  //
                                ",ooooo,",  //
                                ",o,,,o,",  //
                                ",o,,,o,",  //
                                ",ooooo,",  //
                                ",,,,,,,"});
  }
}

TEST_CASE("a line of strong cells that is thicker here and there is a false positive", "[planar]") {
  // Strong cells are left inside the boundary, but the fill of the inside reaches the boundary elsewhere.
  for (const Points points : {Points::kInPlane, Points::kOnBothSides}) {
    const Identified thick = identified({".........",  //
                                         ".#######.",  //
                                         ".#######.",  //
                                         ".#####.#.",  //
                                         ".#.....#.",  //
                                         ".#######.",  //
                                         "........."},
                                        points);
    CHECK(thick.planar == PlanarCase::kNone);
    CHECK(thick.text == GridText{",,,,,,,,,",  //
                                 ",ooooooo,",  //
                                 ",o,,,,,o,",  //
                                 ",o,,,,,o,",  //
                                 ",o,,,,,o,",  //
                                 ",ooooooo,",  //
                                 ",,,,,,,,,"});
  }
}

TEST_CASE("a curve two cells wide all around is no narrow face", "[planar]") {
  // The fill of the inside meets strong cells only. That the cells are not in the plane tells the curve from
  // a ring.
  const GridText wide{".........",  //
                      ".#######.",  //
                      ".#######.",  //
                      ".##...##.",  //
                      ".##...##.",  //
                      ".#######.",  //
                      ".#######.",  //
                      "........."};
  const Identified curve = identified(wide, Points::kOnBothSides);
  CHECK(curve.planar == PlanarCase::kNone);
  CHECK(curve.text == GridText{",,,,,,,,,",  //
                               ",ooooooo,",  //
                               ",o,,,,,o,",  //
                               ",o,,,,,o,",  //
                               ",o,,,,,o,",  //
                               ",o,,,,,o,",  //
                               ",ooooooo,",  //
                               ",,,,,,,,,"});
}

TEST_CASE("a thick blob whose cells are not in the plane is no face", "[planar]") {
  CHECK(identified({".....",  //
                    ".###.",  //
                    ".###.",  //
                    ".###.",  //
                    "....."},
                   Points::kOnBothSides)
            .planar == PlanarCase::kNothingInside);
}

TEST_CASE("a line of cells has nothing inside", "[planar]") {
  for (const Points points : {Points::kInPlane, Points::kOnBothSides}) {
    CHECK(identified({".....", ".###.", "....."}, points).planar == PlanarCase::kNothingInside);
    CHECK(identified({"...", ".#.", "..."}, points).planar == PlanarCase::kNothingInside);
  }
}

TEST_CASE("two holes are two interior boundaries", "[planar]") {
  const Identified face = identified({"...........",  //
                                      ".#########.",  //
                                      ".#########.",  //
                                      ".##.###.##.",  //
                                      ".#########.",  //
                                      ".#########.",  //
                                      "..........."},
                                     Points::kInPlane);
  CHECK(face.planar == PlanarCase::kWithHoles);
  CHECK(face.text == GridText{",,,,,,,,,,,",  //
                              ",ooooooooo,",  //
                              ",opipppipo,",  //
                              ",oi,ipi,io,",  //
                              ",opipppipo,",  //
                              ",ooooooooo,",  //
                              ",,,,,,,,,,,"});
}

}  // namespace lamina::tests
