#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "gcode/motion/look_ahead.h"
#include "gcode/motion/toolpath_time.h"
#include "gcode/motion/trapezoid.h"
#include "gcode/plan/cooling.h"

using namespace lamina;
using namespace lamina::gcode;

namespace {

MachineLimits free_machine() {
  MachineLimits limits;
  limits.max_feedrate = {1e6, 1e6, 1e6, 1e6};
  limits.max_acceleration = {1e9, 1e9, 1e9, 1e9};
  limits.max_jerk = {10.0, 10.0, 0.4, 5.0};
  limits.print_acceleration = limits.travel_acceleration = 1000.0;
  limits.retract_acceleration = 2000.0;
  return limits;
}

double total_time(LookAhead machine, const std::vector<Segment>& segments) {
  double sum = 0.0;
  for (const Segment& segment : segments) {
    if (const auto timed = machine.push(segment)) sum += timed->seconds;
  }
  for (const TimedSegment& timed : machine.finish()) sum += timed.seconds;
  return sum;
}

/// The move's time by stepping along it: at every point as fast as start, end and cruise allow.
double integrated(const Trapezoid& move) {
  const int steps = 200000;
  const double ds = move.length / steps;
  double time = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double s = (i + 0.5) * ds;
    const double up = std::sqrt(move.entry * move.entry + 2.0 * move.acceleration * s);
    const double down = std::sqrt(move.exit * move.exit + 2.0 * move.acceleration * (move.length - s));
    time += ds / std::min({up, down, move.cruise});
  }
  return time;
}

}  // namespace

TEST_CASE("trapezoids take the time of their closed forms") {
  // From rest to rest, long enough: v/a up, v/a down, the rest at v.
  CHECK(duration({100.0, 0.0, 50.0, 0.0, 500.0}) == Approx(2 * 0.1 + (100.0 - 2 * 2.5) / 50.0));
  // A triangle: 2 sqrt(s / a).
  CHECK(duration({4.0, 0.0, 50.0, 0.0, 500.0}) == Approx(2.0 * std::sqrt(4.0 / 500.0)));
  // At cruise speed all the way.
  CHECK(duration({10.0, 20.0, 20.0, 20.0, 500.0}) == Approx(0.5));
  CHECK(duration({0.0, 20.0, 20.0, 20.0, 500.0}) == 0.0);
}

TEST_CASE("trapezoids agree with stepping along them") {
  const unsigned seed = 99;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    Trapezoid move;
    move.cruise = 10.0 + 100.0 * share(random);
    move.entry = move.cruise * (0.05 + 0.9 * share(random));
    move.acceleration = 200.0 + 2000.0 * share(random);
    move.length = 0.5 + 30.0 * share(random);
    const double most = std::min(move.cruise, reachable_speed(move.entry, move.acceleration, move.length));
    const double least =
        std::sqrt(std::max(1.0, move.entry * move.entry - 2.0 * move.acceleration * move.length));
    move.exit = least + (most - least) * share(random);
    CHECK(duration(move) == Approx(integrated(move)).epsilon(1e-3));
  }
}

TEST_CASE("limits of an axis bound the whole move") {
  MachineLimits limits = free_machine();
  limits.max_feedrate.x = 30.0;
  limits.max_acceleration.y = 400.0;
  // At 60 degrees: x takes half of the speed, y 0.866 of the acceleration.
  const double c = 0.5;
  const double s = std::sqrt(3.0) / 2.0;
  const auto block = limited_block({{10 * c, 10 * s, 0, 0}, 100.0, 0.0, 0}, limits);
  REQUIRE(block);
  CHECK(block->length == Approx(10.0));
  CHECK(block->speed == Approx(60.0));
  CHECK(block->acceleration == Approx(400.0 / s));
  CHECK(block->safe_speed == Approx(10.0 / s));
  CHECK_FALSE(limited_block({{0, 0, 0, 0}, 100.0, 0.0, 0}, limits));
}

