#include "tools/cli/pipeline.h"

#include <stdexcept>

#include <fmt/format.h>

#include "engine/slicing_planes.h"
#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

constexpr double kNarrowArea = 1.0;  // mm^2: the tips of sharp corners add up to less

void append_counted(std::vector<std::string>& warnings, std::size_t count, const std::string& what) {
  if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
}

}  // namespace

ModelGcode::ModelGcode(const PlacedModel& placed, const profiles::Settings& settings)
    : slicer_(placed.model, slicing_planes(placed.bounds, settings.planes), settings.slice),
      stream_(settings.gcode, {placed.bounds, slicer_.layer_count()}) {}

std::optional<std::vector<std::string>> ModelGcode::next() {
  switch (step_) {
    case Step::kHeader:
      step_ = Step::kLayers;
      return stream_.begin();
    case Step::kLayers:
      if (const std::optional<engine::Layer> layer = slicer_.next()) {
        ++layers_sliced_;
        flaws_.unfitted_curves += layer->report.unfitted_curves;
        flaws_.dropped_spurs += layer->report.dropped_spurs;
        flaws_.empty_layers += layer->closed.empty() && layer->planar.empty() ? 1 : 0;
        return stream_.push(*layer);
      }
      step_ = Step::kDone;
      return stream_.finish();
    case Step::kDone:
      break;
  }
  return std::nullopt;
}

std::vector<engine::SlicePlane> slicing_planes(const engine::Box3& bounds,
                                               const engine::SlicingPlanesOptions& options) {
  try {
    return engine::make_slicing_planes(bounds.min().z(), bounds.max().z(), options);
  } catch (const std::invalid_argument& error) {
    throw Failure(ExitCode::kGeometry, error.what());
  }
}

std::vector<std::string> slicing_warnings(const SlicingFlaws& flaws) {
  std::vector<std::string> warnings;
  append_counted(warnings, flaws.empty_layers, "layers are empty: the model has no area there");
  append_counted(warnings, flaws.unfitted_curves,
                 "contours are polylines: no smooth curve came within the tolerance");
  append_counted(warnings, flaws.dropped_spurs, "boundary cells were left aside as dead ends");
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
