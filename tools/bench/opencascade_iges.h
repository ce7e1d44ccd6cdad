#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "engine/model.h"

namespace lamina::tools {

/// OpenCASCADE's reading of an IGES file beside ours.
struct OpencascadeReading {
  double seconds = 0.0;           ///< the fastest run, parsing and transfer
  std::size_t faces = 0;          ///< that it made
  double largest_distance = 0.0;  ///< of our surfaces from its own, at random parameters, mm
  std::size_t farthest = 0;       ///< the surface with that distance
};

/// Each of our surfaces is measured against the face of the same place in the file; where that is another
/// one, or none, against the nearest. Nothing where OpenCASCADE was not found when this was built.
std::optional<OpencascadeReading> read_with_opencascade(const std::filesystem::path& path,
                                                        const engine::Model& model, int runs);

}  // namespace lamina::tools
