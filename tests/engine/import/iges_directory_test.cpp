#include <catch2/catch.hpp>

#include "tests/engine/import/reading.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

const std::string kSquare =
    "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,"
    "0.,1.,0.,1.";

std::string skipped(const ImportReport& report) {
  std::string text;
  for (const auto& entry : report.skipped) {
    text += std::to_string(entry.count) + " x " + std::to_string(entry.type) + " " + entry.reason + " D" +
            std::to_string(entry.first_directory_line) + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("status: only visible, independent geometry is sliced") {
  struct Case {
    std::string status;
    std::string reason;
  };
  const std::vector<Case> cases{{"00000000", ""},
                                {"00020000", ""},  // logically dependent, as in a group
                                {"        ", ""},
                                {"       0", ""},
                                {"01000000", "blanked"},
                                {"00010000", "part of another entity that is left out"},
                                {"00030000", "part of another entity that is left out"},
                                {"00000100", "not of geometry use (entity use flag)"},
                                {"00000500", "not of geometry use (entity use flag)"}};
  for (const Case& example : cases) {
    INFO("status \"" + example.status + "\"");
    const ImportResult result =
        read_iges(iges_text({{128, kSquare}, {128, kSquare, 0, 0, example.status}}), "part.igs");
    CHECK(result.model.surfaces.size() == (example.reason.empty() ? 2 : 1));
    CHECK(skipped(result.report) == (example.reason.empty() ? "" : "1 x 128 " + example.reason + " D3\n"));
    CHECK(result.model.surfaces[0].entity_type == 128);
    CHECK(result.model.surfaces[0].directory_line == 1);
  }
  const ImportResult blank = read_iges(iges_text({{128, kSquare, 0, 0, "        "}}), "part.igs");
  CHECK(tolerated(blank.report).find("blank status field") != std::string::npos);
}

TEST_CASE("the base of a trimmed surface is never sliced as if it were whole") {
  // Some writers do not mark it as dependent.
  const std::vector<IgesEntity> entities{{128, kSquare}, {144, "1,0,0,", 0, 0, "01000000"},
                                         {128, kSquare}, {143, "0,5,0", 0, 0, "01000000"},
                                         {128, kSquare}, {308, "0,4Hpart,1,9"},
                                         {128, kSquare}};
  const ImportResult result = read_iges(iges_text(entities), "part.igs");
  REQUIRE(result.model.surfaces.size() == 1);
  CHECK(result.model.surfaces[0].directory_line == 13);
  CHECK(skipped(result.report) ==
        "3 x 128 part of another entity that is left out D1\n1 x 143 blanked D7\n1 x 144 blanked D3\n"
        "1 x 308 no shape D11\n");
}

TEST_CASE("members of a group are sliced, and so are faces that nothing owns") {
  const std::vector<IgesEntity> entities{{128, kSquare, 0, 0, "00010000"},
                                         {402, "1,1", 7},
                                         {128, kSquare, 0, 0, "00010000"},
                                         {144, "5,0,0,", 0, 0, "00010000"}};
  const ImportResult result = read_iges(iges_text(entities), "part.igs");
  REQUIRE(result.model.surfaces.size() == 2);
  CHECK(result.model.surfaces[0].directory_line == 1);
  CHECK(result.model.surfaces[1].directory_line == 7);
}

TEST_CASE("every entity is counted, and either used or listed with a reason") {
  const std::vector<IgesEntity> entities{{124, "1.,0.,0.,5.,0.,1.,0.,0.,0.,0.,1.,0."},
                                         {124, "1.,0.,0.,5.,0.,1.,0.,0.,0.,0.,1.,0."},
                                         {110, "0.,0.,0.,1.,0.,0.", 0, 1, "00010000"},
                                         {110, "0.,1.,0.,1.,1.,0.", 0, 0, "00010000"},
                                         {118, "5,7,0,0", 1},
                                         {110, "0.,0.,0.,1.,0.,0."},
                                         {116, "0.,0.,0.,0"},
                                         {9999, "1"},
                                         {402, "1,9", 7}};
  const ImportReport report = read_iges(iges_text(entities), "part.igs").report;
  std::size_t total = 0;
  for (const auto& entity : report.entities) total += entity.count;
  CHECK(total == entities.size());
  REQUIRE(report.surfaces.size() == 1);
  CHECK(report.surfaces[0].type == 118);
  CHECK(skipped(report) ==
        "1 x 110 not used by a surface D11\n1 x 116 not used by a surface D13\n1 x 124 not used by a surface "
        "D3\n"
        "1 x 402 no shape D17\n1 x 9999 no shape D15\n");
}

TEST_CASE("a parameter line count that is too small is made up for by the lines' own pointers") {
  std::string text = iges_text({{128, kSquare}});
  const std::string second = "     128       0       0       2";
  const auto at = text.find(second);
  REQUIRE(at != std::string::npos);
  text[at + second.size() - 1] = '1';
  const ImportResult result = read_iges(text, "part.igs");
  CHECK(result.model.surfaces.size() == 1);
  CHECK(tolerated(result.report).find("more parameter lines") != std::string::npos);
}
