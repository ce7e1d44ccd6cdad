#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/layer.h"
#include "gcode/region/layer_region.h"

namespace lamina::tests {

inline engine::Loop rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline engine::Loop square(const engine::Vector2& center, double side) {
  const double half = 0.5 * side;
  return rectangle(center.x() - half, center.y() - half, center.x() + half, center.y() + half);
}

/// Regular polygon with its corners on the circle.
inline engine::Loop circle(const engine::Vector2& center, double radius, int corners) {
  engine::Loop loop;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    loop.push_back(center + radius * engine::Vector2(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

inline engine::Loop reversed(engine::Loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

inline engine::PieceCurve closed_curve(const engine::Loop& loop) {
  engine::PieceCurve curve{{}, true};
  for (std::size_t k = 0; k < loop.size(); ++k) {
    curve.pieces.emplace_back(engine::LineSegment{loop[k], loop[(k + 1) % loop.size()]});
  }
  return curve;
}

inline engine::PieceCurve open_curve(const engine::Polyline& points) {
  engine::PieceCurve curve;
  for (std::size_t k = 1; k < points.size(); ++k) {
    curve.pieces.emplace_back(engine::LineSegment{points[k - 1], points[k]});
  }
  return curve;
}

/// Layer `index` of a stack of equal layers, its lower side at index * thickness.
inline engine::Layer layer_of(std::size_t index, double thickness, const std::vector<engine::Loop>& loops) {
  engine::Layer layer;
  layer.index = index;
  const double bottom = static_cast<double>(index) * thickness;
  layer.plane = {bottom + 0.5 * thickness, bottom, bottom + thickness};
  for (const engine::Loop& loop : loops) layer.closed.push_back({closed_curve(loop)});
  return layer;
}

inline gcode::LayerRegion region_of(std::size_t index, double thickness,
                                    const std::vector<engine::Loop>& loops) {
  return gcode::make_region(layer_of(index, thickness, loops), {});
}

inline double distance_to_side(const engine::Vector2& p, const engine::Vector2& a, const engine::Vector2& b) {
  const engine::Vector2 side = b - a;
  const double t = std::clamp((p - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
  return (p - a - t * side).norm();
}

/// Distance from a point to the nearest side of the loops.
inline double distance_to_loops(const engine::Vector2& p, const std::vector<engine::Loop>& loops) {
  double nearest = 1e300;
  for (const engine::Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      nearest = std::min(nearest, distance_to_side(p, loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return nearest;
}

/// Even-odd test by a ray along x.
inline bool inside_loops(const engine::Vector2& p, const std::vector<engine::Loop>& loops) {
  bool inside = false;
  for (const engine::Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const engine::Vector2& a = loop[i];
      const engine::Vector2& b = loop[(i + 1) % loop.size()];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
  }
  return inside;
}

}  // namespace lamina::tests
