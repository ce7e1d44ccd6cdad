// Sections of every file of the corpus by lamina and by OpenCASCADE, which reads the file itself: areas and
// number of closed contours at heights off the level faces.
//
// OpenCASCADE's curves of plane and faces count. What may differ, and why, stands in section_exceptions.cpp,
// with OpenCASCADE's own triangles of the same faces as the referee; an exception that is not needed any more
// is an error as well.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/bench/corpus_models.h"
#include "tools/bench/measurement.h"
#include "tools/bench/opencascade_sections.h"
#include "tools/bench/section_comparison.h"
#include "tools/bench/section_exceptions.h"

namespace {

using namespace lamina;
using tools::SectionComparison;
using tools::SectionNumbers;

constexpr double kWithin = 1e-3;           // of the area
constexpr double kTrianglesWithin = 2e-3;  // their chords are off themselves

const std::vector<std::string> kExtensions{".igs", ".iges", ".stp", ".step", ".brep", ".stl"};
const std::vector<std::string> kQuickParts{"analytic/box_hole.igs",   "entities/trim144_both_rounded.igs",
                                           "mesh/bracket_broken.stl", "parts/part_bracket_186.igs",
                                           "real/as1-tu-203.stp",     "real_fetched/test_pipe.igs"};

double apart(const SectionNumbers& ours, const SectionNumbers& theirs) {
  if (ours.area == theirs.area) return 0.0;
  return std::abs(ours.area - theirs.area) / std::max(ours.area, theirs.area);
}

enum class Verdict { kSame, kListed, kUnexplained, kNotNeeded };

struct Judged {
  Verdict verdict = Verdict::kSame;
  std::string reason;  ///< of the exception
};

Judged judged(const std::string& file, int height, const SectionComparison& at) {
  const bool same = apart(at.ours, at.curves) <= kWithin && at.ours.contours == at.curves.contours;
  for (const tools::SectionException& exception : tools::section_exceptions()) {
    const auto& heights = exception.heights;
    if (exception.file != file || std::find(heights.begin(), heights.end(), height) == heights.end())
      continue;
    if (same) return {Verdict::kNotNeeded, "the exception is not needed any more: " + exception.reason};
    const bool holds = !exception.triangles_agree || apart(at.ours, at.triangles) <= kTrianglesWithin;
    return {holds ? Verdict::kListed : Verdict::kUnexplained, exception.reason};
  }
  return {same ? Verdict::kSame : Verdict::kUnexplained, ""};
}

void print_height(std::size_t k, const SectionComparison& at) {
  const auto text = [](const SectionNumbers& section) {
    return fmt::format("{:.7g} ({}{})", section.area, section.contours,
                       section.open_lines > 0 ? fmt::format(", {} open", section.open_lines) : "");
  };
  fmt::print("    {:2} z {:<11.6g} lamina {:18} curves {:24} triangles {}\n", k, at.z, text(at.ours),
             text(at.curves), text(at.triangles));
}

/// Whether all is as it should be.
bool report(const std::string& file, const std::vector<SectionComparison>& heights, bool verbose) {
  double worst = 0.0;
  double worst_triangles = 0.0;
  std::array<std::size_t, 4> counts{};
  std::vector<Judged> verdicts;
  std::vector<double> contours;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const SectionComparison& at = heights[k];
    verdicts.push_back(judged(file, static_cast<int>(k), at));
    ++counts.at(static_cast<std::size_t>(verdicts.back().verdict));
    contours.push_back(at.ours.contours);
    worst_triangles = std::max(worst_triangles, apart(at.ours, at.triangles));
    if (verdicts.back().verdict != Verdict::kListed) worst = std::max(worst, apart(at.ours, at.curves));
  }
  const auto [same, listed, unexplained, not_needed] = counts;
  const auto [fewest, most] = std::minmax_element(contours.begin(), contours.end());
  fmt::print("{:40} {:>3}..{:<3} {:9.5f} {:9.4f}  {:2} same{}{}\n", file, *fewest, *most, 100.0 * worst,
             100.0 * worst_triangles, same, listed > 0 ? fmt::format(", {} listed", listed) : "",
             unexplained + not_needed > 0 ? fmt::format(", {} WRONG", unexplained + not_needed) : "");
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const bool told = k > 0 && verdicts[k - 1].reason == verdicts[k].reason;
    if (!told && !verdicts[k].reason.empty()) fmt::print("  {}\n", verdicts[k].reason);
    if (verdicts[k].verdict != Verdict::kSame || verbose) print_height(k, heights[k]);
  }
  return unexplained + not_needed == 0;
}

int run(int argc, char** argv) {
  CLI::App app("Sections of the corpus by lamina and by OpenCASCADE");
  std::string corpus = LAMINA_CORPUS_DIR;
  std::vector<std::string> parts;
  std::string pictures;
  bool verbose = false;
  bool quick = false;
  app.add_option("PARTS", parts, "Only files whose path contains one of these");
  app.add_option("--corpus", corpus, "Folder of the corpus");
  app.add_option("--pictures", pictures, "Folder for a picture of every height");
  app.add_flag("--verbose", verbose, "Every height");
  app.add_flag("--quick", quick, "A few files only");
  CLI11_PARSE(app, argc, argv);
  constexpr int kSkipped = 77;
  if (quick) parts = kQuickParts;
  const auto files = tools::corpus_models(corpus, parts, kExtensions);
  if (!tools::has_opencascade() || files.empty()) {
    fmt::print("the corpus and OpenCASCADE are needed: skipped\n");
    return kSkipped;
  }
  if (!pictures.empty()) std::filesystem::create_directories(pictures);
  fmt::print("{:40} {:>8} {:>9} {:>9}  {}\n", "", "", "area off", "from", "heights of");
  fmt::print("{:40} {:>8} {:>9} {:>9}  {}\n", "file", "contours", "%", "triangles", tools::kSectionHeights);
  bool all_well = true;
  for (const tools::CorpusModel& file : files) {
    try {
      all_well = report(file.name, tools::compare_sections(file, pictures), verbose) && all_well;
    } catch (const std::exception& error) {
      fmt::print("{:40} {}\n", file.name, error.what());
      all_well = false;
    }
    std::fflush(stdout);
  }
  return all_well ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return tools::run_measurement(run, argc, argv);
}
