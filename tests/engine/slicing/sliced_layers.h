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

}  // namespace lamina::tests
