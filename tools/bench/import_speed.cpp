// How fast IGES files are read, in MB of file a second, and OpenCASCADE on the same files where it was found.
// Surfaces of both are compared at random parameters.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "tools/bench/opencascade_iges.h"

namespace {

using namespace lamina;

template <typename Read>
double fastest_seconds(int runs, const Read& read) {
  double best = 1e9;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    read();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Speed of reading IGES");
  bool quick = false;
  std::vector<std::string> files{"seed/vertebra504.igs", "seed/skullmask1260.igs", "real/bearing.iges",
                                 "real/hammer.iges"};
  app.add_flag("--quick", quick, "One small file, one run");
  app.add_option("FILES", files, "Files of the corpus");
  CLI11_PARSE(app, argc, argv);
  if (quick) files = {"real/RLF_12545.igs"};
  fmt::print("{:28} {:>8} {:>10} {:>9} {:>13} {:>8} {:>16}\n", "file", "MB", "lamina s", "MB/s",
             "OpenCASCADE s", "times", "points apart mm");
  for (const std::string& name : files) {
    const std::filesystem::path path = std::filesystem::path(LAMINA_CORPUS_DIR) / name;
    if (!std::filesystem::exists(path)) {
      fmt::print("{:28} missing\n", name);
      continue;
    }
    const double megabytes = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
    engine::ImportResult result;
    const double ours = fastest_seconds(quick ? 1 : 5, [&] { result = engine::read_model(path); });
    fmt::print("{:28} {:8.2f} {:10.4f} {:9.1f}", name, megabytes, ours, megabytes / ours);
    const auto theirs = tools::read_with_opencascade(path, result.model, quick ? 1 : 3);
    if (theirs) {
      fmt::print(" {:13.3f} {:8.1f} {:>16}\n", theirs->seconds, theirs->seconds / ours,
                 theirs->compared > 0 ? fmt::format("{:.1e} ({})", theirs->largest_distance, theirs->compared)
                                      : std::string("-"));
    } else {
      fmt::print(" {:>13} {:>8} {:>16}\n", "-", "-", "-");
    }
  }
  return 0;
}
