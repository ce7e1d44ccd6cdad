#include "transport/protocol/line_form.h"

#include <random>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "transport/emulator/gcode_command.h"
#include "transport/protocol/line_stripper.h"

// The form of a line on the wire: shorter, and the firmware reads the same.

namespace {

using namespace lamina::transport;

/// A number as somebody may write it.
std::string random_number(std::mt19937_64& random) {
  std::string text;
  if (random() % 4 == 0) text += '-';
  if (text.empty() && random() % 20 == 0) text += '+';
  for (std::size_t zeros = random() % 3; zeros > 0; --zeros) text += '0';
  const std::size_t whole = random() % 4;
  for (std::size_t i = 0; i < whole; ++i) text += static_cast<char>('0' + random() % 10);
  const bool needs_fraction = text.empty() || text == "-" || text == "+";
  if (needs_fraction || random() % 2 == 0) {
    text += '.';
    for (std::size_t i = 1 + random() % 4; i > 0; --i) text += static_cast<char>('0' + random() % 10);
    for (std::size_t zeros = random() % 3; zeros > 0; --zeros) text += '0';
  }
  return text;
}

}  // namespace

TEST_CASE("line form: zeros, signs and blanks that say nothing go") {
  CHECK(wire_form("G1 X10.500 Y-0.250 E0.03000 F1800", {}) == "G1X10.5Y-.25E.03F1800");
  CHECK(wire_form("G1 X-0.000 Y+7 Z000", {}) == "G1X0Y7Z0");
  CHECK(wire_form("G01 X100", {}) == "G1X100");
  CHECK(wire_form("G28 X Y", {}) == "G28XY");
  CHECK(wire_form("G1 X10.500", {true, true}) == "G1 X10.5");
  CHECK(wire_form("G1 X10.500", {false, false}) == "G1X10.500");
  CHECK(wire_form("G0", {}) == "G0");
}

TEST_CASE("line form: text, and what is no list of words, stays") {
  for (const std::string command : {"M117 Layer 01 of 10", "M23 A 00.G", "M118 E1 x 0.0", "G1 X1.5.0",
                                    "G1 X-", "T?", "M999 \"00 a\"", "G1 X.", "G1 X=00"}) {
    CHECK(wire_form(command, {}) == command);
  }
}

TEST_CASE("line form: the firmware reads the same values") {
  std::mt19937_64 random(20261122);
  std::size_t saved = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string command = random() % 3 == 0 ? "M204" : "G1";
    for (std::size_t words = random() % 6; words > 0; --words) {
      command += ' ';
      command += std::string_view("XYZEFSPRIJ")[random() % 10];
      if (random() % 8 != 0) command += random_number(random);
    }
    const LineForm form{random() % 4 != 0, random() % 4 == 0};
    const std::string written = wire_form(command, form);
    INFO(command << " -> " << written);
    const GcodeCommand expected = parse_gcode_command(command);
    const GcodeCommand read = parse_gcode_command(written);
    CHECK(read.letter == expected.letter);
    CHECK(read.code == expected.code);
    CHECK(read.seen == expected.seen);
    CHECK(read.values == expected.values);
    CHECK(written.size() <= command.size());
    CHECK(wire_form(written, form) == written);
    saved += command.size() - written.size();
  }
  CHECK(saved > 50000);
}
