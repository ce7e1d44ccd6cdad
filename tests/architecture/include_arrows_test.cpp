// Reads every #include of the project and fails on an arrow that the design does not allow.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = LAMINA_SOURCE_DIR;
const std::vector<std::string> kFolders{"engine", "gcode", "transport", "profiles", "tools"};

struct Include {
  std::string from;    ///< path from the root
  std::string target;  ///< as written
  bool quoted = false;
};

std::vector<Include> includes_of(const fs::path& file) {
  std::vector<Include> includes;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const auto hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line.compare(hash, 8, "#include") != 0) continue;
    const auto open = line.find_first_of("\"<", hash);
    const auto close = line.find_first_of("\">", open + 1);
    REQUIRE(close != std::string::npos);
    includes.push_back({fs::relative(file, kRoot).generic_string(), line.substr(open + 1, close - open - 1),
                        line[open] == '"'});
  }
  return includes;
}

std::vector<Include> all_includes() {
  std::vector<Include> includes;
  for (const std::string& folder : kFolders) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      const auto more = includes_of(entry.path());
      includes.insert(includes.end(), more.begin(), more.end());
    }
  }
  return includes;
}

std::string folder_of(const std::string& path) {
  return path.substr(0, path.find('/'));
}

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

bool ends_with(const std::string& text, const std::string& suffix) {
  return text.size() >= suffix.size() &&
         text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
}

/// What profiles may see of a stage: the options that it fills.
bool is_option_header(const std::string& target) {
  return ends_with(target, "_options.h") || target == "gcode/motion/machine_limits.h" ||
         target == "gcode/print_volume.h";
}

bool arrow_allowed(const std::string& from, const std::string& target) {
  const std::string source = folder_of(from);
  const std::string destination = folder_of(target);
  if (source == destination || source == "tools") return true;
  if (source == "gcode") return target == "engine/layer.h" || starts_with(target, "engine/geometry/");
  if (source == "profiles") return is_option_header(target);
  return false;
}

}  // namespace

TEST_CASE("the rules themselves: allowed and forbidden arrows are told apart", "[architecture]") {
  CHECK(arrow_allowed("gcode/plan/walls.cpp", "engine/layer.h"));
  CHECK(arrow_allowed("gcode/plan/walls.cpp", "engine/geometry/polygon.h"));
  CHECK_FALSE(arrow_allowed("gcode/plan/walls.cpp", "engine/slicer.h"));
  CHECK_FALSE(arrow_allowed("gcode/plan/walls.cpp", "transport/port/port.h"));
  CHECK_FALSE(arrow_allowed("engine/slicer.cpp", "gcode/toolpath.h"));
  CHECK_FALSE(arrow_allowed("transport/port/port.h", "engine/layer.h"));
  CHECK(arrow_allowed("profiles/resolve.cpp", "engine/slice_options.h"));
  CHECK_FALSE(arrow_allowed("profiles/resolve.cpp", "engine/slicer.h"));
  CHECK_FALSE(arrow_allowed("engine/slicer.cpp", "tools/preview/svg.h"));
  CHECK(arrow_allowed("tools/cli/main.cpp", "profiles/profile.h"));
}

TEST_CASE("every include follows an allowed arrow and is written from the root", "[architecture]") {
  const std::vector<Include> includes = all_includes();
  REQUIRE(includes.size() > 100);
  for (const Include& include : includes) {
    if (!include.quoted) continue;
    INFO(include.from << " includes " << include.target);
    // Only measurements and tests know the dense method and the solids that they compare with.
    const bool yardstick =
        starts_with(include.from, "tools/bench/") &&
        (starts_with(include.target, "tests/reference/") || starts_with(include.target, "tests/support/"));
    const bool ours =
        yardstick || std::find(kFolders.begin(), kFolders.end(), folder_of(include.target)) != kFolders.end();
    CHECK(ours);
    CHECK((fs::exists(kRoot / include.target) || ends_with(include.target, ".inc")));
    CHECK(arrow_allowed(include.from, include.target));
  }
}

TEST_CASE("each third-party library stands behind one file", "[architecture]") {
  const std::vector<std::string> adapted{
      "polyclipping/clipper.hpp", "libserialport.h", "toml++/toml.h", "zlib.h", "png.h", "zip.h", "expat.h"};
  const auto library_of = [&](const std::string& header) -> std::string {
    if (std::find(adapted.begin(), adapted.end(), header) != adapted.end()) return header;
    if (starts_with(header, "oneapi/tbb/")) return "oneTBB";
    if (ends_with(header, ".hxx")) return "OpenCASCADE";
    return {};
  };
  std::map<std::string, std::set<std::string>> users;
  for (const Include& include : all_includes()) {
    // A measurement may ask OpenCASCADE for the same, to compare.
    if (include.quoted || starts_with(include.from, "tools/bench/")) continue;
    const std::string library = library_of(include.target);
    if (!library.empty()) users[library].insert(include.from);
  }
  for (const auto& [library, files] : users) {
    INFO(library << " is included by " << files.size() << " files, one of them " << *files.begin());
    CHECK(files.size() == 1);
  }
}

TEST_CASE("libraries neither print nor exit", "[architecture]") {
  const std::vector<std::string> rim_headers{"iostream", "cstdio", "fmt/color.h"};
  for (const Include& include : all_includes()) {
    if (include.quoted || folder_of(include.from) == "tools") continue;
    INFO(include.from << " includes " << include.target);
    CHECK(std::find(rim_headers.begin(), rim_headers.end(), include.target) == rim_headers.end());
  }
}
