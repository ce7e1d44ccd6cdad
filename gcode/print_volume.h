#pragma once

#include <stdexcept>
#include <string>

#include "engine/geometry/vector.h"

namespace lamina::gcode {

enum class BedShape { kRectangle, kCircle };

/// Where the printer's coordinates begin.
enum class BedOrigin { kCorner, kCenter };

/// The space a printer can fill, mm.
struct PrintVolume {
  BedShape shape = BedShape::kRectangle;
  BedOrigin origin = BedOrigin::kCorner;
  double width = 220.0;   ///< Along x; the diameter of a circle.
  double depth = 220.0;   ///< Along y; not used for a circle.
  double height = 250.0;  ///< Along z.

  /// Smallest box around the volume in printer coordinates.
  engine::Box3 bounds() const;
  /// The middle of the bed, z = 0.
  engine::Vector3 center() const;
};

/// Something reaches out of the printer's volume.
class FitError : public std::runtime_error {
 public:
  FitError(const std::string& what_sticks_out, const engine::Vector3& low, const engine::Vector3& high,
           const std::string& remedy);

  engine::Vector3
      excess_low;  ///< How far it reaches beyond the left, front and lower side, mm; 0 = it does not.
  engine::Vector3 excess_high;  ///< The same for the right, back and upper side.
  std::string hint;
};

/// Throws FitError when `box` (printer coordinates, mm) reaches out of the volume by more than 1e-6 mm; the
/// message says by how much on which side. `what` names the thing, such as "model" or "model with skirt".
void check_fit(const engine::Box3& box, const PrintVolume& volume, const std::string& what);

}  // namespace lamina::gcode
