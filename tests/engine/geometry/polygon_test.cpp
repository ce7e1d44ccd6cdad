#include "engine/geometry/polygon.h"

#include <algorithm>

#include <catch2/catch.hpp>

namespace lamina::tests {

using engine::Loop;

TEST_CASE("a loop's area is positive counter-clockwise and negative clockwise", "[polygon]") {
  Loop triangle{{1, 1}, {4, 1}, {1, 5}};
  CHECK(engine::signed_area(triangle) == Approx(6.0));
  CHECK(engine::perimeter(triangle) == Approx(12.0));
  CHECK(engine::length(triangle) == Approx(8.0));
  std::reverse(triangle.begin(), triangle.end());
  CHECK(engine::signed_area(triangle) == Approx(-6.0));
}

TEST_CASE("holes are taken from a region's area", "[polygon]") {
  const Loop outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Loop hole{{2, 2}, {2, 4}, {5, 4}, {5, 2}};
  const engine::Region region{{outer, {hole}}, {{{20, 0}, {21, 0}, {21, 1}, {20, 1}}, {}}};
  CHECK(engine::area(region) == Approx(95.0));
  CHECK(engine::bounds(region).max() == engine::Vector2(21, 10));
  CHECK(engine::bounds({}).isEmpty());
}

TEST_CASE("an empty loop has neither area nor length", "[polygon]") {
  CHECK(engine::signed_area({}) == 0.0);
  CHECK(engine::perimeter({}) == 0.0);
  CHECK(engine::length({}) == 0.0);
}

}  // namespace lamina::tests
