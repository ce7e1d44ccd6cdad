#pragma once

namespace lamina::engine {

/// How the model is cut and traced.
struct SliceOptions {
  double layer_thickness = 0.2;  ///< lambda, mm: sets the size of the patches
  double epsilon = 0.05;         ///< side of a grid cell and accuracy inside a layer, mm
  int degree = 2;                ///< of the fitted curves, 1 to 9
  int band_constant = 3;         ///< c: layers that a patch spans on average, greater than one
  double oversampling = 2.0;     ///< C_over, 1 to 10
  double most_cells = 2e9;       ///< a layer grid larger than this is refused, not allocated
};

/// Where inside its layer a plane cuts. The dissertation cuts at the bottom; the middle halves the stair-step
/// error and is the default for printing.
enum class SlicePosition { kBottom, kMiddle, kTop };

/// Where the slicing planes lie.
struct SlicingPlanesOptions {
  double layer_thickness = 0.2;        ///< lambda, mm
  double first_layer_thickness = 0.0;  ///< mm; 0: as the others
  SlicePosition position = SlicePosition::kMiddle;
};

}  // namespace lamina::engine
