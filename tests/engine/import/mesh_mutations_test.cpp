#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/import/import_error.h"
#include "engine/import/obj/read_obj.h"
#include "engine/import/stl/read_stl.h"
#include "engine/import/threemf/read_3mf.h"
#include "tests/engine/import/mesh_shapes.h"
#include "tests/engine/import/peak_memory.h"
#include "tests/engine/import/zip_writer.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

constexpr std::uint32_t kSeed = 20261122;

/// Damages bytes in one of several ways; all choices come from `random`, so a seed repeats them.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t bound) { return bound == 0 ? 0 : random() % bound; };
  static const std::vector<std::string> kWords{"nan",  "-1", "4294967295", "1e999", "0x7",
                                               "\\\n", "/",  "<",          "'",     " "};
  const std::size_t rounds = 1 + below(4);
  for (std::size_t i = 0; i < rounds && bytes.size() > 8; ++i) {
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, below(16));
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(64)));
        break;
      default:
        bytes.replace(at, 1, kWords[below(kWords.size())]);
    }
  }
  return bytes;
}

/// Reads; whatever comes out must keep what the reader promises.
template <typename Read>
void survives(const std::string& bytes, const Read& read, std::size_t memory_per_byte) {
  const std::size_t before = start_peak_memory();
  try {
    const ImportResult result = read(bytes);
    REQUIRE(!result.model.meshes.empty());
    for (const TriangleMesh& mesh : result.model.meshes) {
      for (const auto& facet : mesh.facets) {
        for (const std::uint32_t v : facet) {
          if (v >= mesh.vertices.size()) FAIL("an index leads nowhere");
          if (!mesh.vertices[v].allFinite()) FAIL("a vertex is not finite");
        }
      }
    }
  } catch (const ImportError& error) {
    if (std::string(error.what()).find("part: ") != 0)
      FAIL("the error does not name the file: " << error.what());
  }
  if (peak_memory() - before > memory_per_byte * bytes.size() + (1U << 20U)) FAIL("too much memory");
}

const std::string kObj =
    "# a cube\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvt 0 0\nvn 0 "
    "0 1\n"
    "f 1 4 3 2\nf 5/1/1 6/1/1 7/1/1 8/1/1\nf 1//1 2//1 6//1 5//1\nf -7 \\\n -6 -2 -3\nf 3 4 8 7\n";

const std::string kText =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1.5e0 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
    "a\n";

const std::string kModel =
    "<?xml version='1.0'?><model unit='inch'><resources><object id='1'><mesh><vertices><vertex x='0' y='0' "
    "z='0'/>"
    "<vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/></vertices><triangles><triangle v1='0' v2='1' "
    "v3='2'/>"
    "</triangles></mesh></object><object id='2'><components><component objectid='1'/><component objectid='1' "
    "transform='1 0 0 0 1 0 0 0 1 3 0 0'/></components></object></resources><build><item "
    "objectid='2'/></build></model>";

}  // namespace

TEST_CASE("damaged mesh files are read or refused, never worse") {
  INFO("seed " << kSeed);
  std::mt19937 random(kSeed);
  const std::string binary = binary_stl(tetrahedron(), "solid");
  const auto stl = [](const std::string& bytes) { return read_stl(bytes, "part"); };
  const auto obj = [](const std::string& bytes) { return read_obj(bytes, "part"); };
  const auto package = [](const std::string& bytes) { return read_3mf(bytes, "part", 1U << 20U); };
  for (int i = 0; i < 4000; ++i) {
    survives(damaged(binary, random), stl, 8);
    survives(damaged(kText, random), stl, 8);
    survives(damaged(kObj, random), obj, 16);
  }
  const std::string zipped = zip_of({{"3D/3dmodel.model", kModel}});
  for (int i = 0; i < 1500; ++i) {
    survives(damaged(zipped, random), package, 64);
    survives(zip_of({{"3D/3dmodel.model", damaged(kModel, random)}}), package, 64);
  }
}

TEST_CASE("mesh files cut at every length are read or refused") {
  const std::string binary = binary_stl(tetrahedron());
  for (const std::string& file : {binary, kText}) {
    for (std::size_t length = 0; length <= file.size(); ++length)
      survives(
          file.substr(0, length), [](const std::string& bytes) { return read_stl(bytes, "part"); }, 8);
  }
  for (std::size_t length = 0; length <= kObj.size(); ++length)
    survives(
        kObj.substr(0, length), [](const std::string& bytes) { return read_obj(bytes, "part"); }, 16);
}
