#pragma once

namespace lamina::engine {

/// What a layer stands for: the section at its plane, or one that contains (or is contained in) every section
/// of its slab (dissertation, chapter five).
enum class Containment { kNominal, kPositive, kNegative };

/// How the model is cut and its contours are made into curves.
struct SliceOptions {
  double epsilon = 0.05;     ///< tolerance: side of a grid cell and the accuracy promised in a layer, mm
  double chord_part = 0.05;  ///< greatest distance of chords between nodes from the section, part of epsilon
  double fit_part = 0.05;    ///< greatest distance of the fitted curves from the section, part of epsilon
  int greatest_degree = 5;   ///< of the fitted curves, 2 to 5
  double longest_bridge = 2.0;  ///< gaps up to this are closed and reported, mm
  Containment containment = Containment::kNominal;
  bool unite_all = false;       ///< every chain goes through the arrangement, whether it meets another or not
  int threads = 1;              ///< that make layers at the same time; 0: one a core
  double (*clock)() = nullptr;  ///< seconds from any start; where given, the stages' times are reported
};

/// Where inside its layer a plane cuts. The dissertation cuts at the bottom; the middle halves the stair-step
/// error and is the default for printing.
enum class SlicePosition { kBottom, kMiddle, kTop };

/// Layers whose thickness follows the slope of the surface.
struct AdaptiveOptions {
  bool enabled = false;
  double least_thickness = 0.08;    ///< mm
  double greatest_thickness = 0.3;  ///< mm
  double cusp_height = 0.05;        ///< greatest distance of the layers' edges from the surface, mm
  double greatest_ratio = 1.5;      ///< of neighbouring layers' thickness, above 1
};

/// Where the slicing planes lie.
struct SlicingPlanesOptions {
  double layer_thickness = 0.2;        ///< lambda, mm
  double first_layer_thickness = 0.0;  ///< mm; 0: as the others
  SlicePosition position = SlicePosition::kMiddle;
  AdaptiveOptions adaptive = {};
};

}  // namespace lamina::engine
