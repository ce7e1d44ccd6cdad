#include <catch2/catch.hpp>

#include "engine/import/import_error.h"
#include "engine/import/threemf/read_3mf.h"
#include "tests/engine/import/mesh_shapes.h"
#include "tests/engine/import/peak_memory.h"
#include "tests/engine/import/zip_writer.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

constexpr std::size_t kRoom = std::size_t{1} << 28;

const std::string kRelationships =
    R"(<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">)"
    R"(<Relationship Target="/3D/part.model" Id="r0" )"
    R"(Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";

const std::string kTetrahedron =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>"
    "<vertex x='0' y='0' z='1'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/>"
    "<triangle v1='0' v2='1' v3='3'/><triangle v1='0' v2='3' v3='2'/><triangle v1='1' v2='2' v3='3' pid='1'/>"
    "</triangles></mesh>";

std::string model(const std::string& resources, const std::string& build,
                  const std::string& unit = "millimeter") {
  return "<?xml version='1.0' encoding='UTF-8'?><model unit='" + unit +
         "' xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02' xmlns:p='urn:p'><resources>" +
         resources + "</resources><build>" + build + "</build></model>";
}

std::string package(const std::string& text) {
  return zip_of(
      {{"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", kRelationships}, {"3D/part.model", text}});
}

std::string object(int id, const std::string& content, const std::string& more = {}) {
  return "<object id='" + std::to_string(id) + "' " + more + ">" + content + "</object>";
}

std::string error_reading(const std::string& bytes) {
  try {
    read_3mf(bytes, "part.3mf", kRoom);
  } catch (const ImportError& error) {
    return error.what();
  }
  return {};
}

std::string error_in(const std::string& resources, const std::string& build) {
  return error_reading(package(model(resources, build)));
}

Box3 box_of(const TriangleMesh& mesh) {
  Box3 box;
  for (const auto& vertex : mesh.vertices) box.extend(vertex.cast<double>());
  return box;
}

}  // namespace

TEST_CASE("3MF: units, placements of items and components, one mesh for each use") {
  const std::string parts =
      object(1, kTetrahedron) +
      object(2,
             "<components><component objectid='1'/>"
             "<component objectid='1' transform='0 2 0 -2 0 0 0 0 2 10 0 0'/></components>");
  const ImportResult result = read_3mf(
      package(model(parts, "<item objectid='2' transform='1 0 0 0 1 0 0 0 1 0 0 5'/><item objectid='1'/>",
                    "inch")),
      "part.3mf", kRoom);
  REQUIRE(result.model.meshes.size() == 3);
  for (std::uint32_t k = 0; k < 3; ++k) CHECK(result.model.meshes[k].solid == k + 1);
  CHECK(result.report.unit.millimetres == 25.4);
  const double inch3 = 25.4 * 25.4 * 25.4;
  CHECK(six_volumes(result.model.meshes[0]) == Approx(inch3));
  CHECK(six_volumes(result.model.meshes[1]) == Approx(8 * inch3));
  CHECK(six_volumes(result.model.meshes[2]) == Approx(inch3));
  // A quarter turn about z, twice the size, 10 along x inside the item, which is lifted by 5.
  const Box3 box = box_of(result.model.meshes[1]);
  CHECK((box.min() - 25.4 * Vector3(8, 0, 5)).norm() < 1e-4);
  CHECK((box.max() - 25.4 * Vector3(10, 2, 7)).norm() < 1e-4);
}

TEST_CASE("3MF: parts in other files, upper case and usual names, files without a build") {
  const std::string root = model(object(7,
                                        "<components><component objectid='1' p:path='/3D/Objects/a.model'/>"
                                        "</components>"),
                                 "<item objectid='7'/>");
  const ImportResult result =
      read_3mf(zip_of({{"3D/3dmodel.model", root},
                       {"3D/Objects/A.model", model(object(1, kTetrahedron), "", "centimeter")}}),
               "part.3mf", kRoom);
  REQUIRE(result.model.meshes.size() == 1);
  CHECK(six_volumes(result.model.meshes[0]) == Approx(1000.0));
  const ImportResult unbuilt = read_3mf(
      package(model(object(1, kTetrahedron) + object(2, "<components><component objectid='1'/></components>"),
                    "")),
      "part.3mf", kRoom);
  CHECK(unbuilt.model.meshes.size() == 1);
  CHECK(unbuilt.report.tolerated.size() == 1);
}

