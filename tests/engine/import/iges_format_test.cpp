#include <catch2/catch.hpp>

#include "tests/engine/import/reading.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

/// A flat square of side 1 with the corner (0, 0, 0), by four reals that the tests spell in their own ways.
const IgesEntity kSquare{
    128,
    "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,"
    "0.,1.,0.,1."};

std::string with_commas_as(std::string text, char delimiter) {
  for (char& c : text) {
    if (c == ',') c = delimiter;
  }
  return text;
}

ImportResult read(const IgesFrame& frame, const IgesEntity& entity = kSquare) {
  return read_iges(iges_text({entity}, frame), "part.igs");
}

Vector3 far_corner(const ImportResult& result) {
  return evaluate(result.model.surfaces.at(0).nurbs, 1.0, 1.0);
}

IgesFrame with_unit(const std::string& scale, const std::string& flag, const std::string& name) {
  IgesFrame frame;
  frame.global = ",,4Htest,8Htest.igs,6Hlamina,3H1.0,32,38,6,308,15,4Htest," + scale + "," + flag + "," +
                 name + ",1,0.01,15H20260101.000000,1.E-3,500.,2Hme,4Hnone,11,0,15H20260101.000000;";
  return frame;
}

}  // namespace

TEST_CASE("line ends: LF, CR LF, CR, none at all, and no line end at the end") {
  for (const std::string line_end : {"\n", "\r\n", "\r", ""}) {
    for (const bool final_line_end : {true, false}) {
      IgesFrame frame;
      frame.line_end = line_end;
      frame.final_line_end = final_line_end;
      const ImportResult result = read(frame);
      CHECK((far_corner(result) - Vector3(1, 1, 0)).norm() < 1e-15);
      CHECK(result.report.tolerated.empty());
      CHECK(result.report.line_count == 8);
    }
  }
}

TEST_CASE("delimiters are those of the global section") {
  IgesFrame frame;
  frame.record_delimiter = '#';
  frame.global =
      "1H//1H#/4Htest/8Htest.igs/6Hlamina/3H1.0/32/38/6/308/15/4Htest/1./2/2HMM/1/0.01/"
      "15H20260101.000000/1.E-6/0./2Hme/4Hnone/11/0/15H20260101.000000#";
  IgesEntity square = kSquare;
  square.parameters = with_commas_as(square.parameters, '/');
  std::string text = iges_text({square}, frame);
  const auto at = text.find("128,");
  text[at + 3] = '/';
  CHECK((far_corner(read_iges(text, "part.igs")) - Vector3(1, 1, 0)).norm() < 1e-15);

  frame.global = "1H,,1H#,4Htest,8Htest.igs,6Hlamina,3H1.0,32,38,6,308,15,4Htest,1.,2,2HMM#";
  CHECK((far_corner(read(frame)) - Vector3(1, 1, 0)).norm() < 1e-15);
}

TEST_CASE("strings may hold delimiters, and run over a line end") {
  IgesFrame frame;
  const std::string author =
      "a,b;c 5Hd, and so on for more than the seventy-two columns that a line has, so there;";
  frame.global =
      ",,9Hx,y;z 2Hq,8Htest.igs,6Hlamina,3H1.0,32,38,6,308,15,4Htest,1.,2,2HMM,1,0.01,15H20260101.000000,"
      "1.E-6,0.," +
      std::to_string(author.size()) + "H" + author + ",4Hnone,11,0;";
  const ImportResult result = read(frame);
  CHECK(result.report.author == author);
  CHECK(result.report.product == "x,y;z 2Hq");
  CHECK(result.report.organization == "none");
  CHECK(result.report.tolerated.empty());
}

TEST_CASE("strings with a wrong count do not shift what follows") {
  for (const std::string broken : {"3Htest", "7Htest", "9Htest", "33Htest"}) {
    IgesFrame frame;
    frame.global = ",," + broken +
                   ",8Htest.igs,6Hlamina,3H1.0,32,38,6,308,15,4Htest,2.,1,4HINCH,1,0.01,"
                   "15H20260101.000000,1.E-6,0.,2Hme,4Hnone,11,0;";
    const ImportResult result = read(frame);
    INFO(broken);
    CHECK(result.report.unit.millimetres == 25.4);
    CHECK(result.report.model_scale == 2.0);
    CHECK(result.report.author == "me");
    CHECK(tolerated(result.report).find("wrong count") != std::string::npos);
  }
}

TEST_CASE("numbers: D exponents, no point, leading plus, blanks around, lower case") {
  IgesEntity square = kSquare;
  square.parameters =
      "1,1, 1,1 ,0,0,1,0,0,0,0.,1.D0,1.0d+00,0.,0.,+1.,1.e0,1.,10.D-1,1,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,"
      ".1E1,+10.0E-1,0.,0.,1.,0.,1.";
  const ImportResult result = read({}, square);
  CHECK((far_corner(result) - Vector3(1, 1, 0)).norm() < 1e-15);
  CHECK(tolerated(result.report) == "real number without a decimal point @parameter 1 x2\n");
}

