#include "gcode/marlin/gcode_reader.h"

#include <catch2/catch.hpp>

#include "gcode/marlin/time_text.h"

using namespace lamina::gcode;

TEST_CASE("durations and dates read as slicers write them") {
  CHECK(duration_text(0.2) == "0s");
  CHECK(duration_text(59.6) == "1m 0s");
  CHECK(duration_text(4425.0) == "1h 13m 45s");
  CHECK(duration_text(90061.0) == "1d 1h 1m 1s");
  CHECK(timestamp_text(0) == "1970-01-01 at 00:00:00 UTC");
  CHECK(timestamp_text(951782399) == "2000-02-28 at 23:59:59 UTC");
  CHECK(timestamp_text(951868800) == "2000-03-01 at 00:00:00 UTC");
}

TEST_CASE("the reader follows modes, units and positions of foreign files") {
  GcodeReader reader;
  for (const char* line : {"G21", "G90", "M82", "G92 E10", "G1 X10 Y10 Z0.2 F3000", "G1 X20 E11 ; 1 mm",
                           "G1 E8", "G1 E11", "G91", "G1 Y5 E0.5", "G90", "M83", "G92 X0", "G1 X5 E0.25",
                           "G20", "G1 X1 E0.1", "START_PRINT", "G4 P500"}) {
    reader.read(line);
  }
  const GcodeSummary summary = reader.summary();
  CHECK(summary.filament_length == Approx(1.0 + 0.5 + 0.25 + 2.54));
  CHECK(reader.position().x() == Approx(20.0 + 25.4));
  CHECK(reader.position().y() == Approx(15.0));
  CHECK(summary.extrusion_bounds.min().x() == Approx(10.0));
  CHECK(summary.extrusion_bounds.max().x() == Approx(45.4));
  CHECK(summary.layers == 1);
  CHECK(summary.extrusion_length == Approx(10.0 + 5.0 + 5.0 + 20.4));
  CHECK(summary.unreadable_lines == 1);
  REQUIRE(summary.unreadable.size() == 1);
  CHECK(summary.unreadable.front().starts_with("line 17, column 1"));
  CHECK(summary.seconds > 0.5);
}
