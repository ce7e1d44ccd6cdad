#pragma once

/// The model of a bead: seen across, a rectangle of width - height with a half disc of the layer's thickness
/// on either side, the model that PrusaSlicer's users know (its manual, Flow math). Beads laid side by side
/// at bead_spacing fill a layer exactly: spacing * height = area, the overlap of two half discs pays for the
/// voids above and below it.
namespace lamina::gcode {

/// Cross-section of a bead, mm^2. Lengths in mm, width >= height > 0.
double bead_area(double width, double height);

/// Distance between parallel beads that fill a layer exactly, mm: width - height (1 - pi/4).
double bead_spacing(double width, double height);

/// The width whose spacing is this: the inverse of bead_spacing.
double bead_width(double spacing, double height);

}  // namespace lamina::gcode
