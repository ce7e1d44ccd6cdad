#include "transport/session/command_filter.h"

#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "transport/protocol/command_words.h"
#include "transport/session/curve_chords.h"

using namespace lamina::transport;

namespace {

double distance_to_segment(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double t = std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

double distance_to_chords(const PlanePoint& p, const PlanePoint& start, const std::vector<PlanePoint>& ends) {
  double nearest = 1e9;
  PlanePoint from = start;
  for (const PlanePoint& end : ends) {
    nearest = std::min(nearest, distance_to_segment(p, from, end));
    from = end;
  }
  return nearest;
}

std::vector<std::string> filtered(CommandFilter& filter, std::initializer_list<const char*> lines) {
  std::vector<std::string> commands;
  for (const char* line : lines) {
    for (std::string& command : filter.push(line)) commands.push_back(std::move(command));
  }
  return commands;
}

MachineState state_after(const std::vector<std::string>& commands) {
  MachineState state;
  for (const std::string& command : commands) state = after(std::move(state), command);
  return state;
}

CommandFilter without_arcs() {
  CommandFilter filter;
  FirmwareDialect dialect;
  dialect.arcs = dialect.bezier = dialect.progress = false;
  filter.set_dialect(dialect);
  return filter;
}

}  // namespace

TEST_CASE(
    "chords: no point of an arc is farther from them than the tolerance, and they are not needlessly many") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  std::uniform_real_distribution<double> radius(0.05, 100);
  for (int i = 0; i < 300; ++i) {
    const double r = radius(random);
    const double from = angle(random);
    const double to = angle(random);
    const bool clockwise = i % 2 == 0;
    const double tolerance = i % 3 == 0 ? 0.05 : 0.005;
    const PlanePoint start{r * std::cos(from), r * std::sin(from)};
    const PlanePoint end{r * std::cos(to), r * std::sin(to)};
    const auto arc = arc_by_offset(start, end, {-start[0], -start[1]}, clockwise);
    REQUIRE(arc);
    CHECK((arc->sweep < 0) == clockwise);
    // The way round by its definition: counter-clockwise the angle grows from `from` to `to`.
    double expected = std::fmod(to - from + 4 * std::numbers::pi, 2 * std::numbers::pi);
    if (clockwise) expected -= 2 * std::numbers::pi;
    CHECK(arc->sweep == Approx(expected).margin(1e-9));
    const auto ends = chords(*arc, tolerance);
    CHECK(ends.back() == end);
    for (int k = 0; k <= 200; ++k) {
      const double a = from + arc->sweep * k / 200;
      CHECK(distance_to_chords({r * std::cos(a), r * std::sin(a)}, start, ends) <= tolerance * (1 + 1e-9));
    }
    const double step = 2 * std::acos(std::max(-1.0, 1 - tolerance / r));
    CHECK(static_cast<double>(ends.size()) <= std::abs(arc->sweep) / step + 1);
  }
}

TEST_CASE("chords: full circles, radii, and what is no arc") {
  const auto circle = arc_by_offset({10, 0}, {10, 0}, {-10, 0}, false);
  REQUIRE(circle);
  CHECK(circle->sweep == Approx(2 * std::numbers::pi));
  const auto quarter = arc_of_radius({10, 0}, {0, 10}, 10, false);
  REQUIRE(quarter);
  CHECK(quarter->center[0] == Approx(0).margin(1e-9));
  CHECK(quarter->sweep == Approx(std::numbers::pi / 2));
  const auto long_way = arc_of_radius({10, 0}, {0, 10}, -10, false);
  REQUIRE(long_way);
  CHECK(long_way->sweep == Approx(3 * std::numbers::pi / 2));
  CHECK(long_way->center[0] == Approx(10));
  CHECK_FALSE(arc_by_offset({1, 1}, {2, 2}, {0, 0}, true));
  CHECK_FALSE(arc_of_radius({0, 0}, {10, 0}, 4, true));
  CHECK_FALSE(arc_of_radius({0, 0}, {0, 0}, 4, true));
}

TEST_CASE("chords: a Bezier curve stays within the tolerance") {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> length(-30, 30);
  for (int i = 0; i < 100; ++i) {
    std::array<PlanePoint, 4> bezier{};
    for (PlanePoint& point : bezier) point = {length(random), length(random)};
    const auto ends = chords(bezier, 0.01);
    for (int k = 0; k <= 500; ++k) {
      const double t = k / 500.0;
      const double u = 1 - t;
      PlanePoint p{};
      for (std::size_t axis = 0; axis < 2; ++axis) {
        p[axis] = u * u * u * bezier[0][axis] + 3 * u * u * t * bezier[1][axis] +
                  3 * u * t * t * bezier[2][axis] + t * t * t * bezier[3][axis];
      }
      CHECK(distance_to_chords(p, bezier[0], ends) <= 0.01 + 1e-9);
    }
  }
}

