#include "gcode/print_volume.h"

#include <catch2/catch.hpp>

using namespace lamina;
using namespace lamina::gcode;
using engine::Box3;
using engine::Vector3;

TEST_CASE("what fits is accepted, to the last micrometre") {
  const PrintVolume volume;
  CHECK_NOTHROW(check_fit(Box3(Vector3(0, 0, 0), Vector3(220, 220, 250)), volume, "model"));
  CHECK_NOTHROW(check_fit(Box3(), volume, "model"));
  PrintVolume centered;
  centered.origin = BedOrigin::kCenter;
  CHECK_NOTHROW(check_fit(Box3(Vector3(-110, -110, 0), Vector3(110, 110, 250)), centered, "model"));
  CHECK_THROWS_AS(check_fit(Box3(Vector3(0, 0, 0), Vector3(220, 220, 250)), centered, "model"), FitError);
}

TEST_CASE("what sticks out is measured on every side") {
  const PrintVolume volume;
  try {
    check_fit(Box3(Vector3(-1.5, 10, 0), Vector3(100, 230.25, 251)), volume, "model");
    FAIL("accepted");
  } catch (const FitError& error) {
    CHECK(error.excess_low.isApprox(Vector3(1.5, 0, 0)));
    CHECK(error.excess_high.isApprox(Vector3(0, 10.25, 1)));
    CHECK(std::string(error.what()) ==
          "model does not fit the printer: it reaches out by 1.500 mm at the left side, 10.250 mm at the "
          "back side, "
          "1.000 mm at the upper side; " +
              error.hint);
    CHECK(error.hint.find("99.6 %") != std::string::npos);  // 250 / 251
  }
}

TEST_CASE("a part that only stands in the wrong place is told where to go") {
  try {
    check_fit(Box3(Vector3(-10, -10, -2), Vector3(10, 10, 8)), {}, "model");
    FAIL("accepted");
  } catch (const FitError& error) {
    CHECK(error.hint.find("(110.000, 110.000, 2.000)") != std::string::npos);
  }
}

TEST_CASE("a round bed is round") {
  PrintVolume delta;
  delta.shape = BedShape::kCircle;
  delta.origin = BedOrigin::kCenter;
  delta.width = 200.0;
  CHECK_NOTHROW(check_fit(Box3(Vector3(-70, -70, 0), Vector3(70, 70, 100)), delta, "model"));
  CHECK_THROWS_AS(check_fit(Box3(Vector3(-72, -72, 0), Vector3(72, 72, 100)), delta, "model"), FitError);
}
