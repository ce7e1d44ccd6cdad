// A sphere without its cap: what can be closed is closed, and what cannot is told with its layers and its
// place.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/slicer.h"
#include "engine/slicing_planes.h"
#include "gcode/region/layer_region.h"
#include "tests/engine/import/iges_writer.h"
#include "tests/tools/program_run.h"

namespace lamina::tests {
namespace {

constexpr double kRadius = 10.0;  // about (0, 0, 10)
constexpr double kCut = 8.5;      // the cap x > 8.5 is missing: a hole of radius 5.27
constexpr int kRings = 120;       // of the triangles, from rim to pole
constexpr int kSides = 240;

/// The sphere turned about its x axis, from its rim at x = `cut` to its pole at -10: three entities.
std::string capless_iges(double cut) {
  const double rim = std::sqrt(kRadius * kRadius - cut * cut);
  return iges_text({{110, reals({0, 0, kRadius, 1, 0, kRadius}), 0, 0, "00010000"},
                    {100, reals({kRadius, 0, 0, cut, rim, -kRadius, 0}), 0, 0, "00010000"},
                    {120, "1,3," + reals({0, 2.0 * std::numbers::pi})}});
}

/// The same as triangles, a degree and a half wide.
std::string capless_stl(double cut) {
  const double first = std::acos(cut / kRadius);
  std::string facets;
  std::uint32_t count = 0;
  const auto add = [&](const auto& value) {
    facets.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto add_corner = [&](int ring, int side) {
    const double a = first + (std::numbers::pi - first) * ring / kRings;
    const double b = 2.0 * std::numbers::pi * (side % kSides) / kSides;
    for (const double c : {kRadius * std::cos(a), kRadius * std::sin(a) * std::cos(b),
                           kRadius + kRadius * std::sin(a) * std::sin(b)})
      add(static_cast<float>(c));
  };
  for (int ring = 0; ring < kRings; ++ring) {
    for (int side = 0; side < kSides; ++side) {
      for (const bool second : {false, true}) {
        if (second && ring + 1 == kRings) continue;  // at the pole a quadrangle is one triangle
        for (int k = 0; k < 3; ++k) add(0.0F);
        add_corner(ring, side + (second ? 1 : 0));
        add_corner(ring + 1, side + (second ? 1 : 0));
        add_corner(second ? ring + 1 : ring, second ? side : side + 1);
        add(std::uint16_t{0});
        ++count;
      }
    }
  }
  std::string header(80, ' ');
  header.append(reinterpret_cast<const char*>(&count), sizeof count);
  return header + facets;
}

/// How wide the hole is at a height, mm; 0 above and below it.
double gap_at(double z, double cut) {
  const double square = kRadius * kRadius - cut * cut - std::pow(z - kRadius, 2);
  return square > 0.0 ? 2.0 * std::sqrt(square) : 0.0;
}

/// The disc at a height, cut off straight across the hole.
double closed_area(double z, double cut) {
  const double radius = std::sqrt(kRadius * kRadius - std::pow(z - kRadius, 2));
  const double disc = std::numbers::pi * radius * radius;
  if (radius <= cut) return disc;
  const double angle = std::acos(cut / radius);
  return disc - radius * radius * angle + cut * std::sqrt(radius * radius - cut * cut);
}

std::filesystem::path written(const WorkFolder& folder, const std::string& name, const std::string& bytes) {
  std::ofstream(folder / name, std::ios::binary) << bytes;
  return folder / name;
}

std::vector<engine::Layer> layers_of(const std::filesystem::path& file, double longest_bridge) {
  engine::SliceOptions options;
  options.longest_bridge = longest_bridge;
  engine::Slicer slicer(engine::read_model(file).model,
                        engine::make_slicing_planes(0.0, 2.0 * kRadius, {0.2}), options);
  std::vector<engine::Layer> layers;
  while (auto layer = slicer.next()) layers.push_back(std::move(*layer));
  return layers;
}

TEST_CASE(
    "a sphere without its cap is closed layer by layer where a bridge reaches, and says where none does") {
  const WorkFolder folder;
  const struct {
    double cut, longest_bridge;
  } cases[] = {{kCut, 2.0},   // the default: most of the hole is too wide
               {kCut, 11.0},  // wider than the hole
               {9.96, 2.0}};  // a hole narrower than the default
  for (const auto& [cut, longest_bridge] : cases) {
    for (const auto& file : {written(folder, "capless.igs", capless_iges(cut)),
                             written(folder, "capless.stl", capless_stl(cut))}) {
      std::size_t bridged = 0;
      std::size_t open = 0;
      for (const engine::Layer& layer : layers_of(file, longest_bridge)) {
        const double z = layer.plane.z;
        const double gap = gap_at(z, cut);
        CAPTURE(file.extension(), cut, longest_bridge, z, gap);
        if (gap > longest_bridge) {
          ++open;
          CHECK(layer.closed.empty());
          CHECK(layer.open.size() == 1);
          REQUIRE_FALSE(layer.report.open_gaps.empty());
          for (const engine::BridgedGap& told : layer.report.open_gaps) {
            CHECK(told.width() == Approx(gap).margin(0.02));
            CHECK(told.from.x() == Approx(cut).margin(0.02));
          }
          continue;
        }
        REQUIRE(layer.closed.size() == 1);
        CHECK(layer.open.empty());
        CHECK(layer.report.open_gaps.empty());
        CHECK(layer.report.bridged_gaps.size() == (gap > 0.0 ? 1 : 0));
        bridged += layer.report.bridged_gaps.size();
        const double expected = closed_area(z, cut);
        // The triangles lie between the sphere and one smaller by twice the sagitta of their chords.
        const double sagitta = kRadius * (1.0 - std::cos(std::numbers::pi / kSides));
        const double lost =
            file.extension() == ".stl" ? 2.0 * std::numbers::pi * kRadius * 2.0 * sagitta : 0.0;
        const double found = engine::area(gcode::make_region(layer, {0.001}).region);
        CHECK(found <= expected + std::max(0.001 * expected, 0.02));
        CHECK(found >= expected - lost - std::max(0.001 * expected, 0.02));
      }
      CHECK((open > 0) == (longest_bridge < gap_at(kRadius, cut)));
      CHECK(bridged + open > 0);
    }
  }
}

std::size_t outer_walls(const std::string& gcode) {
  const std::string sign = ";TYPE:External perimeter";
  std::size_t count = 0;
  for (std::size_t at = gcode.find(sign); at != std::string::npos; at = gcode.find(sign, at + 1)) ++count;
  return count;
}

TEST_CASE("slicing a sphere without its cap names the layers and the place, and writes the rest") {
  const WorkFolder folder;
  for (const std::string name : {"capless.igs", "capless.stl"}) {
    CAPTURE(name);
    written(folder, name, name == "capless.igs" ? capless_iges(kCut) : capless_stl(kCut));
    const std::string slicing =
        " --layer-height 0.2 -s layer.first_height=0.2 --no-center --move 100,100 --force -o part.gcode";
    const ProgramRun run = run_lamina(folder, "slice " + name + slicing);
    CHECK(run.exit_code == 0);
    // The planes from 4.9 to 15.1 meet the hole, which ends at 10 - 5.268 and 10 + 5.268.
    CHECK_THAT(run.err,
               Catch::Contains("the model is not closed in 52 layers between z = 4.900 and z = 15.100 mm"));
    // The widest place, at mid-height: 2 sqrt(10^2 - 8.5^2 - 0.1^2) = 10.533 mm wide, at x = 8.5 + 100.
    CHECK_THAT(run.err, Catch::Contains("the widest, 10.53"));
    CHECK_THAT(run.err, Catch::Contains("at x = 108.5") && Catch::Contains("z = 9.9"));
    CHECK(outer_walls(read_text(folder / "part.gcode")) == 48);  // of 100 layers

    // And how to close the rest.
    const std::size_t told = run.err.find("slicing.longest_bridge=");
    REQUIRE(told != std::string::npos);
    const std::string setting = run.err.substr(told, run.err.find(' ', told) - told);
    CHECK(setting == "slicing.longest_bridge=10.6");
    const ProgramRun closed = run_lamina(folder, "slice " + name + slicing + " -s " + setting);
    CHECK(closed.exit_code == 0);
    CHECK_THAT(closed.err,
               !Catch::Contains("not closed") && Catch::Contains("gaps in the model were bridged"));
    CHECK(outer_walls(read_text(folder / "part.gcode")) == 100);
  }
}

}  // namespace
}  // namespace lamina::tests
