#include <catch2/catch.hpp>

#include "engine/import/import_error.h"
#include "engine/import/obj/read_obj.h"
#include "tests/engine/import/mesh_shapes.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

/// The unit cube by its six faces, outwards.
const std::string kCube =
    "# a cube\nmtllib cube.mtl\no cube\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1 1.0\nv 1 1 1 0.5 0.5 0.5\nv 0 1 1\n"
    "vt 0 0\nvn 0 0 1\ns off\nusemtl red\n"
    "f 1 4 3 2\nf 5/1/1 6/1/1 7/1/1 8/1/1\nf 1//1 2//1 6//1 5//1\nf 2/1 3/1 7/1 6/1\nf 3 4 8 7 # back\n";

std::string error_reading(const std::string& text) {
  try {
    read_obj(text, "part.obj");
  } catch (const ImportError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("OBJ: polygons, all forms of corners, negative indices, continued lines, comments") {
  for (const std::string last :
       {"f 4 1 5 8\n", "f -5 -8 -4 -1", "f 4 1 \\\n 5 8\n", "f 4 1\\\r\n5\\\r\n8\r\n"}) {
    INFO(last);
    const ImportResult result = read_obj(kCube + last, "part.obj");
    REQUIRE(result.model.meshes.size() == 1);
    CHECK(result.model.meshes[0].facets.size() == 12);
    CHECK(result.model.meshes[0].vertices.size() == 8);
    CHECK(six_volumes(result.model.meshes[0]) == Approx(6.0));
    CHECK(result.report.tolerated.empty());
    CHECK(result.report.format == "OBJ");
  }
}

TEST_CASE("OBJ: faces may come before their vertices; equal vertices are one") {
  const ImportResult result =
      read_obj("f 1 2 3\nf 4 5 6\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 0 0 1\n", "part.obj");
  CHECK(result.model.meshes[0].vertices.size() == 4);
  CHECK(result.model.meshes[0].facets[1][0] == 0);
}

TEST_CASE("OBJ: what is wrong is named with its line, what is strange is reported") {
  using Catch::Contains;
  CHECK_THAT(error_reading("v 0 0 0\nv 1 0\n"), Contains("part.obj: file line 2: the coordinate \"\""));
  CHECK_THAT(error_reading("v 0 0 x\n"), Contains("\"x\" is not a number"));
  CHECK_THAT(error_reading("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), Contains("line 4: the index 4"));
  CHECK_THAT(error_reading("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n"), Contains("the index -4"));
  CHECK_THAT(error_reading("v 0 0 0\nf 0 1 1\n"), Contains("the index 0"));
  CHECK_THAT(error_reading("v 0 0 0\nf a b c\n"), Contains("does not begin with an index"));
  CHECK_THAT(error_reading("v 0 0 0\nf 99999999999 1 1\n"), Contains("leads to no vertex"));
  CHECK_THAT(error_reading("v 0 0 0\nsurf 0 1 0 1 1 2 3\n"), Contains("free-form surfaces only"));
  CHECK_THAT(error_reading("v 0 0 0\n"), Contains("no usable face"));

  const ImportResult result =
      read_obj(kCube + "v nan 0 0\nf 1 2 9\nf 1 2\nwhatever 1 2 \\\n3\nbmat u 1 \\\n 2 3\n", "part.obj");
  CHECK(result.model.meshes[0].facets.size() == 10);
  CHECK(result.report.tolerated.size() == 3);
}

TEST_CASE("OBJ: recognised by its statements") {
  CHECK(looks_like_obj(kCube));
  CHECK(looks_like_obj("\n# x\nv 1 2 3\n"));
  CHECK_FALSE(looks_like_obj("solid x\nfacet normal 0 0 1\n"));
  CHECK_FALSE(looks_like_obj("1 2 3\n4 5 6\n"));
  CHECK_FALSE(looks_like_obj("v very nice\n"));
  CHECK_FALSE(looks_like_obj(""));
}
