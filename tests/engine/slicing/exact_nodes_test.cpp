// Nodes of sections whose curves are known in closed form: on them to rounding, corners where the normal
// jumps and nowhere else, chords within their tolerance.

#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "tests/engine/slicing/sliced_layers.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"

namespace lamina::tests {
namespace {

using engine::ContourNode;
using engine::LayerChains;
using engine::NodeChain;
using engine::Vector2;
using engine::Vector3;

std::size_t corner_count(const NodeChain& chain) {
  std::size_t count = 0;
  for (const ContourNode& node : chain.nodes) count += node.corner ? 1 : 0;
  return count;
}

void check_circle(const NodeChain& chain, const Vector2& centre, double radius, double epsilon) {
  REQUIRE(chain.closed);
  CHECK(corner_count(chain) == 0);
  double longest = 0.0;
  for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
    const ContourNode& node = chain.nodes[k];
    const Vector2 out = (node.position - centre) / radius;
    CHECK(std::abs(out.norm() - 1.0) * radius < 1e-9);
    CHECK(std::abs(out.dot(node.tangent_in)) < 1e-6);
    CHECK(node.exact);
    longest = std::max(longest, (chain.nodes[(k + 1) % chain.nodes.size()].position - node.position).norm());
  }
  // Sagitta of the longest chord.
  const double sagitta = radius - std::sqrt(radius * radius - 0.25 * longest * longest);
  CHECK(sagitta <= 0.05 * epsilon);
}

TEST_CASE("a sphere's nodes lie on its circles to a nanometre", "[slicing]") {
  const AnalyticModel solid = sphere({1.0, -2.0, 10.0}, 10.0);
  for (const double z : {0.1, 3.7, 9.999, 10.0, 12.34, 19.99}) {
    const double radius = std::sqrt(100.0 - (z - 10.0) * (z - 10.0));
    const LayerChains chains = chains_at(solid.model, z, 0.01);
    REQUIRE(chains.closed.size() == 1);
    check_circle(chains.closed.front(), {1.0, -2.0}, radius, 0.01);
  }
}

TEST_CASE("a cylinder's section is its circle at every height", "[slicing]") {
  const AnalyticModel solid = upright_cylinder({0.0, 0.0, 0.0}, 5.0, 20.0);
  for (const double z : {0.001, 7.0, 19.999}) {
    const LayerChains chains = chains_at(solid.model, z, 0.05);
    REQUIRE(chains.closed.size() == 1);
    check_circle(chains.closed.front(), {0.0, 0.0}, 5.0, 0.05);
  }
}

TEST_CASE("a torus has two circles, the inner one inside the outer", "[slicing]") {
  const AnalyticModel solid = flat_torus({0.0, 0.0, 5.0}, 15.0, 5.0);
  const LayerChains chains = chains_at(solid.model, 7.0, 0.01);
  REQUIRE(chains.closed.size() == 2);
  const double half = std::sqrt(25.0 - 4.0);
  for (const NodeChain& chain : chains.closed) {
    const bool inner = chain.nodes.front().position.norm() < 15.0;
    check_circle(chain, {0.0, 0.0}, inner ? 15.0 - half : 15.0 + half, 0.01);
  }
}

TEST_CASE("a box's section is four nodes, all corners, exact", "[slicing]") {
  const AnalyticModel solid = box({0.0, 0.0, 0.0}, {20.0, 15.0, 10.0});
  const LayerChains chains = chains_at(solid.model, 3.3, 0.01);
  REQUIRE(chains.closed.size() == 1);
  const NodeChain& chain = chains.closed.front();
  REQUIRE(chain.nodes.size() == 4);
  CHECK(corner_count(chain) == 4);
  for (const ContourNode& node : chain.nodes) {
    CHECK(std::min(std::abs(node.position.x()), std::abs(node.position.x() - 20.0)) < 1e-12);
    CHECK(std::min(std::abs(node.position.y()), std::abs(node.position.y() - 15.0)) < 1e-12);
  }
}

TEST_CASE("lying cylinders as STEP readers make them, at any height", "[slicing]") {
  // Three arcs of 120 degrees with weights of one half, one of them across the bottom, where rounding decides
  // about the signs of differences.
  const double middle = 2.0 * std::numbers::pi / 3.0;
  engine::NurbsSurface wall;
  wall.degree_u = 2;
  wall.degree_v = 1;
  for (const double turn : {1.0, 1.0, 1.0, 4.0 / 3.0, 4.0 / 3.0, 5.0 / 3.0, 5.0 / 3.0, 2.0, 2.0, 2.0})
    wall.knots_u.push_back(3.0 * middle * turn);
  wall.knots_v = {1.0, 1.0, 4.0, 4.0};
  wall.net.count_u = 7;
  wall.net.count_v = 2;
  const double radius = 5.0;
  constexpr unsigned kSeed = 3;
  INFO("seed " << kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> rounding(-3e-15, 3e-15);
  for (int k = 0; k < 7; ++k) {
    const double angle = 0.5 * std::numbers::pi + 0.5 * middle * k;
    const double reach = k % 2 == 0 ? radius : 2.0 * radius;
    // The far end a rounding lower than the near one in the middle of an arc: that does not make the wall
    // slope.
    double z = 20.0 + reach * std::sin(angle) + rounding(random);
    for (const double x : {0.0, 3.0}) {
      wall.net.points.push_back(
          engine::homogeneous({x, 12.0 + reach * std::cos(angle), z}, k % 2 == 0 ? 1.0 : 0.5));
      if (k % 2 != 0) z -= 2e-15;
    }
  }
  const engine::Model model = model_of("lying", {wall});
  engine::SliceOptions options;
  options.longest_bridge = 0.0;  // the ends are not closed
  for (double z = 15.01; z < 25.0; z += 0.0137) {
    const auto [chains, report] = reported_chains_at(model, z, options);
    CAPTURE(z);
    REQUIRE(chains.open.size() == 2);
    const double half_width = std::sqrt(radius * radius - (z - 20.0) * (z - 20.0));
    for (const NodeChain& chain : chains.open) {
      for (const ContourNode& node : chain.nodes)
        CHECK(std::abs(std::abs(node.position.y() - 12.0) - half_width) < 1e-9);
      CHECK(std::abs(chain.nodes.front().position.x() - chain.nodes.back().position.x()) > 3.0 - 1e-9);
    }
  }
}

TEST_CASE("work follows the contour, not the area of faces nor the number of cells", "[slicing]") {
  const AnalyticModel plate = box({0.0, 0.0, 0.0}, {200.0, 200.0, 1.0});
  engine::SliceOptions options;
  options.epsilon = 0.001;
  engine::Slicer slicer(plate.model, {{0.0, 0.0, 1.0}, {0.5, 0.0, 1.0}}, options);
  const engine::Layer bottom = *slicer.next();
  REQUIRE(bottom.planar.size() == 1);
  CHECK(bottom.report.cells < 100);
  CHECK(bottom.report.tiles == 0);
  const engine::Layer middle = *slicer.next();
  REQUIRE(middle.closed.size() == 1);
  CHECK(middle.report.cells < 100);
  CHECK(middle.report.tiles <= 4 * (200000 / 64 + 2));
}

TEST_CASE("the number of nodes grows with the root of 1 / epsilon", "[slicing]") {
  const AnalyticModel solid = standing_torus({0.0, 0.0, 20.0}, 15.0, 5.0);
  const auto nodes = [&](double epsilon) {
    return chains_at(solid.model, 17.0, epsilon).closed.front().nodes.size();
  };
  const double ratio = static_cast<double>(nodes(0.001)) / static_cast<double>(nodes(0.1));
  CHECK(ratio > 5.0);
  CHECK(ratio < 20.0);
}

}  // namespace
}  // namespace lamina::tests
