#pragma once

#include <cstddef>
#include <vector>

#include "engine/layer.h"
#include "engine/layer_maker.h"
#include "engine/model.h"
#include "engine/slicer.h"

namespace lamina::tests {

struct ReportedChains {
  engine::LayerChains chains;
  engine::LayerReport report;
};

/// The chains of one plane through a model, and what was counted.
ReportedChains reported_chains_at(const engine::Model& model, double z, const engine::SliceOptions& options);

/// The chains of one plane through a model.
engine::LayerChains chains_at(const engine::Model& model, double z, double epsilon,
                              const engine::SliceOptions& options = {});

/// The closed chains' positions as loops.
std::vector<engine::Loop> loops_of(const engine::LayerChains& chains);

/// Distance of a point from the nearest loop, mm.
double distance_to_loops(const engine::Vector2& point, const std::vector<engine::Loop>& loops);

/// Greatest distance of any node of one set of loops from the other set, both ways, mm.
double greatest_difference(const std::vector<engine::Loop>& a, const std::vector<engine::Loop>& b);

/// How many contours of each kind, and how deep they nest.
struct Kinds {
  std::size_t closed = 0;
  std::size_t touching = 0;  ///< closed or open touch curves
  std::size_t open = 0;
  std::size_t planar = 0;
  std::size_t holes = 0;  ///< of planar contours
  std::size_t points = 0;
  std::vector<std::size_t> depths;  ///< of the closed contours, ascending

  bool operator==(const Kinds&) const = default;
};

Kinds kinds_of(const engine::Layer& layer, double tolerance);

}  // namespace lamina::tests
