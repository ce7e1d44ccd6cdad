#include "engine/import/read_model.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include "engine/import/gzip.h"
#include "tests/engine/import/mesh_shapes.h"
#include "tests/engine/import/reading.h"
#include "tests/engine/import/zip_writer.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

const std::string kText =
    iges_text({{128,
                "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,"
                "0.,1.,1.,0.,0.,1.,0.,1."}});

std::string gzipped(const std::string& text) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string packed(deflateBound(&stream, text.size()) + 64, '\0');
  std::string input = text;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// A folder of its own that goes when the test ends.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("lamina-import-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

  std::filesystem::path path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string error_reading(const std::filesystem::path& path) {
  try {
    read_model(path);
  } catch (const ImportError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("plain and gzip files, whatever they are called, give the same model") {
  const Folder folder;
  for (const auto& [name, bytes] :
       std::vector<std::pair<std::string, std::string>>{{"wheel.igs", kText},
                                                        {"wheel.IGES", kText},
                                                        {"wheel.igs.gz", gzipped(kText)},
                                                        {"wheel.igs", gzipped(kText)},
                                                        {"wheel.dat", kText},
                                                        {"wheel", kText}}) {
    INFO(name);
    const ImportResult result = read_model(folder.write(name, bytes));
    CHECK(result.model.name == "wheel");
    CHECK(result.model.surfaces.size() == 1);
    CHECK(result.report.format == "IGES");
  }
}

TEST_CASE("content says what a file is, before its name does") {
  const Folder folder;
  const std::string stl = binary_stl(tetrahedron(), "solid");
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string package = zip_of(
      {{"3D/3dmodel.model",
        "<model><resources><object id='1'><mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' "
        "z='0'/><vertex x='0' y='1' z='0'/></vertices><triangles><triangle v1='0' v2='1' "
        "v3='2'/></triangles></mesh></object></resources><build><item objectid='1'/></build></model>"}});
  for (const auto& [name, bytes, format] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"part.stl", stl, "STL (binary)"},
           {"part.igs", stl, "STL (binary)"},
           {"part.STL.gz", gzipped(stl), "STL (binary)"},
           {"part.obj", obj, "OBJ"},
           {"part", obj, "OBJ"},
           {"part.3mf", package, "3MF"},
           {"part.stl", package, "3MF"}}) {
    INFO(name << " holding " << format);
    const ImportResult result = read_model(folder.write(name, bytes));
    CHECK(result.model.name == "part");
    CHECK(result.report.format == format);
    CHECK(result.model.meshes.size() == 1);
  }
}

TEST_CASE("scans are known by their content as well") {
  const Folder folder;
  std::string points;
  for (int i = 0; i < 100; ++i) points += fmt::format("{} {} {}\n", i % 10, i / 10, i * i % 7);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 100\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n" +
      points;
  const std::string pcd =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 100\nHEIGHT 1\nPOINTS 100\nDATA "
      "ascii\n" +
      points;
  for (const auto& [name, bytes, format] :
       std::vector<std::tuple<std::string, std::string, std::string>>{{"part.ply", ply, "PLY"},
                                                                      {"part.xyz", ply, "PLY"},
                                                                      {"part.pcd.gz", gzipped(pcd), "PCD"},
                                                                      {"part", pcd, "PCD"},
                                                                      {"part.xyz", points, "XYZ"},
                                                                      {"part", points, "XYZ"}}) {
    INFO(name << " holding " << format);
    const ImportResult result = read_model(folder.write(name, bytes));
    CHECK(result.report.format == format);
    CHECK(result.model.clouds.size() == 1);
  }
}

TEST_CASE("files of no known format are refused with what they are") {
  const Folder folder;
  CHECK(error_reading(folder.path() / "none.igs").find("none.igs: no such file") == 0);
  CHECK(error_reading(folder.path()).find("is a folder") != std::string::npos);
  CHECK(error_reading(folder.write("empty.igs", "")) == "empty.igs: is empty");
  CHECK(error_reading(folder.write("part.dat", "1 2 3\n")).find("no model format that lamina knows") !=
        std::string::npos);
  CHECK(error_reading(folder.write("part.igs", "1 2 3\n")).find("part.igs: file line 1") == 0);
  CHECK(error_reading(folder.write("part.stl", "1 2 3\n")).find("part.stl: is no STL file") == 0);
  CHECK(error_reading(folder.write("part.obj", "1 2 3\n")).find("part.obj: nothing to slice") == 0);
  CHECK(
      error_reading(folder.write("part.3mf", "1 2 3\n")).find("part.3mf: the ZIP archive cannot be opened") ==
      0);
}

TEST_CASE("gzip: several members, damage, and a bound on the size") {
  const std::string text(300000, 'x');
  const std::string packed = gzipped(text);
  CHECK(inflate_gzip(packed, "a.gz", 1 << 20) == text);
  CHECK(inflate_gzip(packed + gzipped("end"), "a.gz", 1 << 20) == text + "end");
  CHECK(inflate_gzip(packed, "a.gz", text.size()) == text);
  CHECK_THROWS_WITH(inflate_gzip(packed, "a.gz", text.size() - 1),
                    Catch::StartsWith("a.gz: inflates to more than 299999 bytes"));
  CHECK_THROWS_WITH(inflate_gzip(packed.substr(0, packed.size() / 2), "a.gz", 1 << 20),
                    Catch::Contains("cut short"));
  std::string damaged = packed;
  for (std::size_t i = 20; i < 60 && i < damaged.size(); ++i)
    damaged[i] = static_cast<char>(damaged[i] ^ 0x5a);
  CHECK_THROWS_AS(inflate_gzip(damaged, "a.gz", 1 << 20), ImportError);
}
