#include "engine/layer_maker.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/contour/layer_curves.h"
#include "engine/contour/slab_chains.h"
#include "engine/model.h"
#include "engine/pointcloud/facet_section.h"
#include "engine/pointcloud/scan_section.h"
#include "engine/pointcloud/trim_edges.h"

namespace lamina::engine {
namespace {

/// Sub-patches are not divided below this part of epsilon.
constexpr double kSmallestCell = 0.1;
/// Rounds of halving the distance of a slab's sections.
constexpr int kMostSlabRounds = 7;
/// How far from a level face a section is that does not touch it, mm.
constexpr double kInside = 10.0 * kModelTolerance;

void add_flaws(LayerReport& report, const LayerReport& more) {
  report.dropped_pieces += more.dropped_pieces;
  report.dropped_length += more.dropped_length;
  report.bridged_gaps.insert(report.bridged_gaps.end(), more.bridged_gaps.begin(), more.bridged_gaps.end());
  report.open_gaps.insert(report.open_gaps.end(), more.open_gaps.begin(), more.open_gaps.end());
}

}  // namespace

LayerMaker::LayerMaker(const SliceOptions& options, SolidNumbers solids)
    : options_(options),
      solids_(std::move(solids)),
      patch_section_({options.chord_part * options.epsilon, kSmallestCell * options.epsilon}),
      meetings_(options.epsilon) {}

LayerChains LayerMaker::chains(const FrontState& front, double z, LayerReport& report) {
  const double began = now();
  section_.clear();
  for (const auto& patch : front.patches) {
    const SectionMark mark = mark_of(section_);
    patch_section_.cut(*patch, z, section_);
    if (patch->trim() != nullptr) section_trimmer_.trim(section_, mark, *patch, z);
  }
  for (const auto& region : front.regions) {
    add_trim_edges(section_, *region, z, options_.chord_part * options_.epsilon);
  }
  for (const FrontFacet& facet : front.facets)
    cut_facet(facet, SolidNumbers::surface_of_mesh(facet.mesh), z, section_);
  for (std::size_t k = 0; k < front.scans.size(); ++k) {
    const std::uint32_t number = SolidNumbers::surface_of_scan(static_cast<std::uint32_t>(k));
    for (const BridgedGap& hole : cut_scan(front.scans[k], number, z, options_.longest_bridge, section_))
      report.bridged_gaps.push_back(hole);
  }
  report.active_patches = front.patches.size();
  report.active_facets = front.facets.size();
  report.patches_added = front.added;
  report.patches_removed = front.removed;
  report.cells = section_.cells;
  report.unresolved_cells = section_.unresolved_cells;
  report.arcs = section_.arcs.size();
  report.nodes = section_.nodes.size();
  const double cut = now();
  LayerChains chains = make_chains(section_, solids_, options_, meetings_, report);
  report.components = chains.closed.size() + chains.open.size() + chains.touch_curves.size() +
                      chains.faces.size() + chains.touch_points.size();
  report.seconds.section = cut - began;
  report.seconds.contours = now() - cut;
  return chains;
}

LayerChains LayerMaker::slab_chains(const FrontState& front, const SlicePlane& plane, LayerReport& report) {
  LayerChains nominal = chains(front, plane.z, report);
  const auto section_at = [&](double z) {
    LayerReport beside;
    LayerChains section = chains(front, z, beside);
    add_flaws(report, beside);
    return section;
  };
  // The ends belong to the slabs next to this one as well: what lies exactly in them is met from within.
  const double low = plane.bottom + kInside;
  const double high = plane.top - kInside;
  std::vector<double> heights{low, high};
  for (const auto& patch : front.patches) {
    if (patch->span.z_max - patch->span.z_min > kModelTolerance) continue;
    for (const double z : {patch->span.z_min - kInside, patch->span.z_max + kInside}) {
      if (z > low && z < high) heights.push_back(z);
    }
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(
      std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < 0.5 * kInside; }),
      heights.end());
  std::vector<LayerChains> sections;
  for (const double z : heights) sections.push_back(section_at(z));

  // Sections halfway between show how much the layer lacks, until that is little.
  const double strip = options_.chord_part * options_.epsilon;
  LayerChains slab;
  slab.open = std::move(nominal.open);
  for (int round = 0;; ++round) {
    slab.closed = contain_sections(sections, options_.containment, strip);
    if (round == kMostSlabRounds) break;
    double deepest = 0.0;
    std::vector<double> finer;
    for (std::size_t k = 1; k < heights.size(); ++k) {
      finer.push_back(0.5 * (heights[k - 1] + heights[k]));
      LayerChains section = section_at(finer.back());
      deepest = std::max(deepest, breach(slab.closed, section, options_.containment));
      sections.push_back(std::move(section));
    }
    if (round > 0 && deepest <= strip) {
      slab.closed = contain_sections(sections, options_.containment, strip);
      break;
    }
    heights.insert(heights.end(), finer.begin(), finer.end());
    std::sort(heights.begin(), heights.end());
  }
  return slab;
}

Layer LayerMaker::make(const FrontState& front, const SlicePlane& plane, std::size_t index) {
  LayerReport report;
  const LayerChains found = options_.containment == Containment::kNominal ? chains(front, plane.z, report)
                                                                          : slab_chains(front, plane, report);
  const double began = now();
  Layer layer = make_curves(found, options_);
  layer.index = index;
  layer.plane = plane;
  report.control_points = layer.report.control_points;
  report.greatest_fit_distance = layer.report.greatest_fit_distance;
  report.seconds.fit = now() - began;
  layer.report = std::move(report);
  return layer;
}

}  // namespace lamina::engine
