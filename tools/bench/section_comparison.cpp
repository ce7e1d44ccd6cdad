#include "tools/bench/section_comparison.h"

#include <algorithm>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "tools/bench/child_run.h"
#include "tools/bench/filled_section.h"
#include "tools/bench/opencascade_sections.h"
#include "tools/bench/section_picture.h"

namespace lamina::tools {
namespace {

/// Of the interval between heights: off level faces, which lie at round parts of a model's height.
constexpr double kPlaceInInterval = 0.4142;

// Lengths as parts of the model's diagonal, since files come in all sizes.
constexpr double kEpsilonPart = 1e-3;
constexpr double kFlatPart = 1e-3;  // of epsilon: what is measured is the curves
constexpr double kBridgePart = 0.04;
constexpr double kChordPart = 1e-5;  // of OpenCASCADE's curves
constexpr double kMeshPart = 1e-4;   // of its triangles

constexpr unsigned kPatience = 300;         // s that OpenCASCADE gets for a file
constexpr std::ptrdiff_t kChildValues = 6;  // of a height

/// What both cut a model with.
struct Cut {
  const CorpusModel& file;
  double size = 0.0;  ///< the model's diagonal, mm
  std::vector<engine::SlicePlane> planes;
  FillOptions fill;
};

SectionNumbers numbers_of(const FilledSection& section) {
  return {engine::area(section.region), static_cast<double>(section.contours),
          static_cast<double>(section.open_lines)};
}

std::vector<FilledSection> our_sections(const engine::Model& model, const Cut& cut) {
  engine::SliceOptions options;
  options.epsilon = kEpsilonPart * cut.size;
  options.longest_bridge = cut.fill.longest_bridge;
  engine::Slicer slicer(model, cut.planes, options);
  std::vector<FilledSection> sections;
  while (const auto layer = slicer.next())
    sections.push_back(filled_section(*layer, kFlatPart * options.epsilon));
  return sections;
}

void draw(const Cut& cut, std::size_t k, const FilledSection& ours, const LinesBySolid& theirs,
          const std::filesystem::path& folder) {
  std::vector<engine::Polyline> lines;
  for (const auto& [solid, more] : theirs) lines.insert(lines.end(), more.begin(), more.end());
  if (lines.empty() && ours.region.empty()) return;
  std::string name = fmt::format("{}_{:02}.svg", cut.file.name, k);
  std::replace(name.begin(), name.end(), '/', '_');
  std::ofstream(folder / name) << section_picture(ours.region, lines,
                                                  fmt::format("{} z {}", cut.file.name, cut.planes[k].z));
}

/// In the child: what OpenCASCADE makes of the file, six numbers a height.
std::vector<double> their_numbers(const Cut& cut, const std::vector<FilledSection>& ours,
                                  const std::filesystem::path& pictures) {
  OpencascadeModel model(cut.file.file);
  model.make_triangles(kMeshPart * cut.size);
  std::vector<double> values;
  for (std::size_t k = 0; k < cut.planes.size(); ++k) {
    const double z = cut.planes[k].z;
    const LinesBySolid triangles = model.triangle_lines(z);
    const LinesBySolid curves = model.has_faces() ? model.section_lines(z, kChordPart * cut.size) : triangles;
    for (const LinesBySolid& lines : {curves, triangles}) {
      const SectionNumbers numbers = numbers_of(filled_section(lines, cut.fill));
      values.insert(values.end(), {numbers.area, numbers.contours, numbers.open_lines});
    }
    if (!pictures.empty()) draw(cut, k, ours[k], curves, pictures);
  }
  return values;
}

}  // namespace

std::vector<SectionComparison> compare_sections(const CorpusModel& file,
                                                const std::filesystem::path& pictures) {
  const engine::Model model = engine::read_model(file.file).model;
  const engine::Box3 box = engine::model_bounds(model);
  Cut cut{file, box.diagonal().norm(), {}, {}};
  cut.fill = {kBridgePart * cut.size, engine::SliceOptions().chord_part * kEpsilonPart * cut.size};
  for (int k = 0; k < kSectionHeights; ++k) {
    const double z = box.min().z() + (k + kPlaceInInterval) / kSectionHeights * box.sizes().z();
    cut.planes.push_back({z, z, z});
  }
  const std::vector<FilledSection> ours = our_sections(model, cut);
  const ChildRun theirs = run_in_child([&] {
    alarm(kPatience);
    return their_numbers(cut, ours, pictures);
  });
  std::vector<SectionComparison> comparisons;
  auto value = theirs.values.begin();
  for (std::size_t k = 0; k < cut.planes.size(); ++k, value += kChildValues) {
    comparisons.push_back({cut.planes[k].z,
                           numbers_of(ours[k]),
                           {value[0], value[1], value[2]},
                           {value[3], value[4], value[5]}});
  }
  return comparisons;
}

}  // namespace lamina::tools
