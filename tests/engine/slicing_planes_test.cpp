#include "engine/slicing_planes.h"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

namespace lamina::tests {

using engine::make_slicing_planes;
using engine::SlicePlane;
using engine::SlicePosition;

TEST_CASE("there are as many layers as the height holds, rounded up", "[slicing-planes]") {
  for (const double height : {0.05, 0.2, 1.0, 3.3, 10.0, 54.923}) {
    for (const double thickness : {0.1, 0.2, 0.5, 1.0}) {
      const auto planes = make_slicing_planes(2.0, 2.0 + height, {thickness, 0.0, SlicePosition::kBottom});
      CAPTURE(height, thickness);
      CHECK(static_cast<double>(planes.size()) == std::ceil(height / thickness - 1e-6));
    }
  }
}

TEST_CASE("layers lie on one another and the plane lies where it was asked for", "[slicing-planes]") {
  for (const auto& [position, share] :
       {std::pair{SlicePosition::kBottom, 0.0}, std::pair{SlicePosition::kMiddle, 0.5},
        std::pair{SlicePosition::kTop, 1.0}}) {
    const auto planes = make_slicing_planes(-1.0, 3.0, {0.25, 0.0, position});
    REQUIRE(planes.size() == 16);
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const SlicePlane& plane = planes[k];
      CHECK(plane.bottom == Approx(-1.0 + 0.25 * static_cast<double>(k)));
      CHECK(plane.thickness() == Approx(0.25));
      CHECK(plane.z == Approx(plane.bottom + share * 0.25));
      if (k > 0) CHECK(plane.bottom == planes[k - 1].top);
    }
  }
}

TEST_CASE("a first layer of its own thickness shifts the others", "[slicing-planes]") {
  const auto planes = make_slicing_planes(0.0, 1.0, {0.2, 0.3, SlicePosition::kTop});
  REQUIRE(planes.size() ==
          4 + 0);  // 0.3, then 0.2 each up to 0.9; the top of the fifth, 1.1, lies above the model
  CHECK(planes[0].z == Approx(0.3));
  CHECK(planes[1].z == Approx(0.5));
  CHECK(planes[3].top == Approx(0.9));

  const auto middle = make_slicing_planes(0.0, 1.0, {0.2, 0.3, SlicePosition::kMiddle});
  REQUIRE(middle.size() == 5);
  CHECK(middle[0].z == Approx(0.15));
  CHECK(middle[4].z == Approx(1.0));
}

TEST_CASE("a last layer whose plane lies above the model is left out", "[slicing-planes]") {
  CHECK(make_slicing_planes(0.0, 1.05, {0.2, 0.0, SlicePosition::kBottom}).size() == 6);
  CHECK(make_slicing_planes(0.0, 1.05, {0.2, 0.0, SlicePosition::kMiddle}).size() == 5);
  CHECK(make_slicing_planes(0.0, 1.15, {0.2, 0.0, SlicePosition::kMiddle}).size() == 6);
  CHECK(make_slicing_planes(0.0, 1.15, {0.2, 0.0, SlicePosition::kTop}).size() == 5);
}

TEST_CASE("a height that is a whole number of layers but for rounding counts as whole", "[slicing-planes]") {
  for (const double noise : {-1e-9, 0.0, 1e-9}) {
    for (const SlicePosition position :
         {SlicePosition::kBottom, SlicePosition::kMiddle, SlicePosition::kTop}) {
      const double top = 0.1 * 3 * 7 + noise;
      const auto planes = make_slicing_planes(0.0, top, {0.3, 0.0, position});
      CHECK(planes.size() == 7);
      for (const SlicePlane& plane : planes) CHECK(plane.z <= top);
    }
  }
}

TEST_CASE("no plane drifts over thousands of layers", "[slicing-planes]") {
  const auto planes = make_slicing_planes(0.0, 1000.0, {0.1, 0.0, SlicePosition::kTop});
  REQUIRE(planes.size() == 10000);
  CHECK(planes.back().z == Approx(1000.0).epsilon(1e-14));
}

TEST_CASE("thicknesses that make no sense are refused", "[slicing-planes]") {
  CHECK_THROWS_AS(make_slicing_planes(0.0, 1.0, {0.0, 0.0, SlicePosition::kMiddle}), std::invalid_argument);
  CHECK_THROWS_AS(make_slicing_planes(0.0, 1.0, {-0.2, 0.0, SlicePosition::kMiddle}), std::invalid_argument);
  CHECK_THROWS_AS(make_slicing_planes(0.0, 1.0, {std::nan(""), 0.0, SlicePosition::kMiddle}),
                  std::invalid_argument);
  CHECK_THROWS_AS(make_slicing_planes(0.0, 1e6, {1e-3, 0.0, SlicePosition::kMiddle}), std::invalid_argument);
}

}  // namespace lamina::tests
