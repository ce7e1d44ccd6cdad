#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "gcode/filament_options.h"
#include "gcode/plan/plan_options.h"
#include "gcode/plan/route.h"
#include "gcode/plan/skins.h"
#include "gcode/region/layer_region.h"
#include "gcode/toolpath.h"

namespace lamina::gcode {

/// Turns regions into toolpaths, layer by layer in rising z. A layer is finished as soon as the layers above
/// it that its top shell depends on are known; layers below it are kept only as long as a bottom shell needs
/// them, so what it holds does not grow with the number of layers. Layers with an empty region are kept as
/// empty toolpaths.
class Planner {
 public:
  /// `start` is where the nozzle stands before the first layer. Throws PlanError for options that no layer
  /// can be planned with.
  Planner(PlanOptions options, FilamentOptions filament, const engine::Vector3& start);

  /// Takes the next layer and returns those that are now finished, in order. Throws PlanError when the layer
  /// does not lie above the one before or is thicker than a bead is wide.
  std::vector<LayerToolpath> push(LayerRegion layer);

  /// No layer follows: returns the rest.
  std::vector<LayerToolpath> finish();

  /// Layers held at the moment: those not finished and those below them that are still needed.
  std::size_t held_layers() const { return window_.size(); }

 private:
  struct Shells {
    std::size_t above = 0;  ///< Layers above that decide about this one's top shell.
    std::size_t below = 0;
    bool complete = false;  ///< All layers above that decide have been pushed.
  };

  Shells shells(std::size_t position) const;
  Neighbours neighbours(std::size_t position) const;
  std::vector<LayerToolpath> finish_layers(bool last);
  LayerToolpath plan(std::size_t position);
  void drop_unneeded();

  PlanOptions options_;
  FilamentOptions filament_;
  NozzleState nozzle_;
  std::vector<engine::Vector2> seams_;  ///< Of the layer below.
  engine::Region first_layer_;          ///< What a skirt goes around.
  std::deque<LayerRegion> window_;
  std::size_t next_ = 0;  ///< Position in window_ of the first layer that is not finished.
};

}  // namespace lamina::gcode
