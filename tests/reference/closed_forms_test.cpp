// Sections of solids whose area, perimeter and shape are known in closed form, cut end to end by the slicer
// at many heights. What epsilon allows is derived once, in `Allowance`.

#include <cmath>

#include <catch2/catch.hpp>

#include "engine/slicing_planes.h"
#include "tests/reference/as_engine_layer.h"
#include "tests/reference/reference_slicer.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"

namespace lamina::tests {
namespace {

using engine::Loop;
using engine::SlicePosition;
using engine::Vector3;
using reference::Layer;
using reference::ReferenceSlicer;
using reference::SliceOptions;

constexpr double kPlaneAtEnd = 1e-9;  // a plane this near to the model's bottom or top touches it

/// What the method may be off by on a section of closed contours.
struct Allowance {
  double area;
  double distance;
  double shortest;
  double longest;

  Allowance(const Section& exact, double epsilon) {
    // The contour runs through the corners of the outermost cells that the section meets: the centre of such
    // a cell lies within half a cell of the section on average, and that all centres are moved by the same
    // half diagonal changes no area. Where the surface leans, its samples, epsilon / 2 apart, are epsilon / 2
    // * |n_z| apart in the plane: as much of a cell may stay without a sample on the far side, and then the
    // neighbour rule takes the next cell out.
    area = 0.5 * epsilon * (1.0 + exact.normal_z) * exact.perimeter;
    // From a point of the section to the corner of its cell; the fitted curve is within epsilon of that
    // corner.
    distance = (std::sqrt(2.0) + 1.0) * epsilon;
    // A closed curve that stays within d of another is shorter by at most d times that one's turning
    // (parallel curves).
    shortest = exact.perimeter - exact.turning * distance;
    // It runs at most a diagonal outside; the staircase of cells is up to 8.24 % longer than a line (chain
    // code at 22.5 degrees), of which the fit has to leave less than one.
    longest = exact.perimeter * 1.01 + exact.turning * std::sqrt(2.0) * epsilon;
  }
};

/// A section that fits into a few cells, two areas over perimeter being less than one cell (the radius of a
/// circle), may come out as a point, as a short line or as a contour, but not as nothing.
void check_tiny_section(const Layer& layer, const Section& exact, double epsilon) {
  CHECK(layer.closed.size() + layer.open.size() + layer.points.size() == exact.curves);
  CHECK(greatest_distance_from(exact, closed_loops(reference::as_engine_layer(layer), epsilon / 100.0)) <=
        Allowance(exact, epsilon).distance);
}

void check_section(const Layer& layer, const Section& exact, double epsilon) {
  const double z = layer.plane.z;
  CAPTURE(z, epsilon);
  if (2.0 * exact.area / exact.perimeter < epsilon) {
    check_tiny_section(layer, exact, epsilon);
    return;
  }
  CHECK(layer.closed.size() == exact.curves);
  CHECK(layer.open.empty());
  CHECK(layer.planar.empty());
  CHECK(layer.points.empty());
  for (const reference::ClosedContour& contour : layer.closed) CHECK_FALSE(contour.touch);
  CHECK(layer.report.unfitted_curves == 0);

  const Allowance allowed(exact, epsilon);
  const std::vector<Loop> loops = closed_loops(reference::as_engine_layer(layer), epsilon / 100.0);
  REQUIRE_FALSE(loops.empty());
  CHECK(std::abs(parity_area(loops) - exact.area) <= allowed.area);
  CHECK(perimeter_of(loops) >= allowed.shortest);
  CHECK(perimeter_of(loops) <= allowed.longest);
  CHECK(greatest_distance_from(exact, loops) <= allowed.distance);
  CHECK(greatest_distance_to(exact, loops, epsilon) <= allowed.distance);
}

/// Every layer but those at the very bottom and top, where the plane touches. Returns the sum of area times
/// thickness.
double check_layers(const AnalyticModel& solid, const SliceOptions& options, SlicePosition position) {
  ReferenceSlicer slicer(solid.model,
                         engine::make_slicing_planes(solid.box.min().z(), solid.box.max().z(),
                                                     {options.layer_thickness, 0.0, position}),
                         options);
  double volume = 0.0;
  std::size_t sections = 0;
  while (const auto layer = slicer.next()) {
    const double z = layer->plane.z;
    if (z < solid.box.min().z() + kPlaneAtEnd || z > solid.box.max().z() - kPlaneAtEnd) continue;
    check_section(*layer, solid.section(z), options.epsilon);
    volume += parity_area(closed_loops(reference::as_engine_layer(*layer), options.epsilon / 100.0)) *
              layer->plane.thickness();
    ++sections;
  }
  CHECK(sections + 1 >= slicer.layer_count());
  return volume;
}

void check_solid(const AnalyticModel& solid) {
  for (const double epsilon : {0.1, 0.05}) {
    for (const double layer_thickness : {0.2, 0.5}) {
      for (const SlicePosition position :
           {SlicePosition::kBottom, SlicePosition::kMiddle, SlicePosition::kTop}) {
        CAPTURE(solid.model.name, epsilon, layer_thickness, static_cast<int>(position));
        SliceOptions options;
        options.layer_thickness = layer_thickness;
        options.epsilon = epsilon;
        check_layers(solid, options, position);
      }
    }
  }
}

// Off the grid of round numbers, as models are.
const Vector3 place(0.0123, -0.0371, 0.0);

}  // namespace

TEST_CASE("sections of a sphere are circles", "[closed-forms]") {
  check_solid(sphere(place, 4.0));
}

TEST_CASE("sections of an upright cylinder are circles", "[closed-forms]") {
  check_solid(upright_cylinder(place, 4.0, 2.0));
}

TEST_CASE("sections of a cylinder on its side are rectangles", "[closed-forms]") {
  check_solid(lying_cylinder(place, 3.0, 7.0));
}

TEST_CASE("sections of a cone are circles", "[closed-forms]") {
  check_solid(cone(place, 4.0, 6.0));
}

TEST_CASE("sections of a flat torus are rings", "[closed-forms]") {
  check_solid(flat_torus(place, 4.0, 1.5));
}

TEST_CASE("sections of a standing torus are spiric curves", "[closed-forms]") {
  // No plane at the saddles, 2.02 and 6.06 mm above the bottom, where two curves become one.
  check_solid(standing_torus(place, 3.03, 1.01));
}

TEST_CASE("sections of a box are rectangles", "[closed-forms]") {
  check_solid(box(place, {6.0, 5.0, 2.0}));
}

TEST_CASE("sections of a box with a round hole have two contours", "[closed-forms]") {
  check_solid(box_with_hole(place, {6.0, 5.0, 2.0}, 1.5));
}

TEST_CASE("sections of a tube are rings", "[closed-forms]") {
  check_solid(tube(place, 2.0, 4.0, 2.0));
}

TEST_CASE("a solid on round coordinates, where cell edges fall on its faces", "[closed-forms]") {
  check_solid(box(Vector3::Zero(), {6.0, 5.0, 2.0}));
  check_solid(upright_cylinder(Vector3::Zero(), 4.0, 2.0));
  check_solid(sphere(Vector3::Zero(), 4.0));
}

TEST_CASE("sections at arbitrary heights of a tilted place", "[closed-forms]") {
  SliceOptions options;
  for (const AnalyticModel& solid :
       {sphere({3.7, -1.3, 0.71}, 3.3), flat_torus({-2.9, 0.55, 0.3}, 3.1, 0.9)}) {
    for (int k = 1; k < 40; ++k) {
      // The golden ratio's multiples cover the height evenly without repeating a cell's phase.
      const double share = std::fmod(k * 0.6180339887498949, 1.0);
      const double z = solid.box.min().z() + share * solid.box.sizes().z();
      const double from_end = std::min(share, 1.0 - share) * solid.box.sizes().z();
      if (from_end < 2.0 * options.epsilon) continue;
      ReferenceSlicer slicer(solid.model, {{z, z, z}}, options);
      CAPTURE(solid.model.name);
      check_section(*slicer.next(), solid.section(z), options.epsilon);
    }
  }
}

TEST_CASE("sections add up to the volume", "[closed-forms]") {
  SliceOptions options;
  options.layer_thickness = 0.2;
  for (const AnalyticModel& solid : {sphere(place, 4.0), cone(place, 4.0, 6.0), flat_torus(place, 4.0, 1.5),
                                     standing_torus(place, 3.03, 1.01), lying_cylinder(place, 3.0, 7.0),
                                     box_with_hole(place, {6.0, 5.0, 2.0}, 1.5)}) {
    for (const double epsilon : {0.1, 0.05}) {
      CAPTURE(solid.model.name, epsilon);
      options.epsilon = epsilon;
      const double volume = check_layers(solid, options, SlicePosition::kMiddle);
      // Half a cell along the mantle, taken here as the sum of the sections' perimeters, and the midpoint
      // rule's error, which is below two layers' worth of the largest section's change.
      double mantle = 0.0;
      for (double z = solid.box.min().z() + 0.1; z < solid.box.max().z(); z += 0.2) {
        mantle += 0.2 * solid.section(z).perimeter;
      }
      CHECK(std::abs(volume - solid.volume) <= 0.5 * epsilon * mantle + 0.01 * solid.volume);
    }
  }
}

TEST_CASE("small sections under the top of a sphere and a cone", "[closed-forms]") {
  // Down to radii of a few cells the allowance for the area still holds; below one cell the whole section is
  // less than it.
  for (const AnalyticModel& solid : {sphere(place, 4.0), cone(place, 4.0, 6.0)}) {
    for (const double epsilon : {0.1, 0.05}) {
      for (const double radius_in_cells : {3.0, 4.0, 5.0, 7.0, 10.0}) {
        const double radius = radius_in_cells * epsilon;
        const double below_top =
            solid.model.name == "cone" ? radius * 6.0 / 4.0 : 4.0 - std::sqrt(16.0 - radius * radius);
        const double z = solid.box.max().z() - below_top;
        SliceOptions options;
        options.epsilon = epsilon;
        CAPTURE(solid.model.name, radius_in_cells);
        ReferenceSlicer slicer(solid.model, {{z, z, z}}, options);
        check_section(*slicer.next(), solid.section(z), epsilon);
      }
    }
  }
}

TEST_CASE("curves of degree one to four keep the section", "[closed-forms]") {
  const AnalyticModel solid = flat_torus(place, 4.0, 1.5);
  for (const int degree : {1, 2, 3, 4}) {
    SliceOptions options;
    options.degree = degree;
    CAPTURE(degree);
    ReferenceSlicer slicer(solid.model, {{0.37, 0.3, 0.5}}, options);
    const Layer layer = *slicer.next();
    for (const reference::ClosedContour& contour : layer.closed) CHECK(contour.curve.degree == degree);
    check_section(layer, solid.section(0.37), options.epsilon);
  }
}

TEST_CASE("band constant and over-sampling do not change what a section is", "[closed-forms]") {
  const AnalyticModel solid = box_with_hole(place, {6.0, 5.0, 2.0}, 1.5);
  for (const int band_constant : {2, 3, 10}) {
    for (const double oversampling : {2.0, 3.0}) {
      SliceOptions options;
      options.band_constant = band_constant;
      options.oversampling = oversampling;
      CAPTURE(band_constant, oversampling);
      ReferenceSlicer slicer(solid.model, {{0.77, 0.7, 0.9}}, options);
      check_section(*slicer.next(), solid.section(0.77), options.epsilon);
    }
  }
}

}  // namespace lamina::tests
