#include <array>

#include <fmt/format.h>

#include "engine/import/byte_order.h"
#include "engine/import/import_error.h"
#include "engine/import/mesh/coordinate.h"
#include "engine/import/mesh/vertex_welder.h"
#include "engine/import/stl/stl_forms.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kCountOffset = 80;
constexpr std::size_t kCornersOffset = 12;  ///< behind the normal

/// Number of facets to read: the stated one, or what is there where no number was filled in.
std::size_t facets_to_read(std::string_view bytes, const std::string& file, BreachLog& log) {
  const std::size_t stated = binary_stl_count(bytes);
  const std::size_t room = (bytes.size() - kBinaryStlHeader) / kBinaryStlFacet;
  const std::size_t left_over = (bytes.size() - kBinaryStlHeader) % kBinaryStlFacet;
  const bool never_filled_in = stated == 0 || stated == 0xffffffffU;
  if (never_filled_in && room > 0 && left_over == 0) {
    log.note("number of facets never filled in, taken from the size of the file", "header", 1);
    return room;
  }
  if (stated > room) {
    throw ImportError(
        {.file = file},
        fmt::format("the header announces {} facets, and there are {}: the file is cut short", stated, room),
        "copy or export it again");
  }
  if (bytes.size() != kBinaryStlHeader + stated * kBinaryStlFacet) {
    log.note("bytes behind the last facet, left out", "facet", stated + 1);
  }
  return stated;
}

}  // namespace

std::uint32_t binary_stl_count(std::string_view bytes) {
  return load<std::uint32_t>(bytes.data() + kCountOffset, std::endian::little);
}

TriangleMesh read_binary_stl(std::string_view bytes, const std::string& file, BreachLog& log) {
  const std::size_t count = facets_to_read(bytes, file, log);
  TriangleMesh mesh;
  mesh.facets.reserve(count);
  VertexWelder welder;
  for (std::size_t i = 0; i < count; ++i) {
    const char* at = bytes.data() + kBinaryStlHeader + i * kBinaryStlFacet + kCornersOffset;
    std::array<Eigen::Vector3f, 3> corners;
    for (Eigen::Vector3f& corner : corners) {
      for (float& coordinate : corner) {
        coordinate = load<float>(at, std::endian::little);
        at += sizeof(float);
      }
    }
    if (!is_usable(corners[0]) || !is_usable(corners[1]) || !is_usable(corners[2])) {
      log.note("facet with a coordinate that is no number within 1e9, left out", "facet", i + 1);
      continue;
    }
    mesh.facets.push_back(
        {welder.index_of(corners[0]), welder.index_of(corners[1]), welder.index_of(corners[2])});
  }
  mesh.vertices = welder.take_vertices();
  return mesh;
}

}  // namespace lamina::engine
