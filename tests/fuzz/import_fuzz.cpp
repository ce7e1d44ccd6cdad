// One fuzz target for each reader: LAMINA_FUZZ_READ names the call, the bytes are the file. What a reader
// throws as ImportError is its answer; anything else is a finding.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/import/gzip.h"
#include "engine/import/iges/read_iges.h"
#include "engine/import/import_error.h"
#include "engine/import/obj/read_obj.h"
#include "engine/import/scan/read_pcd.h"
#include "engine/import/scan/read_ply.h"
#include "engine/import/scan/read_xyz.h"
#include "engine/import/stl/read_stl.h"
#include "engine/import/threemf/read_3mf.h"

namespace {

using namespace lamina::engine;

constexpr std::size_t kMostBytes = std::size_t{1} << 24;

[[maybe_unused]] void iges(std::string_view bytes) {
  read_iges(bytes, "fuzz");
}
[[maybe_unused]] void stl(std::string_view bytes) {
  read_stl(bytes, "fuzz");
}
[[maybe_unused]] void obj(std::string_view bytes) {
  read_obj(bytes, "fuzz");
}
[[maybe_unused]] void package(std::string_view bytes) {
  read_3mf(bytes, "fuzz", kMostBytes);
}
[[maybe_unused]] void ply(std::string_view bytes) {
  read_ply(bytes, "fuzz");
}
[[maybe_unused]] void pcd(std::string_view bytes) {
  read_pcd(bytes, "fuzz", kMostBytes);
}
[[maybe_unused]] void xyz(std::string_view bytes) {
  read_xyz(bytes, "fuzz");
}
[[maybe_unused]] void gzip(std::string_view bytes) {
  inflate_gzip(bytes, "fuzz", kMostBytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    LAMINA_FUZZ_READ({reinterpret_cast<const char*>(data), size});
  } catch (const ImportError&) {
    // refused, as it should be
  }
  return 0;
}
