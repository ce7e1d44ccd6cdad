#include "engine/slicing_planes.h"

#include <cmath>
#include <stdexcept>

#include "engine/model.h"

namespace lamina::engine {
namespace {

constexpr double kMostLayers = 1e7;

}  // namespace

double plane_height(double bottom, double top, SlicePosition position) {
  switch (position) {
    case SlicePosition::kBottom:
      return bottom;
    case SlicePosition::kMiddle:
      return 0.5 * (bottom + top);
    case SlicePosition::kTop:
      return top;
  }
  return bottom;
}

std::vector<SlicePlane> make_slicing_planes(double z_min, double z_max, const SlicingPlanesOptions& options) {
  const double thickness = options.layer_thickness;
  const double first = options.first_layer_thickness > 0.0 ? options.first_layer_thickness : thickness;
  if (!(thickness > 0.0)) throw std::invalid_argument("layer thickness must be positive");
  const double above_first = std::max(0.0, z_max - z_min - first - kModelTolerance);
  const double count = 1.0 + std::ceil(above_first / thickness);
  if (!(count <= kMostLayers))
    throw std::invalid_argument("more than ten million layers: is the unit right?");

  std::vector<SlicePlane> planes;
  double bottom = z_min;
  for (double k = 0.0; k < count; ++k) {
    const double top = z_min + first + k * thickness;
    double z = plane_height(bottom, top, options.position);
    if (z > z_max) {
      // Only rounding may carry the last plane past the model's top.
      if (z > z_max + kModelTolerance) break;
      z = z_max;
    }
    planes.push_back({z, bottom, top});
    bottom = top;
  }
  return planes;
}

}  // namespace lamina::engine
