// Where the plane only touches the model, end to end: touch points, open and closed touch curves, planar
// contours, and what must not be taken for any of them.

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/reference/as_engine_layer.h"
#include "tests/reference/contour/contour_curve.h"
#include "tests/reference/reference_slicer.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"

namespace lamina::tests {
namespace {

using engine::Loop;
using engine::Polyline;
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

struct Kinds {
  std::size_t closed, open, planar, points;
  bool operator==(const Kinds&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Kinds& kinds) {
  return out << kinds.closed << " closed, " << kinds.open << " open, " << kinds.planar << " planar, "
             << kinds.points << " points";
}

Kinds kinds_of(const Layer& layer) {
  return {layer.closed.size(), layer.open.size(), layer.planar.size(), layer.points.size()};
}

double loop_area(const engine::PlanarCurve& curve, double epsilon) {
  return std::abs(engine::signed_area(reference::flatten_closed(curve, epsilon / 100.0)));
}

/// A cell stands for its lower left corner: what lies in the cell is at most a diagonal away.
double diagonal(double epsilon) {
  return std::sqrt(2.0) * epsilon;
}

}  // namespace

TEST_CASE("a sphere touches the planes at its bottom and top in a point", "[touch]") {
  const AnalyticModel solid = sphere(place, 4.0);
  for (const double epsilon : {0.1, 0.05}) {
    for (const double z : {solid.box.min().z(), solid.box.max().z()}) {
      CAPTURE(epsilon, z);
      const Layer layer = cut(solid.model, z, epsilon);
      REQUIRE(kinds_of(layer) == Kinds{0, 0, 0, 1});
      CHECK((layer.points.front().position - place.head<2>()).norm() <= diagonal(epsilon));
    }
  }
}

TEST_CASE("a cone touches the plane at its apex in a point", "[touch]") {
  const AnalyticModel solid = cone(place, 4.0, 6.0);
  for (const double epsilon : {0.1, 0.05}) {
    const Layer layer = cut(solid.model, 6.0, epsilon);
    REQUIRE(kinds_of(layer) == Kinds{0, 0, 0, 1});
    CHECK((layer.points.front().position - place.head<2>()).norm() <= diagonal(epsilon));
  }
}

TEST_CASE("a standing torus touches the planes at its bottom and top in a point", "[touch]") {
  const AnalyticModel solid = standing_torus(place, 3.0, 1.0);
  for (const double z : {-4.0, 4.0}) {
    const Layer layer = cut(solid.model, z, 0.05);
    REQUIRE(kinds_of(layer) == Kinds{0, 0, 0, 1});
    CHECK((layer.points.front().position - place.head<2>()).norm() <= diagonal(0.05));
  }
}

TEST_CASE("a cylinder on its side touches the planes in an open curve", "[touch]") {
  const AnalyticModel solid = lying_cylinder(place, 3.0, 7.0);
  for (const double epsilon : {0.1, 0.05}) {
    for (const double z : {-3.0, 3.0}) {
      CAPTURE(epsilon, z);
      const Layer layer = cut(solid.model, z, epsilon);
      REQUIRE(kinds_of(layer) == Kinds{0, 1, 0, 0});
      CHECK(layer.open.front().touch);
      const Polyline line = engine::flatten(layer.open.front().curve, epsilon / 100.0);
      // n cells in a row hold a line of (n - 1) epsilon at least and n epsilon at most.
      CHECK(engine::length(line) == Approx(7.0).margin(epsilon));
      for (const Vector2& point : line) {
        CHECK(std::abs(point.y() - place.y()) <= epsilon);
        CHECK(point.x() >= place.x() - epsilon);
        CHECK(point.x() <= place.x() + 7.0 + epsilon);
      }
    }
  }
}

TEST_CASE("a flat torus touches the planes in a closed curve", "[touch]") {
  const AnalyticModel solid = flat_torus(place, 4.0, 1.5);
  for (const double epsilon : {0.1, 0.05}) {
    for (const double z : {-1.5, 1.5}) {
      CAPTURE(epsilon, z);
      const Layer layer = cut(solid.model, z, epsilon);
      REQUIRE(kinds_of(layer) == Kinds{1, 0, 0, 0});
      CHECK(layer.closed.front().touch);
      const Loop loop = reference::flatten_closed(layer.closed.front().curve, epsilon / 100.0);
      for (const Vector2& point : loop) {
        const double radius = (point - place.head<2>()).norm();
        CHECK(radius == Approx(4.0).margin(diagonal(epsilon) + epsilon));
      }
      CHECK(engine::perimeter(loop) == Approx(2 * pi * 4.0).epsilon(0.01).margin(2 * pi * diagonal(epsilon)));
    }
  }
}

TEST_CASE("faces in the plane are planar contours without holes", "[touch]") {
  for (const double epsilon : {0.1, 0.05}) {
    CAPTURE(epsilon);
    for (const double z : {0.0, 2.0}) {
      const AnalyticModel block = box(place, {6.0, 5.0, 2.0});
      const Layer on_box = cut(block.model, z, epsilon);
      REQUIRE(kinds_of(on_box) == Kinds{0, 0, 1, 0});
      CHECK(on_box.planar.front().inner.empty());
      const Section face = block.section(1.0);
      CHECK(loop_area(on_box.planar.front().outer, epsilon) ==
            Approx(face.area).margin(0.5 * epsilon * face.perimeter).epsilon(0.0));

      const Layer on_disk = cut(upright_cylinder(place, 4.0, 2.0).model, z, epsilon);
      REQUIRE(kinds_of(on_disk) == Kinds{0, 0, 1, 0});
      CHECK(on_disk.planar.front().inner.empty());
      CHECK(loop_area(on_disk.planar.front().outer, epsilon) ==
            Approx(16 * pi).margin(0.5 * epsilon * 8 * pi).epsilon(0.0));
    }
    const Layer under_cone = cut(cone(place, 4.0, 6.0).model, 0.0, epsilon);
    REQUIRE(kinds_of(under_cone) == Kinds{0, 0, 1, 0});
    CHECK(under_cone.planar.front().inner.empty());
  }
}

TEST_CASE("faces with a hole are planar contours with one inner curve", "[touch]") {
  struct Face {
    AnalyticModel solid;
    double outer_area, outer_perimeter, inner_area, inner_perimeter;
  };
  const Face annulus{tube(place, 2.0, 4.0, 2.0), 16 * pi, 8 * pi, 4 * pi, 4 * pi};
  const AnalyticModel plate = box_with_hole(place, {6.0, 5.0, 2.0}, 1.5);
  const Vector2 size = plate.box.sizes().head<2>();
  const Face holed{plate, size.prod(), 2.0 * size.sum(), 2.25 * pi, 3.0 * pi};
  for (const Face& face : {annulus, holed}) {
    for (const double epsilon : {0.1, 0.05}) {
      for (const double z : {0.0, 2.0}) {
        CAPTURE(face.solid.model.name, epsilon, z);
        const Layer layer = cut(face.solid.model, z, epsilon);
        REQUIRE(kinds_of(layer) == Kinds{0, 0, 1, 0});
        REQUIRE(layer.planar.front().inner.size() == 1);
        CHECK(loop_area(layer.planar.front().outer, epsilon) ==
              Approx(face.outer_area).margin(0.5 * epsilon * face.outer_perimeter).epsilon(0.0));
        CHECK(loop_area(layer.planar.front().inner.front(), epsilon) ==
              Approx(face.inner_area).margin(0.5 * epsilon * face.inner_perimeter).epsilon(0.0));
      }
    }
  }
}

TEST_CASE("an upright wall that ends in the plane is a curve, not a face", "[touch]") {
  // A tube without its annuli, and box sides without floor: lines of strong cells and nothing beside them.
  engine::Model wall = tube(place, 2.0, 4.0, 2.0).model;
  wall.surfaces.resize(2);
  const Layer layer = cut(wall, 0.0, 0.05);
  CHECK(kinds_of(layer) == Kinds{2, 0, 0, 0});

  engine::Model sides = box(place, {6.0, 5.0, 2.0}).model;
  sides.surfaces.resize(4);
  CHECK(kinds_of(cut(sides, 0.0, 0.05)) == Kinds{1, 0, 0, 0});
}

TEST_CASE("a wall two cells thick is the planar false positive", "[touch]") {
  // Two box sides stacked one cell apart make a line of strong cells that is thicker than one cell, in the
  // plane all along. It encloses no face.
  const double epsilon = 0.05;
  engine::Model sides = box(place, {6.0, 5.0, 2.0}).model;
  engine::Model inner =
      box(place + Vector3(epsilon, epsilon, 0.0), Vector3(6.0 - epsilon, 5.0 - epsilon, 2.0)).model;
  sides.surfaces.resize(4);
  inner.surfaces.resize(4);
  const Layer layer = cut(united("double wall", {sides, inner}), 0.0, epsilon);
  CHECK(layer.planar.empty());
  CHECK(layer.closed.size() == 1);
}

TEST_CASE("a section is no touch although a floor lies within epsilon of the plane", "[touch]") {
  // Below the plane there are points of the floor all over, above it none beside the wall.
  for (const double epsilon : {0.1, 0.05}) {
    for (const double height : {epsilon, 0.7 * epsilon, 0.4 * epsilon}) {
      CAPTURE(epsilon, height);
      const Layer layer = cut(box_with_hole(place, {6.0, 5.0, 2.0}, 1.5).model, height, epsilon);
      REQUIRE(kinds_of(layer) == Kinds{2, 0, 0, 0});
      for (const reference::ClosedContour& contour : layer.closed) CHECK_FALSE(contour.touch);
    }
  }
}

TEST_CASE("a section through an equator is no touch", "[touch]") {
  // A little off the equator the wall leans, but by so little that all one-sided cells may lie on one side.
  const AnalyticModel solid = sphere(place, 4.0);
  for (const double epsilon : {0.1, 0.05, 0.02}) {
    for (const double z : {-0.2, -0.1, -0.01, 0.0, 0.01, 0.1, 0.2}) {
      CAPTURE(epsilon, z);
      const Layer layer = cut(solid.model, z, epsilon);
      REQUIRE(kinds_of(layer) == Kinds{1, 0, 0, 0});
      CHECK_FALSE(layer.closed.front().touch);
    }
  }
}

TEST_CASE("at a saddle two curves meet in a cell and come apart as closed contours", "[touch]") {
  const AnalyticModel solid = standing_torus(place, 3.0, 1.0);
  for (const double epsilon : {0.05, 0.02}) {
    const double saddle = 2.0;
    const Layer layer = cut(solid.model, saddle, epsilon);
    CAPTURE(epsilon);
    CHECK(layer.open.empty());
    CHECK(layer.planar.empty());
    CHECK((layer.closed.size() == 1 || layer.closed.size() == 2));
    const Section exact = solid.section(saddle + 1e-6);
    // The surface is level at the crossing: the allowance of a leaning wall.
    CHECK(std::abs(parity_area(closed_loops(reference::as_engine_layer(layer), epsilon / 100.0)) -
                   exact.area) <= epsilon * exact.perimeter);
  }
}

}  // namespace lamina::tests
