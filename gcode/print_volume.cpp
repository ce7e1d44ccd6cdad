#include "gcode/print_volume.h"

#include <array>
#include <cmath>

#include "gcode/marlin/number_text.h"

namespace lamina::gcode {
namespace {

using engine::Box3;
using engine::Vector3;

constexpr double kFitSlack = 1e-6;  // mm

std::string describe(const std::string& what, const Vector3& low, const Vector3& high,
                     const std::string& hint) {
  const std::array<std::string, 3> low_sides{"left", "front", "lower"};
  const std::array<std::string, 3> high_sides{"right", "back", "upper"};
  std::string sides;
  for (int axis = 0; axis < 3; ++axis) {
    const auto name = static_cast<std::size_t>(axis);
    for (const auto& [excess, side] :
         {std::pair{low[axis], low_sides[name]}, {high[axis], high_sides[name]}}) {
      if (excess <= 0.0) continue;
      sides += (sides.empty() ? "" : ", ") + fixed_text(excess, 3) + " mm at the " + side + " side";
    }
  }
  return what + " does not fit the printer: it reaches out by " + sides + "; " + hint;
}

/// How much of a circle's box the corners of `box` overrun, shared out to the sides they lie on.
void add_circle_excess(const Box3& box, const PrintVolume& volume, Vector3& low, Vector3& high) {
  const Vector3 center = volume.center();
  const double radius = 0.5 * volume.width;
  for (const double x : {box.min().x(), box.max().x()}) {
    for (const double y : {box.min().y(), box.max().y()}) {
      const engine::Vector2 corner(x - center.x(), y - center.y());
      const double excess = corner.norm() - radius;
      if (excess <= kFitSlack) continue;
      Vector3& side_x = corner.x() < 0.0 ? low : high;
      Vector3& side_y = corner.y() < 0.0 ? low : high;
      side_x.x() = std::max(side_x.x(), excess * std::abs(corner.x()) / corner.norm());
      side_y.y() = std::max(side_y.y(), excess * std::abs(corner.y()) / corner.norm());
    }
  }
}

std::string hint_for(const Box3& box, const PrintVolume& volume, const std::string& what) {
  const Vector3 room = volume.bounds().sizes();
  const Vector3 size = box.sizes();
  if (volume.shape == BedShape::kRectangle && (size.array() <= room.array() + kFitSlack).all()) {
    return "it would fit if moved: place it by (" + fixed_text(volume.center().x() - box.center().x(), 3) +
           ", " + fixed_text(volume.center().y() - box.center().y(), 3) + ", " +
           fixed_text(-box.min().z(), 3) + ") mm";
  }
  double scale = (room.array() / size.array().max(kFitSlack)).minCoeff();
  if (volume.shape == BedShape::kCircle) {
    scale = std::min(room.z() / std::max(size.z(), kFitSlack), volume.width / size.head<2>().norm());
  }
  return "scale the " + what + " to at most " + fixed_text(std::floor(scale * 1000.0) / 10.0, 1) +
         " % or choose a larger printer";
}

}  // namespace

Box3 PrintVolume::bounds() const {
  const double y = shape == BedShape::kCircle ? width : depth;
  const Vector3 low = origin == BedOrigin::kCorner ? Vector3::Zero() : Vector3(-0.5 * width, -0.5 * y, 0.0);
  return {low, low + Vector3(width, y, height)};
}

Vector3 PrintVolume::center() const {
  const Box3 box = bounds();
  return {box.center().x(), box.center().y(), 0.0};
}

FitError::FitError(const std::string& what_sticks_out, const Vector3& low, const Vector3& high,
                   const std::string& remedy)
    : std::runtime_error(describe(what_sticks_out, low, high, remedy)),
      excess_low(low),
      excess_high(high),
      hint(remedy) {}

void check_fit(const Box3& box, const PrintVolume& volume, const std::string& what) {
  if (box.isEmpty()) return;
  const Box3 room = volume.bounds();
  Vector3 low = (room.min() - box.min()).cwiseMax(0.0);
  Vector3 high = (box.max() - room.max()).cwiseMax(0.0);
  if (volume.shape == BedShape::kCircle) {
    low.head<2>().setZero();
    high.head<2>().setZero();
    add_circle_excess(box, volume, low, high);
  }
  if (low.maxCoeff() <= kFitSlack && high.maxCoeff() <= kFitSlack) return;
  throw FitError(what, low, high, hint_for(box, volume, what));
}

}  // namespace lamina::gcode
