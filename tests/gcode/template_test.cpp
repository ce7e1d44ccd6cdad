#include "gcode/marlin/template.h"

#include <catch2/catch.hpp>

#include "gcode/marlin/expression.h"

using namespace lamina::gcode;
using Lines = std::vector<std::string>;

namespace {

const TemplateVariables& variables() {
  static const TemplateVariables values{
      {"nozzle", 210.0}, {"bed", 60.0}, {"max_z", 12.25}, {"bed_z", 20.0}, {"filament_type", "PLA"}};
  return values;
}

double number(const std::string& expression) {
  return std::get<double>(evaluate(expression, variables()));
}

}  // namespace

TEST_CASE("expressions follow the usual precedence") {
  CHECK(number("1 + 2 * 3") == 7.0);
  CHECK(number("(1 + 2) * 3") == 9.0);
  CHECK(number("8 / 2 / 2") == 2.0);
  CHECK(number("5 - 2 - 1") == 2.0);
  CHECK(number("-2 * -3") == 6.0);
  CHECK(number("nozzle - 10") == 200.0);
  CHECK(number("min(max_z + 10, bed_z)") == 20.0);
  CHECK(number("max(1, 2, max_z)") == 12.25);
  CHECK(number("floor(max_z) + ceil(0.1) + round(0.6) + abs(-3)") == 17.0);
  CHECK(number("bed > 50 and nozzle < 230") == 1.0);
  CHECK(number("bed > 70 or not (nozzle == 210)") == 0.0);
  CHECK(number("filament_type == \"PLA\"") == 1.0);
  CHECK(number("filament_type != \"PLA\"") == 0.0);
  CHECK(std::get<std::string>(evaluate("filament_type", variables())) == "PLA");
}

TEST_CASE("expressions that make no sense say why") {
  for (const char* text : {"", "1 +", "(1", "foo", "nozzle / 0", "1 2", "sqrt(2)", "filament_type + 1",
                           "\"open", "min(", "abs(1, 2)", "1 < \"a\"", "$"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(evaluate(text, variables()), ExpressionError);
  }
  CHECK_THROWS_WITH(evaluate("nozle", variables()),
                    Catch::Contains("unknown name 'nozle'") && Catch::Contains("bed, bed_z, filament_type"));
  CHECK_THROWS_AS(evaluate(std::string(5000, '('), variables()), ExpressionError);
  CHECK_THROWS_AS(evaluate(std::string(5000, '-') + "1", variables()), ExpressionError);
}

TEST_CASE("templates are filled in line by line") {
  CHECK(fill_template("start", "M104 S{nozzle}\nG1 Z{min(max_z+10, bed_z)} F600\n\n  G28  \r\n",
                      variables()) == Lines{"M104 S210", "G1 Z20 F600", "G28"});
  CHECK(fill_template("start", "; {not a placeholder}\nM117 {filament_type}", variables()) ==
        Lines{"; {not a placeholder}", "M117 PLA"});
  CHECK(fill_template("start", "", variables()).empty());
}

TEST_CASE("conditions keep or leave out what they enclose") {
  const std::string text =
      "{if bed > 0}\nM140 S{bed}\n{if filament_type == \"PETG\"}G1 Z0.3{else}G1 Z0.2{endif}\n{else}\nM140 "
      "S{unknown}\n"
      "{endif}\nM105";
  CHECK(fill_template("start", text, variables()) == Lines{"M140 S60", "G1 Z0.2", "M105"});
}

TEST_CASE("template errors name the template, the line and the placeholder") {
  try {
    fill_template("end_gcode", "G28\nG1 Z{hight}\n", variables());
    FAIL("accepted");
  } catch (const TemplateError& error) {
    CHECK(error.template_name == "end_gcode");
    CHECK(error.line == 2);
    CHECK(error.placeholder == "hight");
    CHECK(std::string(error.what()).starts_with("end_gcode, line 2: {hight}: unknown name 'hight'"));
  }
  for (const char* text : {"{if 1}", "{endif}", "{else}", "{if 1}{else}{else}{endif}", "G1 X{1", "{1/0}"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(fill_template("x", text, variables()), TemplateError);
  }
}
