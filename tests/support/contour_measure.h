#pragma once

#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/layer.h"
#include "tests/support/analytic_models.h"

namespace lamina::tests {

/// Area between closed loops that do not cross, filled by parity, mm^2.
double parity_area(const std::vector<engine::Loop>& loops);

/// The closed contours of a layer as loops, flattened to `tolerance`.
std::vector<engine::Loop> closed_loops(const engine::Layer& layer, double tolerance);

/// Sum of the loops' perimeters, mm.
double perimeter_of(const std::vector<engine::Loop>& loops);

/// How far any point of the loops lies from the section's curves, mm.
double greatest_distance_from(const Section& section, const std::vector<engine::Loop>& loops);

/// How far any point of the section's curves, taken every `step`, lies from the loops, mm.
double greatest_distance_to(const Section& section, const std::vector<engine::Loop>& loops, double step);

}  // namespace lamina::tests
