#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "engine/import/import_error.h"
#include "engine/import/scan/lzf.h"
#include "engine/import/scan/read_pcd.h"
#include "engine/import/scan/read_ply.h"
#include "engine/import/scan/read_xyz.h"
#include "tests/engine/import/peak_memory.h"
#include "tests/engine/import/reading.h"
#include "tests/support/scan_models.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 24;

ScannedPoints sphere(bool with_normals = true) {
  ScanSampling sampling;
  sampling.spacing = 1.0;
  sampling.with_normals = with_normals;
  return scanned_sphere({1.0, 2.0, 3.0}, 4.0, sampling);
}

/// The six numbers of a point, the normal's zero where there is none.
std::vector<float> numbers(const ScannedPoints& points, std::size_t i) {
  const auto& p = points.points[i];
  std::vector<float> all{p.x(), p.y(), p.z()};
  if (!points.normals.empty()) {
    for (const float value : points.normals[i]) all.push_back(value);
  }
  return all;
}

std::string words(const std::vector<float>& values, const std::string& separator = " ") {
  std::string text;
  for (const float value : values) text += (text.empty() ? "" : separator) + fmt::format("{}", value);
  return text;
}

template <typename Number>
void append_number(std::string& bytes, Number value, bool little) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof raw);  // tests run on little-endian machines only
  if (!little) std::reverse(std::begin(raw), std::end(raw));
  bytes.append(raw, sizeof raw);
}

std::string ply(const ScannedPoints& points, const std::string& format) {
  std::string text = "ply\nformat " + format + " 1.0\ncomment a scan\nelement vertex " +
                     std::to_string(points.points.size()) +
                     "\nproperty uchar quality\nproperty float x\nproperty float y\nproperty double z\n";
  if (!points.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  text +=
      "property list uchar int views\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const std::vector<float> values = numbers(points, i);
    if (format == "ascii") {
      text += "7 " + words(values) + " 2 4 5\n";
      continue;
    }
    const bool little = format == "binary_little_endian";
    append_number<std::uint8_t>(text, 7, little);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (k == 2) {
        append_number<double>(text, static_cast<double>(values[k]), little);
      } else {
        append_number(text, values[k], little);
      }
    }
    append_number<std::uint8_t>(text, 2, little);
    append_number<std::int32_t>(text, 4, little);
    append_number<std::int32_t>(text, 5, little);
  }
  return text;
}

/// LZF of literals only.
std::string packed(const std::string& bytes) {
  std::string result;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string piece = bytes.substr(at, 32);
    result += static_cast<char>(piece.size() - 1);
    result += piece;
  }
  return result;
}

std::string pcd(const ScannedPoints& points, const std::string& encoding) {
  const bool normals = !points.normals.empty();
  const std::string count = std::to_string(points.points.size());
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS label x y z";
  text += normals ? " normal_x normal_y normal_z\n" : "\n";
  text += normals ? "SIZE 2 4 4 4 4 4 4\nTYPE U F F F F F F\nCOUNT 1 1 1 1 1 1 1\n"
                  : "SIZE 2 4 4 4\nTYPE U F F F\nCOUNT 1 1 1 1\n";
  text +=
      "WIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + encoding + "\n";
  std::string data;
  const std::size_t columns = normals ? 6 : 3;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    if (encoding == "ascii") data += "3 " + words(numbers(points, i)) + "\n";
    if (encoding != "binary") continue;
    append_number<std::uint16_t>(data, 3, true);
    for (const float value : numbers(points, i)) append_number(data, value, true);
  }
  if (encoding == "binary_compressed") {
    for (std::size_t i = 0; i < points.points.size(); ++i) append_number<std::uint16_t>(data, 3, true);
    for (std::size_t k = 0; k < columns; ++k) {
      for (std::size_t i = 0; i < points.points.size(); ++i) append_number(data, numbers(points, i)[k], true);
    }
    const std::string inside = packed(data);
    append_number(text, static_cast<std::uint32_t>(inside.size()), true);
    append_number(text, static_cast<std::uint32_t>(data.size()), true);
    data = inside;
  }
  return text + data;
}

std::string xyz(const ScannedPoints& points, const std::string& separator) {
  std::string text = "# a scan\n" + std::to_string(points.points.size()) + "\n";
  for (std::size_t i = 0; i < points.points.size(); ++i)
    text += words(numbers(points, i), separator) + "\r\n";
  return text;
}

