#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/layer.h"
#include "engine/model.h"
#include "tools/cli/json.h"

namespace lamina::tools {

/// The Bezier patches of a model (the dissertation's table 6.2). A patch's extent is the mean of the longest
/// polygons of its net along u and along v (p. 118), mm.
struct PatchFigures {
  std::size_t surfaces = 0;
  std::size_t patches = 0;
  double average_extent = 0.0;
  double extent_deviation = 0.0;  ///< standard deviation
};

PatchFigures patch_figures(const engine::Model& model);

/// Seconds, or whatever the slicing's clock counted, by stage.
struct StageTotals {
  double front = 0.0;     ///< decomposing, global and active list, and all that is in no other stage
  double section = 0.0;   ///< cutting patches
  double contours = 0.0;  ///< linking, bridging, uniting, planar faces
  double fit = 0.0;
};

/// One layer's row of table A.1, and more.
struct SliceReportRow {
  std::size_t index = 0;
  double z = 0.0;       ///< mm
  double length = 0.0;  ///< of all contours, mm
  engine::LayerReport report;
};

/// What was counted and timed while a model was sliced: the data of the dissertation's tables 6.2 and A.1 and
/// of its figures 6.6, 6.9, 7.3 and 7.4.
struct SliceReport {
  std::string model;
  double epsilon = 0.0;          ///< mm
  double layer_thickness = 0.0;  ///< mm; 0 where layers differ
  PatchFigures patches;
  double seconds = 0.0;         ///< from the model to the last layer, as the slicing's clock says
  double peak_megabytes = 0.0;  ///< resident memory of the whole process up to now
  std::vector<SliceReportRow> layers;

  void add(const engine::Layer& layer);
  StageTotals stage_seconds() const;
};

Json to_json(const SliceReport& report);

/// Highest resident memory of this process so far.
double peak_megabytes_so_far();

}  // namespace lamina::tools
