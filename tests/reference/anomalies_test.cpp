// Models that are not the clean boundary of one solid: gaps, overlaps, open sides, several solids.

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/reference/as_engine_layer.h"
#include "tests/reference/reference_slicer.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"

namespace lamina::tests {
namespace {

using engine::Loop;
using engine::NurbsSurface;
using engine::Vector2;
using engine::Vector3;
using reference::Layer;
using reference::ReferenceSlicer;
using reference::SliceOptions;
using std::numbers::pi;

const Vector3 place(0.0123, -0.0371, 0.0);

Layer cut(const engine::Model& model, double z, double epsilon) {
  SliceOptions options;
  options.epsilon = epsilon;
  ReferenceSlicer slicer(model, {{z, z, z}}, options);
  return *slicer.next();
}

/// A cylinder's wall from three patches whose ends are apart by `gap` mm along the wall, or overlap by -gap.
engine::Model wall_of_three(double radius, double gap) {
  const double angle = gap / radius;
  return model_of("wall", {cylinder_patch(place, radius, 0.0, 2.0 - angle, 2.0),
                           cylinder_patch(place, radius, 2.0, 4.0 - angle, 2.0),
                           cylinder_patch(place, radius, 4.0, 2 * pi - angle, 2.0)});
}

void check_circle(const Layer& layer, double radius, double epsilon) {
  REQUIRE(layer.closed.size() == 1);
  CHECK(layer.open.empty());
  const Section circle = circle_section(place.head<2>(), radius);
  const std::vector<Loop> loops = closed_loops(reference::as_engine_layer(layer), epsilon / 100.0);
  CHECK(std::abs(parity_area(loops) - circle.area) <= 0.5 * epsilon * circle.perimeter);
  CHECK(greatest_distance_from(circle, loops) <= (std::sqrt(2.0) + 1.0) * epsilon);
}

}  // namespace

TEST_CASE("gaps below epsilon disappear", "[anomalies]") {
  for (const double epsilon : {0.1, 0.05}) {
    for (const double part : {0.25, 0.5, 0.75, 0.95}) {
      CAPTURE(epsilon, part);
      check_circle(cut(wall_of_three(4.0, part * epsilon), 1.03, epsilon), 4.0, epsilon);
    }
  }
}

TEST_CASE("gaps of three cells and more stay open", "[anomalies]") {
  for (const double epsilon : {0.1, 0.05}) {
    CAPTURE(epsilon);
    const double gap = 3.0 * epsilon;
    const Layer layer = cut(wall_of_three(4.0, gap), 1.03, epsilon);
    CHECK(layer.closed.empty());
    REQUIRE(layer.open.size() == 3);
    double total = 0.0;
    for (const reference::OpenContour& contour : layer.open) {
      CHECK_FALSE(contour.touch);
      total += engine::length(engine::flatten(contour.curve, epsilon / 100.0));
    }
    // Each end is off by a cell's diagonal at most, and one per cent is what the fit may leave of the
    // staircase.
    const double exact = 8 * pi - 3 * gap;
    CHECK(total <= 1.01 * exact + 6 * std::sqrt(2.0) * epsilon);
    CHECK(total >= exact - 6 * std::sqrt(2.0) * epsilon - 2 * pi * epsilon);
  }
}

TEST_CASE("overlapping patches make one curve", "[anomalies]") {
  for (const double epsilon : {0.1, 0.05}) {
    for (const double overlap : {0.3 * epsilon, 2.0 * epsilon, 1.0, 2.0}) {
      CAPTURE(epsilon, overlap);
      check_circle(cut(wall_of_three(4.0, -overlap), 1.03, epsilon), 4.0, epsilon);
    }
  }
}

TEST_CASE("an overlapping patch inside the wall leaves the outer surface", "[anomalies]") {
  // The second patch runs inside the first and third where they overlap: excess points, ignored.
  for (const double epsilon : {0.1, 0.05}) {
    for (const double inside : {0.5 * epsilon, 0.9 * epsilon}) {
      CAPTURE(epsilon, inside);
      const engine::Model wall = model_of(
          "wall", {cylinder_patch(place, 4.0, 0.0, 2.5, 2.0), cylinder_patch(place, 4.0, 2.4, 4.6, 2.0),
                   cylinder_patch(place, 4.0, 4.5, 2 * pi + 0.1, 2.0),
                   cylinder_patch(place, 4.0 - inside, 2.0, 4.0, 2.0)});
      check_circle(cut(wall, 1.03, epsilon), 4.0, epsilon);
    }
  }
}

TEST_CASE("a box without one side has an open contour", "[anomalies]") {
  engine::Model open = box(place, {6.0, 5.0, 2.0}).model;
  open.surfaces.erase(open.surfaces.begin());
  const double exact = (6.0 - place.x()) + 2.0 * (5.0 - place.y());
  for (const double epsilon : {0.1, 0.05}) {
    CAPTURE(epsilon);
    const Layer layer = cut(open, 1.03, epsilon);
    CHECK(layer.closed.empty());
    REQUIRE(layer.open.size() == 1);
    CHECK_FALSE(layer.open.front().touch);
    // Four ends of sides are off by a diagonal, and two corners are cut short by as much as the fit may.
    const double measured = engine::length(engine::flatten(layer.open.front().curve, epsilon / 100.0));
    CHECK(measured == Approx(exact).margin(6.0 * (std::sqrt(2.0) + 1.0) * epsilon).epsilon(0.0));
  }
}

TEST_CASE("two overlapping spheres have the outline of their union", "[anomalies]") {
  const double radius = 3.0;
  const Vector3 apart(3.5, 0.2, 0.1);
  const engine::Model both =
      united("two spheres", {sphere(place, radius).model, sphere(place + apart, radius).model});
  for (const double epsilon : {0.1, 0.05}) {
    for (const double z : {-1.0, 0.05, 0.4, 1.3}) {
      CAPTURE(epsilon, z);
      const Layer layer = cut(both, z, epsilon);
      // The lens of two overlapping walls inside is ignored: the outline alone is a contour.
      REQUIRE(layer.closed.size() == 1);
      CHECK(layer.open.empty());
      const double a = std::sqrt(radius * radius - z * z);
      const double b = std::sqrt(radius * radius - (z - apart.z()) * (z - apart.z()));
      const double d = apart.head<2>().norm();
      // Two circles with radii a and b, centres d apart.
      const double alpha = std::acos((d * d + a * a - b * b) / (2 * d * a));
      const double beta = std::acos((d * d + b * b - a * a) / (2 * d * b));
      const double lens =
          a * a * (alpha - 0.5 * std::sin(2 * alpha)) + b * b * (beta - 0.5 * std::sin(2 * beta));
      const double area = pi * (a * a + b * b) - lens;
      const double perimeter = 2 * (pi - alpha) * a + 2 * (pi - beta) * b;
      const double leaning = 1.0 + std::max(std::abs(z), std::abs(z - apart.z())) / radius;
      const std::vector<Loop> loops = closed_loops(reference::as_engine_layer(layer), epsilon / 100.0);
      CHECK(std::abs(parity_area(loops) - area) <= 0.5 * epsilon * leaning * perimeter);
      CHECK(perimeter_of(loops) <= 1.01 * perimeter + 4 * pi * epsilon);
      CHECK(perimeter_of(loops) >= perimeter - 4 * pi * (std::sqrt(2.0) + 1.0) * epsilon);
    }
  }
}

TEST_CASE("two solids beside each other have a contour each", "[anomalies]") {
  const Layer layer =
      cut(united("two", {sphere(place, 2.0).model, sphere(place + Vector3(4.2, 0.0, 0.0), 2.0).model}), 0.3,
          0.05);
  CHECK(layer.closed.size() == 2);
  CHECK(layer.report.components == 2);
}

TEST_CASE("a cavity has a contour inside the outer one", "[anomalies]") {
  const engine::Model hollow = united("hollow", {sphere(place, 3.0).model, sphere(place, 2.0).model});
  for (const double epsilon : {0.1, 0.05}) {
    for (const double z : {-1.2, 0.0, 0.4}) {
      CAPTURE(epsilon, z);
      const Layer layer = cut(hollow, z, epsilon);
      REQUIRE(layer.closed.size() == 2);
      const Section exact = with_hole(circle_section(place.head<2>(), std::sqrt(9.0 - z * z)),
                                      circle_section(place.head<2>(), std::sqrt(4.0 - z * z)));
      const double leaning = 1.0 + std::abs(z) / 2.0;
      CHECK(std::abs(parity_area(closed_loops(reference::as_engine_layer(layer), epsilon / 100.0)) -
                     exact.area) <= 0.5 * epsilon * leaning * exact.perimeter);
    }
  }
}

TEST_CASE("a wall three cells thick keeps its two sides", "[anomalies]") {
  for (const double epsilon : {0.1, 0.05}) {
    const AnalyticModel pipe = tube(place, 4.0 - 3.0 * epsilon, 4.0, 2.0);
    const Layer layer = cut(pipe.model, 1.03, epsilon);
    CAPTURE(epsilon);
    REQUIRE(layer.closed.size() == 2);
    const Section exact = pipe.section(1.03);
    CHECK(std::abs(parity_area(closed_loops(reference::as_engine_layer(layer), epsilon / 100.0)) -
                   exact.area) <= 0.5 * epsilon * exact.perimeter);
  }
}

}  // namespace lamina::tests
