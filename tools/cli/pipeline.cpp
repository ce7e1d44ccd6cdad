#include "tools/cli/pipeline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "engine/slicing_planes.h"
#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

constexpr double kSlopeBins = 0.25;    // width of the slope profile's bins in least thicknesses
constexpr double kNoticedGap = 0.001;  // mm: less is the rounding of the file
constexpr double kNarrowArea = 1.0;    // mm^2: the tips of sharp corners add up to less

void append_counted(std::vector<std::string>& warnings, std::size_t count, const std::string& what) {
  if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
}

}  // namespace

void SlicingFlaws::add(const engine::Layer& layer) {
  const auto widest_of = [&](const std::vector<engine::BridgedGap>& gaps, engine::BridgedGap& widest,
                             double& z) {
    std::size_t wide = 0;
    for (const engine::BridgedGap& gap : gaps) {
      if (gap.width() < kNoticedGap) continue;
      ++wide;
      if (gap.width() <= widest.width()) continue;
      widest = gap;
      z = layer.plane.z;
    }
    return wide;
  };
  bridged_gaps += widest_of(layer.report.bridged_gaps, widest_bridge, widest_bridge_z);
  open_gaps += widest_of(layer.report.open_gaps, widest_gap, widest_gap_z);
  const bool open = std::any_of(layer.open.begin(), layer.open.end(),
                                [](const engine::OpenContour& contour) { return !contour.touch; });
  if (open) {
    if (open_layers++ == 0) lowest_open_z = layer.plane.z;
    highest_open_z = layer.plane.z;
  }
  dropped_length += layer.report.dropped_length;
  empty_layers += layer.closed.empty() && layer.planar.empty() ? 1 : 0;
}

ModelGcode::ModelGcode(const PlacedModel& placed, const profiles::Settings& settings)
    : layers_(plan_layers(placed.model, placed.bounds, settings.planes)),
      slicer_(placed.model, layers_.planes, settings.slice),
      stream_(settings.gcode, {placed.bounds, slicer_.layer_count()}) {
  flaws_.missed_faces = layers_.missed_faces;
  clock_ = settings.slice.clock;
  if (clock_ == nullptr) return;
  report_.model = placed.model.name;
  report_.epsilon = settings.slice.epsilon;
  report_.layer_thickness = settings.planes.adaptive.enabled ? 0.0 : settings.planes.layer_thickness;
  report_.patches = patch_figures(placed.model);
}

std::optional<engine::Layer> ModelGcode::next_layer() {
  if (clock_ == nullptr) return slicer_.next();
  const double before = clock_();
  std::optional<engine::Layer> layer = slicer_.next();
  report_.seconds += clock_() - before;
  if (layer) report_.add(*layer);
  return layer;
}

std::optional<std::vector<std::string>> ModelGcode::next() {
  switch (step_) {
    case Step::kHeader:
      step_ = Step::kLayers;
      return stream_.begin();
    case Step::kLayers:
      if (const std::optional<engine::Layer> layer = next_layer()) {
        ++layers_sliced_;
        flaws_.add(*layer);
        return stream_.push(*layer);
      }
      step_ = Step::kDone;
      return stream_.finish();
    case Step::kDone:
      break;
  }
  return std::nullopt;
}

engine::AdaptivePlanes plan_layers(const engine::Model& model, const engine::Box3& bounds,
                                   const engine::SlicingPlanesOptions& options) {
  const double bottom = bounds.min().z();
  const double top = bounds.max().z();
  try {
    if (!options.adaptive.enabled) return {engine::make_slicing_planes(bottom, top, options)};
    const double bin = kSlopeBins * options.adaptive.least_thickness;
    return engine::make_adaptive_planes(engine::measure_slopes(model, bottom, top, bin), top, options);
  } catch (const std::invalid_argument& error) {
    throw Failure(ExitCode::kGeometry, error.what());
  }
}

std::vector<std::string> slicing_warnings(const SlicingFlaws& flaws) {
  std::vector<std::string> warnings;
  append_counted(warnings, flaws.empty_layers, "layers are empty: the model has no area there");
  append_counted(warnings, flaws.missed_faces,
                 "level faces lie nearer to each other than layer.least_height: layers do not meet them");
  if (flaws.open_layers > 0) {
    warnings.push_back(
        fmt::format("the model is not closed in {} layers between z = {:.3f} and z = {:.3f} mm",
                    flaws.open_layers, flaws.lowest_open_z, flaws.highest_open_z));
  }
  const auto append_gaps = [&](std::size_t count, const char* what, const engine::BridgedGap& widest,
                               double z) {
    if (count == 0) return;
    const engine::Vector2 middle = 0.5 * (widest.from + widest.to);
    warnings.push_back(fmt::format("{} {}; the widest, {:.3f} mm, at x = {:.3f}, y = {:.3f}, z = {:.3f} mm",
                                   count, what, widest.width(), middle.x(), middle.y(), z));
  };
  append_gaps(flaws.bridged_gaps, "gaps in the model were bridged", flaws.widest_bridge,
              flaws.widest_bridge_z);
  append_gaps(flaws.open_gaps,
              "ends of contours stay open, with no end that faces them within slicing.longest_bridge",
              flaws.widest_gap, flaws.widest_gap_z);
  if (flaws.open_gaps > 0) {
    constexpr double kStep = 0.1;  // mm
    warnings.back() += fmt::format(" (slicing.longest_bridge={:.1f} closes gaps of this width)",
                                   kStep * (std::floor(flaws.widest_gap.width() / kStep) + 1.0));
  }
  return warnings;
}

std::vector<std::string> print_warnings(const SlicingFlaws& flaws, const gcode::PrintTotals& totals) {
  std::vector<std::string> warnings = slicing_warnings(flaws);
  append_counted(warnings, totals.open_contours,
                 "open contours bound no area and were left out: is the model closed?");
  append_counted(warnings, totals.crossing_contours,
                 "pairs of contours cross: where solids overlap, their union counts");
  if (totals.narrow_area >= kNarrowArea) {
    warnings.push_back(fmt::format("{:.2f} mm^2 of all layers are too narrow for a wall and stay empty",
                                   totals.narrow_area));
  }
  if (totals.volume == 0.0)
    warnings.emplace_back("nothing is extruded: the model is thinner than a line everywhere");
  return warnings;
}

}  // namespace lamina::tools
