#pragma once

#include <functional>
#include <string>

#include "engine/model.h"
#include "engine/scan/prepare_scan.h"

namespace lamina::tests {

/// Points at random on a surface, as many as `spacing` means: one to spacing^2 mm^2.
struct ScanSampling {
  double spacing = 0.5;      ///< mm
  double noise = 0.0;        ///< standard deviation along the normal, mm
  bool with_normals = true;  ///< outwards
  unsigned seed = 20261122;
  /// Points that are not seen; none where empty.
  std::function<bool(const engine::Vector3&)> hidden = {};
};

engine::ScannedPoints scanned_sphere(const engine::Vector3& center, double radius,
                                     const ScanSampling& sampling);

/// Around the z axis.
engine::ScannedPoints scanned_torus(double middle_radius, double tube_radius, const ScanSampling& sampling);

/// A model of one scan.
engine::Model model_of(engine::ScannedPoints scanned);

}  // namespace lamina::tests
