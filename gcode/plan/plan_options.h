#pragma once

#include <cstddef>

namespace lamina::gcode {

/// Widths of a bead, mm: what a line covers seen from above, ends and flanks rounded (see bead.h). Each is at
/// least the layer's thickness.
struct WidthOptions {
  double first_layer = 0.45;  ///< Every role on the first layer; 0 = the role's own width.
  double outer_wall = 0.45;
  double inner_wall = 0.45;
  double sparse_infill = 0.45;
  double solid_infill = 0.45;
  double top_surface = 0.40;
};

enum class WallOrder { kInnerFirst, kOuterFirst };

/// Where a closed wall starts and ends.
enum class SeamPosition {
  kAligned,  ///< Near the seam of the layer below, on a corner where there is one.
  kRear,     ///< The largest y.
  kNearest,  ///< Near where the nozzle is.
};

struct WallOptions {
  std::size_t loops = 3;
  WallOrder order = WallOrder::kInnerFirst;
  SeamPosition seam = SeamPosition::kAligned;
};

/// How deep below a top surface and above a bottom surface the infill is solid: at least so many layers and
/// at least so thick.
struct ShellOptions {
  std::size_t top_layers = 5;
  std::size_t bottom_layers = 4;
  double top_min_thickness = 0.7;     ///< mm; no effect when top_layers is 0.
  double bottom_min_thickness = 0.5;  ///< mm; no effect when bottom_layers is 0.
};

enum class InfillPattern {
  kLines,  ///< Parallel lines, turned by 90 degrees from layer to layer.
  kGrid,   ///< Both directions on every layer, each with half the density.
};

struct InfillOptions {
  double density = 0.15;  ///< Filled share of the inside, in [0, 1].
  InfillPattern pattern = InfillPattern::kLines;
  double angle = 45.0;  ///< Direction of the lines on even layers, degrees from the x axis.
  double wall_overlap =
      0.20;  ///< How far a line's end runs into the innermost wall, share of the line's width.
  double anchor_max = 12.0;  ///< Longest way along the boundary that joins two sparse lines, mm; 0 = none.
  double min_area_solid = 15.0;  ///< Sparse areas smaller than this become solid, mm^2.
};

/// mm/s. What the filament's volumetric limit or the machine does not allow is lowered.
struct SpeedOptions {
  double outer_wall = 30.0;
  double inner_wall = 45.0;
  double sparse_infill = 50.0;
  double solid_infill = 40.0;
  double top_surface = 30.0;
  double skirt = 30.0;
  double travel = 150.0;
  double travel_z = 0.0;              ///< 0 = as fast as the machine's limits allow.
  double first_layer = 20.0;          ///< Upper limit of every extruding move of the first layer.
  double first_layer_travel = 100.0;  ///< Upper limit of travel on the first layer.
};

/// mm/s^2. 0 leaves the acceleration that the machine has.
struct AccelerationOptions {
  double outer_wall = 0.0;
  double inner_wall = 0.0;
  double infill = 0.0;
  double first_layer = 0.0;
  double travel = 0.0;
};

/// Lengths are mm of filament.
struct RetractionOptions {
  double length = 5.0;         ///< 0 = never retract.
  double speed = 40.0;         ///< mm/s
  double recover_speed = 0.0;  ///< mm/s; 0 = speed.
  double restart_extra = 0.0;  ///< Pushed out beyond what was drawn back.
  double z_hop = 0.0;          ///< Lift while travelling retracted, mm.
  double z_hop_max_z = 0.0;    ///< No lift above this height, mm; 0 = lift everywhere.
  double min_travel = 1.5;     ///< Travel shorter than this needs no retraction, mm.
  bool on_layer_change = true;
};

enum class Adhesion { kNone, kSkirt, kBrim };

struct AdhesionOptions {
  Adhesion type = Adhesion::kSkirt;
  std::size_t skirt_loops = 1;
  double skirt_distance = 5.0;    ///< From the outline to the skirt's nearer edge, mm.
  std::size_t skirt_height = 1;   ///< Layers.
  double skirt_min_length = 4.0;  ///< mm of filament; more loops are added until it is reached.
  double brim_width = 5.0;        ///< mm
  double brim_gap = 0.1;          ///< Between outline and brim, mm.
};

/// How regions become toolpaths. The defaults suit a 0.4 mm nozzle.
struct PlanOptions {
  WidthOptions width;
  WallOptions wall;
  ShellOptions shell;
  InfillOptions infill;
  SpeedOptions speed;
  AccelerationOptions acceleration;
  RetractionOptions retraction;
  AdhesionOptions adhesion;
  /// Points of a toolpath that lie closer than this to the line without them are left out, mm.
  double resolution = 0.005;
};

}  // namespace lamina::gcode