TEST_CASE("each kind of move has its own acceleration") {
  MachineLimits limits = free_machine();
  limits.print_acceleration = 700.0;
  limits.travel_acceleration = 900.0;
  limits.retract_acceleration = 1100.0;
  CHECK(limited_block({{5, 0, 0, 0.2}, 50, 0, 0}, limits)->acceleration == Approx(700.0));
  CHECK(limited_block({{5, 0, 0, 0}, 50, 0, 0}, limits)->acceleration == Approx(900.0));
  CHECK(limited_block({{0, 0, 0, -3}, 50, 0, 0}, limits)->acceleration == Approx(1100.0));
  CHECK(limited_block({{5, 0, 0, 0.2}, 50, 300, 0}, limits)->acceleration == Approx(300.0));
}

TEST_CASE("junctions change no axis by more than its jerk") {
  const MachineLimits limits = free_machine();
  const auto along = [&](double degrees, double speed) {
    const double angle = degrees * 3.14159265358979 / 180.0;
    return *limited_block({{20 * std::cos(angle), 20 * std::sin(angle), 0, 0}, speed, 0, 0}, limits);
  };
  // Straight on: no slowing down; the slower of both counts.
  CHECK(junction_speed(along(0, 60), along(0, 60), limits.max_jerk) == Approx(60.0));
  CHECK(junction_speed(along(0, 60), along(0, 40), limits.max_jerk) == Approx(40.0));
  // A right angle: x falls from v to 0 and y rises from 0 to v, both by at most 10.
  CHECK(junction_speed(along(0, 60), along(90, 60), limits.max_jerk) == Approx(10.0));
  // A turn back: the axis stops within its jerk and starts again.
  CHECK(junction_speed(along(0, 60), along(180, 60), limits.max_jerk) == Approx(10.0));
  // 30 degrees: y rises by v / 2, x falls by 0.134 v.
  CHECK(junction_speed(along(0, 60), along(30, 60), limits.max_jerk) == Approx(20.0));
  // Slow moves are not slowed down.
  CHECK(junction_speed(along(0, 8), along(90, 8), limits.max_jerk) == Approx(8.0));
}

TEST_CASE("a straight line takes the same time in one piece and in many") {
  const MachineLimits limits = free_machine();
  const double one = total_time(LookAhead(limits), {{{100, 0, 0, 4}, 60, 0, 0}});
  const std::vector<Segment> ten(10, {{10, 0, 0, 0.4}, 60, 0, 0});
  CHECK(total_time(LookAhead(limits), ten) == Approx(one).epsilon(1e-9));
  // By hand: starts at the jerk speed 10, ends in (almost) standing still.
  const double up = (60.0 - 10.0) / 1000.0;
  const double down = (60.0 - 0.05) / 1000.0;
  const double level = (100.0 - 0.5 * (60 + 10) * up - 0.5 * (60 + 0.05) * down) / 60.0;
  CHECK(one == Approx(up + down + level).epsilon(1e-9));
}

TEST_CASE("a square takes four trapezoids between corners at the junction speed") {
  const MachineLimits limits = free_machine();
  const std::vector<Segment> square{{{40, 0, 0, 1}, 50, 0, 0},
                                    {{0, 40, 0, 1}, 50, 0, 0},
                                    {{-40, 0, 0, 1}, 50, 0, 0},
                                    {{0, -40, 0, 1}, 50, 0, 0}};
  const auto side = [](double entry, double exit) {
    const double a = 1000.0;
    const double v = 50.0;
    const double ramps = ((v * v - entry * entry) + (v * v - exit * exit)) / (2 * a);
    return (2 * v - entry - exit) / a + (40.0 - ramps) / v;
  };
  CHECK(total_time(LookAhead(limits), square) == Approx(3 * side(10, 10) + side(10, 0.05)).epsilon(1e-9));
}