TEST_CASE("a number too small for a double is zero") {
  IgesEntity square = kSquare;
  square.parameters =
      "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,1.E-400,1.,0.,-3.D-999,0.,1.,0.,1.,1.,"
      "0.,0.,1.,0.,1.";
  CHECK(evaluate(read({}, square).model.surfaces[0].nurbs, 0.0, 0.0) == Vector3(0, 0, 0));
}

TEST_CASE("data in column 65 and numbers continued on the next line are read and reported") {
  IgesFrame frame;
  frame.data_columns = 65;
  // Lines are cut after a delimiter; a first value of the right length moves one into column 65.
  bool seen = false;
  for (int zeros = 0; zeros < 12; ++zeros) {
    IgesEntity square = kSquare;
    square.parameters = "1,1,1,1,0,0,1,0,0,0." + std::string(static_cast<std::size_t>(zeros), '0') +
                        kSquare.parameters.substr(20);
    const ImportResult result = read(frame, square);
    CHECK((far_corner(result) - Vector3(1, 1, 0)).norm() < 1e-15);
    seen = seen || tolerated(result.report).find("column 65") != std::string::npos;
  }
  CHECK(seen);

  std::string text = iges_text({{118, "3,5,0,0", 1},
                                {110, "0.,0.,0.,1.,0.,0.", 0, 0, "00010000"},
                                {110, "0.,1.,0.,123456.,1.,0.", 0, 0, "00010000"}});
  const auto first = text.find("110,0.,1.,0.,123456.,1.,0.;");
  // Two lines instead of one, the number cut in half: "123" and "456.".
  std::string line = text.substr(first, 80);
  std::string head = line;
  head.replace(0, 64, "110,0.,1.,0.,                                                123");
  std::string tail = line;
  tail.replace(0, 64, "456.,1.,0.;                                                     ");
  text.replace(first, 80, head + "\n" + tail);
  const ImportResult result = read_iges(text, "part.igs");  // the directory counts one line less now
  CHECK(evaluate(result.model.surfaces[0].nurbs, 1.0, 1.0).x() == 123456.0);
  CHECK(tolerated(result.report).find("continued on the next line") != std::string::npos);
}

TEST_CASE("units by flag and by name, and the model scale") {
  struct Case {
    std::string flag;
    std::string name;
    double millimetres;
  };
  const std::vector<Case> cases{
      {"1", "4HINCH", 25.4},    {"1", "2HIN", 25.4},    {"2", "2HMM", 1.0},   {"3", "2HFT", 304.8},
      {"4", "2HFT", 304.8},     {"5", "2HMI", 1609344}, {"6", "1HM", 1000.0}, {"7", "2HKM", 1e6},
      {"8", "3HMIL", 0.0254},   {"9", "2HUM", 0.001},   {"10", "2HCM", 10.0}, {"3", "2Hcm", 10.0},
      {"11", "3HUIN", 2.54e-5}, {"", "", 25.4},         {"", "1HM", 1000.0},  {"3", "4HINCH", 25.4}};
  for (const Case& example : cases) {
    INFO(example.flag + " " + example.name);
    const ImportResult result = read(with_unit("1.", example.flag, example.name));
    CHECK(far_corner(result).x() == Approx(example.millimetres).epsilon(1e-14));
    CHECK(result.report.unit.millimetres == Approx(example.millimetres));
    CHECK(result.report.resolution == Approx(1e-3 * example.millimetres));
    CHECK(result.report.max_coordinate == Approx(500 * example.millimetres));
  }
  // A model drawn at an eighth of the real size.
  CHECK(far_corner(read(with_unit("0.125", "6", "1HM"))).x() == Approx(8000.0));
  CHECK(far_corner(read(with_unit("", "2", "2HMM"))).x() == Approx(1.0));
  const ImportResult conflict = read(with_unit("0.", "1", "2HMM"));
  CHECK(far_corner(conflict).x() == Approx(25.4));
  CHECK(tolerated(conflict.report).find("flag and name differ") != std::string::npos);
  CHECK(tolerated(conflict.report).find("scale not positive") != std::string::npos);
}

TEST_CASE("what is missing or wrong around the sections is reported") {
  IgesFrame frame;
  frame.terminate = false;
  CHECK(tolerated(read(frame).report) == "terminate section missing @file 7 x1\n");

  std::string text = iges_text({kSquare});
  text.insert(text.find("\n") + 1, "\n   \n");
  CHECK(tolerated(read_iges(text, "part.igs").report) == "blank line @file 2 x2\n");

  text = iges_text({kSquare});
  const auto counts = text.find("D      2P");
  text[counts + 7] = '4';
  CHECK(tolerated(read_iges(text, "part.igs").report).find("counts other lines") != std::string::npos);
  text = iges_text({kSquare}) + "what is this\n";
  CHECK(tolerated(read_iges(text, "part.igs").report).find("after the terminate") != std::string::npos);
}

TEST_CASE("what looks like IGES") {
  CHECK(looks_like_iges(iges_text({kSquare})));
  CHECK_FALSE(looks_like_iges(""));
  CHECK_FALSE(looks_like_iges("solid part"));
  CHECK_FALSE(looks_like_iges("ISO-10303-21;\nHEADER;\n" + std::string(200, 'S')));
}
