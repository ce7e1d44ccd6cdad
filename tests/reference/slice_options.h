#pragma once

namespace lamina::reference {

/// How the dense method cuts and traces a model.
struct SliceOptions {
  double layer_thickness = 0.2;  ///< lambda, mm: sets the size of the patches
  double epsilon = 0.05;         ///< side of a grid cell and accuracy inside a layer, mm
  int degree = 2;                ///< of the fitted curves, 1 to 9
  int band_constant = 3;         ///< c: layers that a patch spans on average, greater than one
  double oversampling = 2.0;     ///< C_over, 1 to 10
  double most_cells = 2e9;       ///< a layer grid larger than this is refused, not allocated
};

}  // namespace lamina::reference
