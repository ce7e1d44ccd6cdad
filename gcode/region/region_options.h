#pragma once

namespace lamina::gcode {

/// How contours become filled area.
struct RegionOptions {
  /// Largest distance between a contour and the chain of chords that stands for it, mm; positive.
  double tolerance = 0.005;
  /// Grows (positive) or shrinks (negative) every region in the plane, mm.
  double xy_compensation = 0.0;
  /// Shrinks the first layer, which the bed squeezes out, mm; not negative.
  double elephant_foot = 0.0;
};

}  // namespace lamina::gcode
