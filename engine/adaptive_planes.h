#pragma once

#include <cstddef>
#include <vector>

#include "engine/slice_options.h"
#include "engine/slice_plane.h"
#include "engine/slope_profile.h"

namespace lamina::engine {

/// Layers whose thickness follows the slope of the surface.
struct AdaptivePlanes {
  std::vector<SlicePlane> planes;
  std::size_t missed_faces = 0;  ///< level faces nearer to another boundary than a layer may be thin
  std::size_t uneven_pairs =
      0;  ///< neighbours whose ratio level faces or the first layer force over the limit
  std::size_t thin_layers = 0;  ///< thinner than the least thickness, between faces that lie so close
};

/// The thickest layers between `least` and `greatest` thickness whose cusps, thickness times |z component| of
/// the surface's normal (Dolenc and Maekelae, Slicing procedures for layered manufacturing techniques, 1994),
/// stay under `cusp_height` wherever the least thickness allows it; neighbours differ by at most
/// `greatest_ratio`; level faces lie on boundaries of layers, the larger ones first. From the profile's
/// bottom to `top`, where the model ends. Throws std::invalid_argument when an option is out of its range or
/// there would be more than ten million layers.
AdaptivePlanes make_adaptive_planes(const SlopeProfile& profile, double top,
                                    const SlicingPlanesOptions& options);

}  // namespace lamina::engine
