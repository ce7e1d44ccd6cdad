#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "engine/contour/contour_node.h"
#include "engine/geometry/piece_curve.h"
#include "engine/geometry/planar_curve.h"

namespace lamina::tests {

/// A curve over [0, 1] and its derivative, both by closed form.
struct ParametricCurve {
  std::function<engine::Vector2(double)> point;
  std::function<engine::Vector2(double)> derivative;
};

ParametricCurve ellipse(double a, double b);
/// r = inner + growth * angle.
ParametricCurve spiral(double inner, double growth, double turns);
/// r = radius + depth cos(petals * angle).
ParametricCurve flower(double radius, double depth, int petals);
ParametricCurve spline(const engine::PlanarCurve& curve);
/// A clamped B-spline with simple, evenly spaced knots whose control points wander to the right, from a fixed
/// seed.
engine::PlanarCurve random_spline(int degree, std::size_t control_points, unsigned seed);

/// Nodes at evenly spaced parameters; `count` segments.
engine::NodeChain nodes_on(const ParametricCurve& curve, std::size_t count, bool closed);

/// Draws chains: L goes straight, A along an arc, each leaving exact nodes with exact tangents.
class NodePen {
 public:
  explicit NodePen(const engine::Vector2& start, double heading = 0.0);
  NodePen& line(double length, std::size_t segments = 1);
  /// Positive angles (rad) turn left.
  NodePen& arc(double radius, double angle, std::size_t segments);
  /// A corner: turns on the spot.
  NodePen& turn(double angle);
  engine::NodeChain open() const;
  /// The pen is back at its start; the last node is left out.
  engine::NodeChain closed() const;

 private:
  engine::Vector2 heading_vector() const;
  void step_to(const engine::Vector2& position);

  engine::NodeChain chain_;
  double heading_;
};

engine::NodeChain rounded_rectangle(double width, double height, double radius, std::size_t segments);

engine::NodeChain reversed(const engine::NodeChain& chain);
/// Turned by `angle` about the origin, then scaled, then moved.
engine::NodeChain placed(const engine::NodeChain& chain, double angle, double scale,
                         const engine::Vector2& shift);

/// One letter a piece: L, A or S.
std::string letters(const engine::PieceCurve& curve);

}  // namespace lamina::tests