TEST_CASE("a short window makes the machine brake earlier") {
  // Tiny pieces of a straight line: with n of them known it must be able to stop within n.
  const MachineLimits limits = free_machine();
  const std::vector<Segment> pieces(400, {{0.05, 0, 0, 0.002}, 100, 0, 0});
  const double blind = total_time(LookAhead(limits, 1), pieces);
  const double usual = total_time(LookAhead(limits, 16), pieces);
  const double far = total_time(LookAhead(limits, 400), pieces);
  CHECK(blind > usual);
  CHECK(usual > far);
  const double one = total_time(LookAhead(limits), {{{20, 0, 0, 0.8}, 100, 0, 0}});
  CHECK(far == Approx(one).epsilon(1e-9));
  // With 16 pieces of 0.05 mm ahead the top speed is sqrt(2 a 0.8 mm) = 40 mm/s.
  CHECK(usual > 20.0 / std::sqrt(2.0 * 1000.0 * 0.8));
}

TEST_CASE("times come back with their tags, all of them, in order") {
  LookAhead machine(free_machine(), 4);
  std::vector<std::size_t> tags;
  for (std::size_t i = 0; i < 20; ++i) {
    if (const auto timed = machine.push({{1, 0.1 * static_cast<double>(i), 0, 0.1}, 50, 0, i})) {
      tags.push_back(timed->tag);
    }
  }
  CHECK(tags.size() == 16);
  for (const TimedSegment& timed : machine.finish()) tags.push_back(timed.tag);
  REQUIRE(tags.size() == 20);
  for (std::size_t i = 0; i < 20; ++i) CHECK(tags[i] == i);
}

namespace {

LayerToolpath zigzag(std::size_t index, double length, double speed) {
  LayerToolpath layer;
  layer.index = index;
  for (int i = 1; i <= 20; ++i) {
    Move move;
    move.end = {i % 2 == 1 ? length : 0.0, 0.4 * i, 0.0};
    move.role = Role::kSolidInfill;
    move.speed = speed;
    move.volume = 0.08 * length;
    layer.moves.push_back(move);
  }
  return layer;
}

}  // namespace

TEST_CASE("short layers are slowed down to the time they need") {
  const FilamentOptions filament;
  const MachineLimits limits;
  CoolingOptions cooling;
  cooling.slow_below_time = 10.0;
  cooling.min_speed = 5.0;
  const LayerToolpath slow =
      cooled(zigzag(9, 10.0, 60.0), engine::Vector3::Zero(), cooling, filament, limits);
  CHECK(layer_time(slow, engine::Vector3::Zero(), filament, limits) == Approx(10.0).epsilon(0.01));
  CHECK(slow.fan == cooling.fan_max);
  // Not below the least speed.
  cooling.min_speed = 30.0;
  const LayerToolpath bounded =
      cooled(zigzag(9, 10.0, 60.0), engine::Vector3::Zero(), cooling, filament, limits);
  for (const Move& move : bounded.moves) CHECK(move.speed == Approx(30.0).epsilon(0.01));
  // Not when there is time enough.
  const LayerToolpath long_layer =
      cooled(zigzag(9, 200.0, 60.0), engine::Vector3::Zero(), cooling, filament, limits);
  for (const Move& move : long_layer.moves) CHECK(move.speed == 60.0);
}

TEST_CASE("the fan follows layer number and layer time") {
  CoolingOptions cooling;
  cooling.fan_min = 0.3;
  cooling.fan_max = 0.9;
  cooling.fan_off_layers = 1;
  cooling.fan_full_layer = 4;
  cooling.slow_below_time = 20.0;
  cooling.fan_below_time = 60.0;
  CHECK(fan_power(0, 5.0, cooling) == 0.0);
  CHECK(fan_power(1, 100.0, cooling) == Approx(0.1));
  CHECK(fan_power(2, 100.0, cooling) == Approx(0.2));
  CHECK(fan_power(3, 100.0, cooling) == Approx(0.3));
  CHECK(fan_power(9, 40.0, cooling) == Approx(0.6));
  CHECK(fan_power(9, 20.0, cooling) == Approx(0.9));
  CHECK(fan_power(9, 1.0, cooling) == Approx(0.9));
  cooling.fan_always = false;
  CHECK(fan_power(9, 100.0, cooling) == 0.0);
}
