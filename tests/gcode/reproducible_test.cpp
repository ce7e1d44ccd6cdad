#include <clocale>
#include <cstdlib>
#include <fstream>
#include <locale>
#include <sstream>

#include <catch2/catch.hpp>

#include "gcode/marlin/gcode_line.h"
#include "tests/gcode/block_print.h"

using namespace lamina;
using namespace lamina::gcode;
using namespace lamina::tests;

namespace {

class CommaPunctuation : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("the same layers give the same bytes") {
  CHECK(joined(print(printer_options(), stepped_block(10)).lines) ==
        joined(print(printer_options(), stepped_block(10)).lines));
}

TEST_CASE("a German locale changes nothing") {
  const std::string expected = joined(print(printer_options(), stepped_block(6)).lines);
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaPunctuation));
  const char* chosen = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE"}) {
    if (chosen == nullptr) chosen = std::setlocale(LC_ALL, name);
  }
  if (chosen == nullptr) WARN("no German locale installed; only the C++ locale was changed");
  const std::string german = joined(print(printer_options(), stepped_block(6)).lines);
  const GcodeLine line = parse_line("G1 X1.25 Y-0.5");
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  CHECK(german == expected);
  CHECK(line.value('X') == 1.25);
}

TEST_CASE("the golden file stays as reviewed") {
  // A 12 mm block of two layers, one wall, sparse lines: small enough to check by hand.
  // LAMINA_UPDATE_GOLDEN=1 writes it anew.
  GcodeOptions options = printer_options();
  options.plan.wall.loops = 1;
  options.plan.shell = {1, 0, 0.0, 0.0};
  options.plan.infill.density = 0.2;
  options.plan.infill.min_area_solid = 0.0;
  options.plan.adhesion.type = Adhesion::kNone;
  options.plan.width = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  options.marlin.config = {{"quality.walls", "1"}, {"note", "two\nlines"}};
  std::vector<engine::Layer> layers;
  for (std::size_t i = 0; i < 2; ++i) layers.push_back(layer_of(i, kThickness, {square({110, 110}, 12)}));
  const std::string text = joined(print(options, layers).lines);

  const std::string path = std::string(LAMINA_SOURCE_DIR) + "/tests/golden/block.gcode";
  if (std::getenv("LAMINA_UPDATE_GOLDEN") != nullptr) std::ofstream(path) << text;
  std::ifstream file(path);
  std::stringstream golden;
  golden << file.rdbuf();
  CHECK(text == golden.str());
}
