#pragma once

#include <cstddef>

#include "tests/reference/grid/layer_grid.h"

namespace lamina::reference {

using namespace engine;

/// Thins lines of boundary cells that enclose nothing, such as touch curves and the walls of an open model,
/// to one cell: their cells all border the exterior, so the outline alone would run along both sides. Cells
/// whose removal changes neither connection (8-connectivity number one; Yokoi, Toriwaki and Fukumura, 1975)
/// nor an end are taken off side by side until none is left. Beyond the dissertation, whose polyominoes thin
/// corners only. Returns how many were taken out.
std::size_t thin_lines(LayerGrid& grid);

}  // namespace lamina::reference
