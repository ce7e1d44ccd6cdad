#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "engine/model.h"

namespace lamina::tools {

/// OpenCASCADE's reading of an IGES file beside ours.
struct OpencascadeReading {
  double seconds = 0.0;           ///< the fastest run, parsing and transfer
  double largest_distance = 0.0;  ///< between surfaces at the same random parameters, mm
  std::size_t compared = 0;       ///< surfaces that are B-splines in both, untrimmed, in the same order
};

/// Nothing where OpenCASCADE was not found when this was built.
std::optional<OpencascadeReading> read_with_opencascade(const std::filesystem::path& path,
                                                        const engine::Model& model, int runs);

}  // namespace lamina::tools
