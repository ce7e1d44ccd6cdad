#include "gcode/marlin/gcode_line.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <catch2/catch.hpp>

#include "gcode/marlin/number_text.h"

using namespace lamina::gcode;

TEST_CASE("numbers are written as printers read them") {
  CHECK(number_text(0.0, 3) == "0");
  CHECK(number_text(-0.0, 3) == "0");
  CHECK(number_text(-0.0004, 3) == "0");
  CHECK(number_text(0.8, 3) == "0.8");
  CHECK(number_text(-0.5, 3) == "-0.5");
  CHECK(number_text(12.3456, 3) == "12.346");
  CHECK(number_text(100.0, 3) == "100");
  CHECK(number_text(1e-5, 5) == "0.00001");
  CHECK(number_text(123456789.0, 0) == "123456789");
  CHECK(fixed_text(1491.156, 2) == "1491.16");
  CHECK(fixed_text(-0.001, 2) == "0.00");
  CHECK(exact_text(1e21) == "1000000000000000000000");
}

TEST_CASE("rounding leaves at most the decimals asked for") {
  const unsigned seed = 4711;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-500.0, 500.0);
  for (int i = 0; i < 20000; ++i) {
    const double value = number(random);
    const std::string text = number_text(value, 5);
    const std::size_t point = text.find('.');
    if (point != std::string::npos) REQUIRE(text.size() - point - 1 <= 5);
    REQUIRE(std::abs(std::stod(text) - value) <= 0.5e-5 + 1e-12);
  }
}

TEST_CASE("lines are read into command, words and comment") {
  const GcodeLine move = parse_line("G1 X12.5 Y-3 E0.01234 F1500 ; wall");
  CHECK(move.is('G', 1));
  CHECK(move.words == std::vector<Word>{{'X', 12.5}, {'Y', -3.0}, {'E', 0.01234}, {'F', 1500.0}});
  CHECK(move.comment == " wall");
  CHECK(move.value('E') == 0.01234);
  CHECK_FALSE(move.value('Z').has_value());

  const GcodeLine home = parse_line("G28 X Y");
  CHECK(home.words == std::vector<Word>{{'X', std::nullopt}, {'Y', std::nullopt}});
  CHECK(parse_line("").text().empty());
  CHECK_FALSE(parse_line(";LAYER:3").command);
  CHECK(parse_line(";LAYER:3").comment == "LAYER:3");
  CHECK(parse_line("M862.3 P").command->subcode == 3);
  CHECK(parse_line("M117 Layer 3/20; x").argument == "Layer 3/20");
  CHECK(parse_line("T0").is('T', 0));
}

TEST_CASE("spacing, letter case and line ends do not matter") {
  const GcodeLine expected = parse_line("G1 X1.5 Y2");
  for (const char* text : {"g1x1.5y2", "  G1\tX1.50  Y+2.0 ", "G1 X1.5 Y2\r", "G01 X01.5 Y2."}) {
    CHECK(parse_line(text) == expected);
  }
}

TEST_CASE("what is no G-code is refused, with its place") {
  for (const char* text : {"START_PRINT", "G", "Gx", "N10 G1 X1", "G1 X1*71", "G1 1", "hello", "G1 X1 #",
                           "G99999999999", "M862.", "(comment)", "G1 X1 (c)"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_line(text), GcodeError);
  }
  try {
    parse_line("G1 X1 ?2", 17);
    FAIL("accepted");
  } catch (const GcodeError& error) {
    CHECK(error.line == 17);
    CHECK(error.column == 7);
    CHECK(std::string(error.what()).find("line 17, column 7") != std::string::npos);
  }
}

TEST_CASE("text and parse_line are inverses over random lines") {
  const unsigned seed = 31337;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto pick = [&](int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); };
  const auto number = [&]() -> double {
    switch (pick(5)) {
      case 0:
        return pick(1000);
      case 1:
        return rounded(std::uniform_real_distribution<double>(-300, 300)(random), 3);
      case 2:
        return rounded(std::uniform_real_distribution<double>(-1, 1)(random), 5);
      case 3:
        return std::ldexp(std::uniform_real_distribution<double>(-1, 1)(random), pick(400) - 200);
      default:
        return 0.0;
    }
  };
  const auto text = [&](int longest) {
    std::string result;
    for (int i = pick(longest); i > 0; --i) result += static_cast<char>(' ' + pick(95));
    return result;
  };
  int with_text = 0;
  for (int i = 0; i < 20000; ++i) {
    GcodeLine line;
    if (pick(5) > 0) {
      line.command = Command{"GMT"[pick(3)], pick(1000), std::nullopt};
      if (pick(10) == 0) line.command->subcode = pick(10);
      if (pick(20) == 0) {
        line.command = Command{'M', 117, std::nullopt};
        line.argument = "Layer " + std::to_string(pick(99));
        ++with_text;
      } else if (parse_line(line.text() + " X").argument.empty()) {
        for (int w = pick(6); w > 0; --w) {
          Word word{static_cast<char>('A' + pick(26)), std::nullopt};
          if (pick(6) > 0) word.value = number();
          line.words.push_back(word);
        }
      }
    }
    if (pick(3) == 0) line.comment = text(30);
    const std::string written = line.text();
    CAPTURE(written);
    REQUIRE(parse_line(written) == line);
    REQUIRE(parse_line(written).text() == written);
  }
  CHECK(with_text > 100);
}

TEST_CASE("random bytes are read or refused, never worse") {
  const unsigned seed = 5;
  CAPTURE(seed);
  std::mt19937 random(seed);
  int read = 0;
  for (int i = 0; i < 50000; ++i) {
    std::string line = i % 2 == 0 ? "G1 X1" : "";
    for (int n = static_cast<int>(random() % 20); n > 0; --n) line += static_cast<char>(random() % 256);
    try {
      const GcodeLine parsed = parse_line(line);
      ++read;
      REQUIRE(parse_line(parsed.text()) == parsed);
    } catch (const GcodeError& error) {
      REQUIRE(error.column <= line.size() + 1);
    }
  }
  CHECK(read > 100);
}