struct File {
  std::string name;
  std::string bytes;
};

std::vector<File> files(const ScannedPoints& points) {
  return {{"a.ply", ply(points, "ascii")},
          {"l.ply", ply(points, "binary_little_endian")},
          {"b.ply", ply(points, "binary_big_endian")},
          {"a.pcd", pcd(points, "ascii")},
          {"b.pcd", pcd(points, "binary")},
          {"c.pcd", pcd(points, "binary_compressed")},
          {"s.xyz", xyz(points, " ")},
          {"c.xyz", xyz(points, ", ")},
          {"t.xyz", xyz(points, ";")}};
}

ImportResult read(const File& file) {
  if (file.name.ends_with("ply")) return read_ply(file.bytes, file.name);
  if (file.name.ends_with("pcd")) return read_pcd(file.bytes, file.name, kMostBytes);
  return read_xyz(file.bytes, file.name);
}

std::string error_reading(const File& file) {
  try {
    read(file);
  } catch (const ImportError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a scan is the same in every format, to the last bit", "[scan]") {
  for (const bool with_normals : {true, false}) {
    const ScannedPoints points = sphere(with_normals);
    const PointCloud expected = prepare_scan(points).cloud;
    REQUIRE(expected.points.size() == points.points.size());
    for (const File& file : files(points)) {
      INFO(file.name << (with_normals ? " with normals" : ""));
      const bool looks_like =
          looks_like_ply(file.bytes) || looks_like_pcd(file.bytes) || looks_like_xyz(file.bytes);
      CHECK(looks_like);
      const ImportResult result = read(file);
      CHECK(result.model.meshes.empty());
      REQUIRE(result.model.clouds.size() == 1);
      CHECK(result.model.clouds[0].points == expected.points);
      CHECK(result.model.clouds[0].normals == expected.normals);
      REQUIRE(result.report.entities.size() == 1);
      CHECK(result.report.entities[0].count == points.points.size());
    }
  }
}

TEST_CASE("points without a position, or given twice, are left out and counted", "[scan]") {
  ScannedPoints points = sphere();
  const std::size_t good = points.points.size();
  points.points.push_back(points.points.front());
  points.normals.push_back(points.normals.front());
  std::string text = pcd(points, "ascii");
  const auto place = text.find("POINTS ");
  text.replace(place, text.find('\n', place) - place, "POINTS " + std::to_string(points.points.size() + 2));
  text += "3 nan nan nan 0 0 1\n3 nan 1 2 nan nan nan\n";
  const ImportResult result = read({"scan.pcd", text});
  CHECK(result.model.clouds.at(0).points.size() == good);
  const std::string notes = tolerated(result.report);
  CHECK(notes.find("points without a position, left out: 2 points") != std::string::npos);
  CHECK(notes.find("points given more than once: 1 points") != std::string::npos);
}

TEST_CASE("columns of an XYZ file that are no normals are passed over", "[scan]") {
  const ScannedPoints points = sphere(false);
  const PointCloud expected = prepare_scan(points).cloud;
  std::string text;
  for (std::size_t i = 0; i < points.points.size(); ++i)
    text += words(numbers(points, i)) + fmt::format(" {} 128 0 note\n", i % 256);
  const ImportResult result = read({"colours.xyz", text});
  CHECK(result.model.clouds.at(0).normals == expected.normals);
  CHECK(tolerated(result.report).empty());
}

TEST_CASE("a PLY file with faces is a mesh, polygons in fans", "[scan]") {
  const std::string text =
      "ply\r\nformat ascii 1.0\r\nelement face 2\r\nproperty list uchar int vertex_index\r\n"
      "element vertex 5\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\nend_header\r\n"
      "4 0 1 2 3\r\n3 0 1 4\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n0 0 1\r\n";
  const ImportResult result = read({"box.ply", text});
  REQUIRE(result.model.meshes.size() == 1);
  CHECK(result.model.clouds.empty());
  using Facets = std::vector<std::array<std::uint32_t, 3>>;
  CHECK(result.model.meshes[0].facets == Facets{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}});
  CHECK(error_reading({"box.ply", text.substr(0, text.find("3 0 1 4")) + "3 0 1 5\r\n0 0 0\r\n1 0 0\r\n"
                                                                         "1 1 0\r\n0 1 0\r\n0 0 1\r\n"})
            .find("the index 5 of a corner leads to no vertex; the file has 5") != std::string::npos);
}

