#include "engine/pointcloud/trim_chords.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/geometry/polygon.h"

namespace lamina::tests {
namespace {

using engine::Loop;
using engine::TrimChords;
using engine::TrimPlace;
using engine::Vector2;

/// A star with `count` corners, far and near in turns; clockwise when `radius` is negative.
Loop star(const Vector2& centre, double radius, int count) {
  Loop loop;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    const double length = std::abs(radius) * (k % 2 == 0 ? 1.0 : 0.6);
    loop.push_back(centre + length * Vector2(std::cos(angle), std::copysign(1.0, radius) * std::sin(angle)));
  }
  return loop;
}

/// Each loop is an edge, a chord's sample its number in the loop.
TrimChords chords_of(const std::vector<Loop>& loops) {
  std::vector<engine::TrimChord> chords;
  for (std::uint32_t edge = 0; edge < loops.size(); ++edge) {
    const Loop& loop = loops[edge];
    for (std::uint32_t k = 0; k < loop.size(); ++k)
      chords.push_back({loop[k], loop[(k + 1) % loop.size()], edge, k});
  }
  return TrimChords(std::move(chords));
}

bool is_inside(const std::vector<Loop>& loops, const Vector2& place) {
  return std::count_if(loops.begin(), loops.end(),
                       [&](const Loop& loop) { return engine::contains(loop, place); }) %
             2 ==
         1;
}

}  // namespace

TEST_CASE("trim chords: inside is what an odd number of loops surrounds", "[trim]") {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> anywhere(-1.5, 1.5);
  for (const int count : {3, 4, 5, 17, 64, 1000}) {
    const std::vector<Loop> loops{star({0, 0}, 1.0, count), star({0.1, -0.05}, -0.4, count),
                                  star({1.2, 0.9}, 0.2, count)};
    const TrimChords chords = chords_of(loops);
    for (int k = 0; k < 1000; ++k) {
      const Vector2 place(anywhere(random), anywhere(random));
      CAPTURE(count, place.x(), place.y());
      REQUIRE(chords.contains(place) == is_inside(loops, place));
    }
  }
  CHECK_FALSE(TrimChords().contains({0, 0}));
}

TEST_CASE("trim chords: boxes are cut, inside or outside", "[trim]") {
  const TrimChords chords = chords_of({star({0, 0}, 1.0, 200), star({0, 0}, -0.2, 100)});
  CHECK(chords.place_of({0.3, 0.3}, {0.35, 0.35}) == TrimPlace::kInside);
  CHECK(chords.place_of({-0.05, -0.05}, {0.05, 0.05}) == TrimPlace::kOutside);
  CHECK(chords.place_of({2, -1}, {3, 1}) == TrimPlace::kOutside);
  CHECK(chords.place_of({0.0, 0.0}, {0.5, 0.1}) == TrimPlace::kCut);
  // Around all of it.
  CHECK(chords.place_of({-2, -2}, {2, 2}) == TrimPlace::kCut);
}

TEST_CASE("trim chords: a line crosses them where each of its sides does", "[trim]") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> anywhere(-1.5, 1.5);
  const std::vector<Loop> loops{star({0, 0}, 1.0, 150), star({0.1, 0.1}, -0.5, 90)};
  const TrimChords chords = chords_of(loops);
  for (const std::size_t count : {2U, 3U, 16U, 17U, 18U, 100U}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<Vector2> line;
      for (std::size_t k = 0; k < count; ++k) line.emplace_back(anywhere(random), anywhere(random));
      const auto crossings = chords.crossings(line);
      CAPTURE(count, repeat);
      for (const engine::TrimCrossing& crossing : crossings) {
        const Vector2 on_line =
            line[crossing.side] + crossing.along * (line[crossing.side + 1] - line[crossing.side]);
        const Loop& loop = loops[crossing.edge];
        const Vector2& a = loop[crossing.sample];
        const Vector2& b = loop[(crossing.sample + 1) % loop.size()];
        REQUIRE((on_line - (a + crossing.on_chord * (b - a))).norm() < 1e-9);
      }
      // In order, and between two of them the line stays on one side.
      bool inside = is_inside(loops, line.front());
      std::size_t next = 0;
      for (std::size_t side = 0; side + 1 < count; ++side) {
        double along = 0.0;
        while (next < crossings.size() && crossings[next].side == side) {
          REQUIRE(crossings[next].along >= along);
          const double middle = 0.5 * (along + crossings[next].along);
          if (crossings[next].along - along > 1e-9)
            REQUIRE(is_inside(loops, line[side] + middle * (line[side + 1] - line[side])) == inside);
          inside = !inside;
          along = crossings[next++].along;
        }
        REQUIRE(is_inside(loops, line[side + 1]) == inside);
      }
      REQUIRE(next == crossings.size());
    }
  }
}

}  // namespace lamina::tests
