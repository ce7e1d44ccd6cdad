#pragma once

#include <cstddef>
#include <vector>

#include "engine/model.h"

namespace lamina::engine {

/// A face of the model that lies level.
struct LevelFace {
  double z = 0.0;     ///< mm
  double area = 0.0;  ///< mm^2
};

/// How far the model's surface leans at each height: the greatest |z component| of its unit normal in bins of
/// equal width, 0 on upright walls and near 1 where the surface is nearly level. Level faces are listed
/// instead.
struct SlopeProfile {
  double bottom = 0.0;  ///< of the first bin, mm
  double bin = 0.01;    ///< width, mm
  std::vector<double> normal_z;
  std::vector<LevelFace> level;  ///< by rising z, faces of one height added up

  double top() const { return bottom + bin * static_cast<double>(normal_z.size()); }
};

/// Measures from `bottom` to `top`, mm, `bin` mm wide, positive. Patches are halved until they span less
/// than a bin or their normals, at nine points, spread by less than 0.01; what is found counts for
/// all heights that the piece reaches, so the profile errs to the safe side but for what lies between the
/// nine points.
SlopeProfile measure_slopes(const Model& model, double bottom, double top, double bin);

}  // namespace lamina::engine