TEST_CASE("what LZF means", "[scan]") {
  using namespace std::string_literals;
  // Three literals, then nine bytes from three back, which overlap what they make.
  CHECK(inflate_lzf("\x02"
                    "abc"
                    "\xe0\x00\x02"s,
                    12) == "abcabcabcabc");
  // Two literals, three bytes of the first one.
  CHECK(inflate_lzf("\x01"
                    "xy"
                    "\x20\x01"s,
                    5) == "xyxyx");
  CHECK_FALSE(
      inflate_lzf("\x02"
                  "ab"s,
                  3));  // literals cut short
  CHECK_FALSE(
      inflate_lzf("\x00"
                  "a"
                  "\x20\x05"s,
                  4));  // back beyond the beginning
  CHECK_FALSE(
      inflate_lzf("\x02"
                  "abc"s,
                  2));  // more than announced
  CHECK_FALSE(
      inflate_lzf("\x02"
                  "abc"s,
                  4));  // less than announced
  CHECK_FALSE(inflate_lzf("\xe0"s, 9));
}

TEST_CASE("headers of scans are not believed", "[scan]") {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
  };
  const ScannedPoints points = sphere();
  const std::string count = std::to_string(points.points.size());
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string text = ply(points, format);
    INFO(format);
    CHECK(error_reading({"p.ply", replaced(text, "vertex " + count, "vertex 4000000000")})
              .find("no room for them") != std::string::npos);
    CHECK(error_reading({"p.ply", text.substr(0, text.size() - 300)}) != "");
  }
  CHECK(error_reading(
            {"p.ply", replaced(ply(points, "ascii"), "property uchar quality\n", "property half q\n")})
            .find("header line 5: the type \"half\" is not known") != std::string::npos);
  for (const std::string encoding : {"ascii", "binary", "binary_compressed"}) {
    const std::string text = pcd(points, encoding);
    INFO(encoding);
    CHECK(error_reading({"p.pcd", replaced(text, "POINTS " + count, "POINTS 4000000000")})
              .find("announces 4000000000 points, and there is room for ") != std::string::npos);
    CHECK(error_reading({"p.pcd", text.substr(0, text.size() - 300)}) != "");
  }
  CHECK(error_reading({"p.pcd", replaced(pcd(points, "binary"), "SIZE 2 4", "SIZE 2 0")})
            .find("type F and size 0") != std::string::npos);
  CHECK(error_reading({"p.xyz", "1 2 3\n4 5\n"}).find("file line 2: the line has 2 numbers") !=
        std::string::npos);
  CHECK(error_reading({"p.xyz", "1 2 3\n4 five 6\n"}).find("file line 2: \"five\" is not a number") !=
        std::string::npos);
  CHECK(error_reading({"p.xyz", "1 2 3\n4 5 6\n"}).find("holds 2 points without faces, 0 of them usable") !=
        std::string::npos);
}

TEST_CASE("damaged scans are read or refused, within bounds", "[scan]") {
  constexpr unsigned kSeed = 20261122;
  std::mt19937 random(kSeed);
  for (const File& file : files(sphere())) {
    for (int i = 0; i < 60; ++i) {
      std::string bytes = file.bytes;
      const std::size_t header = std::min<std::size_t>(bytes.size(), 400);
      for (int k = 0; k < 3; ++k) {
        // Half of the damage to the header.
        const std::size_t at = random() % (random() % 2 == 0 ? header : bytes.size());
        if (random() % 4 == 0) {
          bytes.erase(at, random() % 8);
        } else {
          bytes[at] = static_cast<char>(random());
        }
        if (bytes.size() <= 400) break;
      }
      INFO(file.name << ", round " << i << " of seed " << kSeed);
      const std::size_t before = start_peak_memory();
      try {
        const ImportResult result = read({file.name, bytes});
        CHECK(result.model.clouds.size() + result.model.meshes.size() == 1);
      } catch (const ImportError& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
      }
      CHECK(peak_memory() - before <= 40 * bytes.size() + (std::size_t{1} << 16));
    }
  }
}