TEST_CASE("3MF: supports and items that are not printable are left out and reported") {
  const ImportResult result =
      read_3mf(package(model(object(1, kTetrahedron) + object(2, kTetrahedron, "type='support'"),
                             "<item objectid='1'/><item objectid='2'/><item objectid='1' printable='0'/>")),
               "part.3mf", kRoom);
  CHECK(result.model.meshes.size() == 1);
  CHECK(result.report.tolerated.size() == 2);
}

TEST_CASE("3MF: what is wrong is one clear error") {
  using Catch::Contains;
  const std::string one = object(1, kTetrahedron);
  CHECK_THAT(error_in(one, "<item objectid='3'/>"), Contains("there is no object 3"));
  CHECK_THAT(error_in(one + one, "<item objectid='1'/>"), Contains("object 1 is there twice"));
  CHECK_THAT(
      error_in(object(1, "<components><component objectid='1'/></components>"), "<item objectid='1'/>"),
      Contains("contain each other"));
  CHECK_THAT(error_in(object(1, "<mesh><triangles><triangle v1='0' v2='1' v3='2'/></triangles></mesh>"), ""),
             Contains("names vertex 0, and the object has 0"));
  CHECK_THAT(error_in(object(1, "<mesh><vertices><vertex x='0' y='nan' z='0'/></vertices></mesh>"), ""),
             Contains("no number within 1e9 mm"));
  CHECK_THAT(error_in(object(1, "<mesh><vertices><vertex x='0' z='0'/></vertices></mesh>"), ""),
             Contains("the attribute \"y\" is missing"));
  CHECK_THAT(error_in(one, "<item objectid='1' transform='1 0 0'/>"), Contains("a number of the transform"));
  CHECK_THAT(error_in(object(1, ""), "<item objectid='1'/>"), Contains("nothing to slice"));
  CHECK_THAT(error_reading(package(model(one, "", "parsec"))), Contains("the unit \"parsec\" is not known"));
  CHECK_THAT(error_reading(package("<model><resources>")), Contains("not well-formed"));
  CHECK_THAT(error_reading(package("<!DOCTYPE model [<!ENTITY a 'b'>]><model/>")), Contains("document type"));
  CHECK_THAT(error_reading(zip_of({{"a.txt", "hello"}})), Contains("without a 3D model"));
  CHECK_THAT(error_reading("PK\x03\x04 and no more"), Contains("ZIP archive cannot be opened"));
  const std::string whole = package(model(one, "<item objectid='1'/>"));
  for (std::size_t length = 0; length < whole.size(); length += 7)
    CHECK(!error_reading(whole.substr(0, length)).empty());
}

TEST_CASE("3MF: neither a ZIP bomb nor components of components take memory without bound") {
  const std::string bomb = package(std::string(50'000'000, ' '));
  std::size_t before = start_peak_memory();
  CHECK_THROWS_WITH(read_3mf(bomb, "bomb.3mf", 1'000'000), Catch::Contains("inflates to more bytes"));
  CHECK(peak_memory() - before < 2'000'000);

  std::string objects = object(1, kTetrahedron);
  for (int i = 2; i < 30; ++i) {
    std::string components;
    for (int k = 0; k < 10; ++k) components += "<component objectid='" + std::to_string(i - 1) + "'/>";
    objects += object(i, "<components>" + components + "</components>");
  }
  before = start_peak_memory();
  CHECK_THAT(error_in(objects, "<item objectid='29'/>"), Catch::Contains("unfold to more triangles"));
  CHECK(peak_memory() - before < 400'000'000);
}