TEST_CASE(
    "filter: arcs become chords where the firmware has none, in every mode, with the same end and filament") {
  for (const std::initializer_list<const char*> modes : {std::initializer_list<const char*>{"G90", "M82"},
                                                         {"G90", "M83"},
                                                         {"G91"},
                                                         {"G20", "G91"},
                                                         {"G20", "G90", "M82"}}) {
    CommandFilter straight = without_arcs();
    CommandFilter curved;
    std::vector<std::string> with_arcs = filtered(curved, {"G28", "G92 X50 Y50 Z1 E3"});
    std::vector<std::string> with_chords = filtered(straight, {"G28", "G92 X50 Y50 Z1 E3"});
    for (const char* mode : modes) {
      for (auto& command : curved.push(mode)) with_arcs.push_back(command);
      for (auto& command : straight.push(mode)) with_chords.push_back(command);
    }
    for (const char* arc :
         {"G3 X1 Y1 I.5 J.7 E.2 F900", "G2 X1.5 Y.5 R2 E.3 Z.1", "G5 X2 Y2 I1 J0 P-1 Q0 E.1"}) {
      for (auto& command : curved.push(arc)) with_arcs.push_back(command);
      const auto chords = straight.push(arc);
      CHECK(chords.size() > 1);
      for (const auto& command : chords) {
        CHECK(command.starts_with("G1 "));
        with_chords.push_back(command);
      }
    }
    const MachineState a = state_after(with_arcs);
    const MachineState b = state_after(with_chords);
    for (std::size_t axis = 0; axis < 3; ++axis)
      CHECK(*a.position[axis] == Approx(*b.position[axis]).margin(3e-4));
    CHECK(a.e_total == Approx(b.e_total).margin(3e-4));
    CHECK(a.feedrate == b.feedrate);
  }
}

TEST_CASE("filter: what the firmware lacks is left out; comments, numbers and M110 are") {
  CommandFilter filter = without_arcs();
  CHECK(filtered(filter, {"M73 P5 R10", "; comment", "M110 N0", "N5 M105*36", ""}) ==
        std::vector<std::string>{"M105"});
  filter.lacks("M300");
  CHECK(filtered(filter, {"M300 S400", "M117 hello"}) == std::vector<std::string>{"M117 hello"});
  CommandFilter all;
  CHECK(filtered(all, {"M73 P5", "G2 X1 Y1 I1 J0"}).size() == 2);
}

TEST_CASE("filter: a skipped object leaves no plastic, and the printer where the file thinks that it is") {
  const auto markers = GENERATE(0, 1, 2);
  const std::array<std::string, 3> begin{"; printing object b", "M486 S1", ";MESH:b"};
  const std::array<std::string, 3> end{"; stop printing object b", "M486 S-1", ";MESH:NONMESH"};
  const bool relative_extruder = GENERATE(false, true);
  const auto at = static_cast<std::size_t>(markers);
  CommandFilter filter;
  filter.skip_object(markers == 1 ? "1" : "b");
  const std::vector<std::string> lines{
      "G28", "G90", relative_extruder ? "M83" : "M82", "G92 E0", "G1 X10 Y10 Z.2 F6000", "G1 E1 F1800",
      // retract, then the object: unretract, print, set E anew, go up, fan, retract more deeply
      relative_extruder ? "G1 E-.8" : "G1 E.2", begin[at], "G1 X50 Y50",
      relative_extruder ? "G1 E.8" : "G1 E1", relative_extruder ? "G1 X60 E2" : "G1 X60 E3", "G92 E0",
      "G1 X50 Z.6 F3000", "M106 S99", relative_extruder ? "G1 E1" : "G1 E1",
      relative_extruder ? "G1 E-1.5" : "G1 E-.5", end[at]};
  std::vector<std::string> commands;
  for (const std::string& line : lines) {
    for (auto& command : filter.push(line)) commands.push_back(std::move(command));
  }
  const MachineState printer = state_after(commands);
  const MachineState& file = filter.state().file;
  CHECK(printer.position == file.position);
  CHECK(printer.e == Approx(file.e));
  CHECK(printer.feedrate == file.feedrate);
  CHECK(printer.extruder_relative == file.extruder_relative);
  CHECK(printer.fans == file.fans);
  // As much is drawn back as the file believes; nothing beyond the 1 mm was pushed out.
  CHECK(printer.e_peak - printer.e_total == Approx(file.e_peak - file.e_total));
  CHECK(printer.e_peak == Approx(1));
  CHECK(file.e_peak > 3);
  // The next object prints on as written.
  CHECK(filter.push("G1 X70 E5") == std::vector<std::string>{"G1 X70 E5"});
}

TEST_CASE("filter: an object may be skipped in its middle, and its state restored elsewhere") {
  CommandFilter filter;
  filtered(filter, {"G90", "M83", "G1 X1 Y1 Z1 F600", "; printing object a", "G1 X2 E1"});
  filter.skip_object("a");
  CHECK(filtered(filter, {"G1 X3 E1"}).empty());
  CommandFilter other;
  other.restore(filter.state());
  const auto here = filter.push("; stop printing object a");
  CHECK(here == other.push("; stop printing object a"));
  CHECK_FALSE(here.empty());
}
