#include "engine/layer_maker.h"

#include <utility>

#include "engine/contour/layer_curves.h"

namespace lamina::engine {
namespace {

/// Sub-patches are not divided below this part of epsilon.
constexpr double kSmallestCell = 0.1;

}  // namespace

LayerMaker::LayerMaker(const SliceOptions& options)
    : options_(options),
      patch_section_({options.chord_part * options.epsilon, kSmallestCell * options.epsilon}),
      meetings_(options.epsilon) {}

LayerChains LayerMaker::chains(const FrontState& front, double z, LayerReport& report) {
  const double began = now();
  section_.clear();
  for (const auto& patch : front.active) patch_section_.cut(*patch, z, section_);
  report.active_patches = front.active.size();
  report.patches_added = front.added;
  report.patches_removed = front.removed;
  report.cells = section_.cells;
  report.unresolved_cells = section_.unresolved_cells;
  report.arcs = section_.arcs.size();
  report.nodes = section_.nodes.size();
  const double cut = now();
  LayerChains chains = make_chains(section_, options_, meetings_, report);
  report.components = chains.closed.size() + chains.open.size() + chains.touch_curves.size() +
                      chains.faces.size() + chains.touch_points.size();
  report.seconds.section = cut - began;
  report.seconds.contours = now() - cut;
  return chains;
}

Layer LayerMaker::make(const FrontState& front, const SlicePlane& plane, std::size_t index) {
  LayerReport report;
  const LayerChains found = chains(front, plane.z, report);
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
