#include <string>

#include <catch2/catch.hpp>

#include "transport/protocol/command_class.h"
#include "transport/protocol/line_framing.h"
#include "transport/protocol/line_stripper.h"

using namespace lamina::transport;

TEST_CASE("framing: checksums agree with those that a real firmware took") {
  // Recorded with a Marlin 2.1.2.1.
  CHECK(frame_line(0, "M110 N0") == "N0 M110 N0*125\n");
  CHECK(frame_line(3, "G1 X50 Y50 Z5 F6000") == "N3 G1 X50 Y50 Z5 F6000*5\n");
  CHECK(frame_line(4, "M400") == "N4 M400*35\n");
  CHECK(frame_line(5, "M114") == "N5 M114*34\n");
  CHECK(frame_line(6, "M114") == "N6 M114*33\n");
  CHECK(frame_line(1, "G1 X1") == "N1 G1 X1*96\n");
  CHECK(frame_line(2, "G1 X2") == "N2 G1 X2*96\n");
  CHECK(frame_line(1, "G1 X5 Y6 F3000") == "N1 G1 X5 Y6 F3000*78\n");
  CHECK(frame_line(-5, "M110 N-5") == "N-5 M110 N-5*125\n");
  CHECK(frame_line(2'000'000'000, "M105") == "N2000000000 M105*21\n");
  CHECK(checksum("") == 0);
  CHECK(checksum("AA") == 0);
  CHECK(checksum("A") == 65);
}

TEST_CASE("framing: a line may have 95 bytes and no more") {
  const std::string frame = "N1 *00";
  const std::string longest = "M117 " + std::string(kMaxLineBytes - frame.size() - 5, 'x');
  std::string fits = longest;
  // The checksum may have one to three digits; bring it to at most two by the choice of the last letter.
  while (checksum("N1 " + fits) < 10 || checksum("N1 " + fits) > 99) ++fits.back();
  CHECK(frame_line(1, fits).size() == kMaxLineBytes + 1);
  CHECK_THROWS_AS(frame_line(1, fits + "xx"), LineError);
  try {
    frame_line(1, fits + "xx");
  } catch (const LineError& error) {
    CHECK(error.bytes > kMaxLineBytes);
    CHECK(error.bound == kMaxLineBytes);
    CHECK(error.text == fits + "xx");
  }
}

TEST_CASE("stripping: what the printer does not need is gone, what it needs is as it was") {
  const auto [line, stripped] = GENERATE(table<std::string, std::string>({
      {"", ""},
      {"   ", ""},
      {"; only a comment", ""},
      {";LAYER_CHANGE\r\n", ""},
      {"(only a comment)", ""},
      {"G1 X1 Y2 ; move", "G1 X1 Y2"},
      {"  G1   X1\tY2  \r\n", "G1 X1 Y2"},
      {"g1 x1.5e0.2", "G1 X1.5E0.2"},
      {"G1 X1 (in between) Y2", "G1 X1 Y2"},
      {"N12 G1 X1*71", "G1 X1"},
      {"n-1 m110*15", "M110"},
      {"M117 Layer 3/80  is  on", "M117 Layer 3/80  is  on"},
      {"m117 hello world ; comment", "M117 hello world"},
      {"M118 E1 keep (this)", "M118 E1 keep (this)"},
      {"M23 file.gco", "M23 file.gco"},
      {"M104 S200;heat", "M104 S200"},
      {"M117 back\\slash\b", "M117 backslash"},
      {"G1 X\x01\\5", "G1 X5"},
      {"T0", "T0"},
  }));
  CHECK(strip_line(line) == stripped);
  // What is stripped has nothing left to strip.
  CHECK(strip_line(stripped) == stripped);
}

TEST_CASE("commands are classed by how long they take") {
  CHECK(classify("G1 X1") == CommandClass::kMotion);
  CHECK(classify("G1X1") == CommandClass::kMotion);
  CHECK(classify("G28") == CommandClass::kBlocking);
  CHECK(classify("M109 S200") == CommandClass::kBlocking);
  CHECK(classify("M400") == CommandClass::kBlocking);
  CHECK(classify("M0") == CommandClass::kBlocking);
  CHECK(classify("M104 S200") == CommandClass::kQuick);
  CHECK(classify("G92 E0") == CommandClass::kQuick);
  CHECK(classify("") == CommandClass::kQuick);
  CHECK(command_word("G92 E0") == "G92");
  CHECK(command_word("hello").empty());
}
