#include <catch2/catch.hpp>

#include "tests/engine/import/reading.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

struct Broken {
  std::vector<IgesEntity> entities;
  std::string message;  ///< what the error must contain
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string replaced_at(std::string text, const std::string& after, std::size_t offset,
                        const std::string& to) {
  const auto at = text.find(after);
  REQUIRE(at != std::string::npos);
  return text.replace(at + offset, to.size(), to);
}

const std::string kNet = "0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.";
const std::string kSquare = "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.," + kNet;
const IgesEntity kLine{110, "0.,0.,0.,1.,0.,0.", 0, 0, "00010000"};
const IgesEntity kHighLine{110, "0.,0.,1.,1.,0.,1.", 0, 0, "00010000"};

}  // namespace

TEST_CASE("errors name file, entity, lines, value and bound") {
  const std::vector<Broken> files{
      {{kLine, {128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,0.5,0.,0.,1.,1.,1.,1.,1.,1.," + kNet}},
       "part.igs: entity 128 (directory line 3, parameter line 2): u knot 3 is 0.5, less than u knot 2 (1): "
       "knots must "
       "not decrease"},
      {{{128, "1,1,1,1,0,0,1,0,0,0.,0.,0.,0.,0.,0.,1.,1.,1.,1.,1.,1.," + kNet}},
       "entity 128 (directory line 1, parameter line 1): the u knot domain is from 0 to 0"},
      {{{128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,0.,1.,1.," + kNet}},
       "a weight is 0, and must be positive"},
      {{{128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,-1.,1.,1.," + kNet}}, "a weight is -1"},
      {{{128,
         "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,nan,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0."
         ",1."}},
       "(directory line 1, parameter line 2): the control point is \"nan\", not a finite real number"},
      {{{128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,inf,1."}},
       "\"inf\", not a finite"},
      {{{128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,1.E999,1."}},
       "\"1.E999\", not a finite"},
      {{{128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,x1,1."}}, "\"x1\", not a finite"},
      {{{128,
         "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,1.E11,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,"
         "0.,1."}},
       "a coordinate is 1e+11 mm, and must be within 1e+09; check the unit of the file"},
      {{{128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0."}},
       "entity 128 (directory line 1, parameter line 2): the control point is missing"},
      {{{128, "1,1,2,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.," + kNet}},
       "the degree in u is 2, and must be below the number of control points, 2"},
      {{{128, "1,1,0,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.," + kNet}},
       "the degree in u is 0, and must be from 1 to 25"},
      {{{128, "0,1,1,1,0,0,1,0,0"}}, "the upper index of control points in u is 0, and must be at least 1"},
      {{{128, "2000000000,2000000000,1,1,0,0,1,0,0"}}, "more than the file has room for"},
      {{{128, "99999999999,1,1,1,0,0,1,0,0"}}, "is \"99999999999\", not an integer"},
      {{{128, "90,90,1,1,0,0,1,0,0"}}, "more than the file has room for"},
      {{{128, kSquare}, {100, "0.,0.,0.,0.,0.,1.,0."}, {118, "3,3,0,0"}},
       "entity 100 (directory line 3, parameter line 3): the start point is the center"},
      {{{100, "0.,0.,0.,5.,0.,0.,4.,"}, kLine, {118, "1,3,0,0"}},
       "the arc starts at radius 5 and ends at radius 4"},
      {{{104, "1.,0.,1.,0.,0.,1.,0.,1.,0.,0.,1."}, kLine, {118, "1,3,0,0"}},
       "no ellipse, parabola or hyperbola"},
      {{{104, "1.,0.,1.,0.,0.,-1.,0.,1.,0.,0.,1.5"}, kLine, {118, "1,3,0,0"}}, "off the conic"},
      {{{104, "1.,0.,-1.,0.,0.,-1.,0.,1.,0.,-1.,0."}, kLine, {118, "1,3,0,0"}}, "on different branches"},
      {{kLine, {110, "2.,0.,0.,3.,0.,0."}, {102, "2,1,3"}, {118, "5,1,0,0"}},
       "entity 102 (directory line 5, parameter line 3): pieces 1 and 2 do not meet: the gap is 1"},
      {{{102, "1,1"}, {118, "1,1,0,0"}}, "points to directory line 1, which points back to it"},
      {{{102, "1,3"}, {102, "1,1"}, {118, "1,1,0,0"}}, "which points back to it"},
      {{kLine, {118, "1,2,0,0"}}, "the second rail is 2, and must be an odd directory line from 1 to 4"},
      {{kLine, {118, "1,77,0,0"}}, "the second rail is 77, and must be an odd directory line from 1 to 4"},
      {{kLine, {118, "1,3,0,0"}}, "points to directory line 3, which points back to it"},
      {{kLine, {128, kSquare}, {118, "1,3,0,0"}},
       "the second rail is entity 128 (directory line 3), which cannot be read as a curve"},
      {{kLine, {120, "1,1,2.,1."}}, "the end angle is 1, and must be above the start angle, 2"},
      {{kLine, kHighLine, {120, "1,3,0.,7."}}, "the angles are from 0 to 7, more than a full turn apart"},
      {{{110, "1.,1.,1.,1.,1.,1."}, kLine, {120, "1,3,0.,1."}}, "the axis of revolution has no direction"},
      {{{128, kSquare, 0, 3}, {110, "0.,0.,0.,1.,1.,1."}},
       "its transformation pointer 3 leads to no entity 124"},
      {{{128, kSquare, 0, 3}, {124, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", 0, 3}}, "closes on itself"},
      {{{128, kSquare, 0, 3}, {124, "1.,0.,0.,0.,0.,1.,0.,0.,1.,0.,0.,0."}},
       "entity 124 (directory line 3, parameter line 3): the matrix is singular"},
      {{{112, "3,1,3,2000,0.,1.,1."}, kLine, {118, "1,3,0,0"}}, "more than the file has room for"},
      {{{112, "3,1,3,1,1.,0." + std::string(",1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.")},
        kLine,
        {118, "1,3,0,0"}},
       "break point 1 is 0, not above break point 0 (1)"},
      {{{126, "3,1,0,0,0,0,0.,0.,.5,.5,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,0.,0.,3.,0.,0.,0.,1."},
        kLine,
        {118, "1,3,0,0"}},
       "knot 2 (0.5) is repeated 2 times, and may be 1 times at degree 1"},
  };
  for (const Broken& file : files) {
    const std::string message = error_of(iges_text(file.entities));
    INFO(message);
    CHECK(message.find(file.message) != std::string::npos);
    CHECK(message.find("part.igs: ") == 0);
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("errors in lines and sections") {
  const std::string good = iges_text({{128, kSquare}});
  REQUIRE(error_of(good).empty());
  const std::vector<std::pair<std::string, std::string>> files{
      {"", "global section: the section is missing"},
      {"hello", "file line 1: the line has 5 columns, and its section letter must be in column 73"},
      {std::string(80, 'x'), "column 73 must hold the letter of a section"},
      {replaced_at(good, "hand-written", 72, "C"), "file line 1: the file is in the compressed form"},
      {replaced_at(good, "hand-written", 72, "B"), "binary form"},
      {good.substr(0, good.find("     128")), "directory section: the section is missing"},
      {replaced(good, "     128", "     xyz"),
       "directory line 1: the entity type is \"xyz\", not an integer"},
      {replaced(good, "     128       0       0", "     126       0       0"),
       "directory line 2: the entity type is 126, but 128 on the line before"},
      {replaced(good, "     128       1", "     128      77"),
       "entity 128 (directory line 1): its parameters should start on line 77 of the parameter section, "
       "which has 2"},
      {replaced(good, "128,1,1", "126,1,1"), "its parameters start with \"126\", and must start with 128"},
      {replaced(good, "2HMM", "2HXX"), ""},  // the flag decides
      {replaced(good, ",2,2HMM", ",3,2HXX"),
       "global section: the unit of length \"XX\" (flag 3) is not known; use one of"},
      {replaced(good, ",2,2HMM", ",x,2HMM"), "global section: the model scale, unit or resolution"},
      {replaced(good, ",,4Htest,", "xx4Htest,"), "must start with its two delimiters"},
  };
  for (const auto& [text, expected] : files) {
    const std::string message = error_of(text);
    INFO(message);
    CHECK(message.find(expected) != std::string::npos);
    CHECK(message.empty() == expected.empty());
  }
}

TEST_CASE("a file with nothing to slice says what it held") {
  const std::string message = error_of(iges_text({{110, "0.,0.,0.,1.,0.,0."},
                                                  {110, "0.,0.,0.,1.,0.,0."},
                                                  {144, "7,0,0", 0, 0, "01000000"},
                                                  {128, kSquare}}));
  CHECK(message.find(
            "nothing to slice: the file holds 2 x 110 line, 1 x 128 rational B-spline surface, 1 x 144 "
            "trimmed surface; 1 x 128 left out: part of another entity that is left out") !=
        std::string::npos);
}

TEST_CASE("entities that unfold beyond the size of the file are refused") {
  // Composite curves that each name the one before twice: 2^30 pieces from 40 lines.
  std::vector<IgesEntity> entities{{100, "0.,0.,0.,1.,0.,1.,0.", 0, 0, "00010000"}};
  for (int i = 0; i < 30; ++i) {
    const std::string before = std::to_string(2 * i + 1);
    entities.push_back({102, "2," + before + "," + before, 0, 0, "00010000"});
  }
  entities.push_back({118, "61,61,0,0", 1});
  CHECK(error_of(iges_text(entities)).find("unfold to more control points") != std::string::npos);
}

TEST_CASE("a deep nest of entities is refused before it can hurt") {
  std::vector<IgesEntity> entities{kLine};
  for (int i = 0; i < 100; ++i) entities.push_back({102, "1," + std::to_string(2 * i + 1), 0, 0, "00010000"});
  entities.push_back({118, "201,1,0,0", 1});
  CHECK(error_of(iges_text(entities)).find("nested deeper than 32") != std::string::npos);
}

TEST_CASE("the error carries its place as data") {
  try {
    read_iges(iges_text({kLine, {128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,0.5,0.,0.,1.,1."}}), "part.igs");
    FAIL("no error");
  } catch (const ImportError& error) {
    CHECK(error.place().file == "part.igs");
    CHECK(error.place().section == "parameter");
    CHECK(error.place().line == 2);
    CHECK(error.place().entity_type == 128);
    CHECK(error.place().directory_line == 3);
  }
}
