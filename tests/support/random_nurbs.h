#pragma once

#include <random>

#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::tests {

inline constexpr unsigned kRandomNurbsSeed = 41;

enum class KnotEnds { kClamped, kUnclamped };

/// Uneven knots over five spans, one inner knot double where the degree allows it.
inline engine::Knots random_knots(int degree, KnotEnds ends, std::mt19937& random) {
  std::uniform_real_distribution<double> width(0.2, 1.0);
  engine::Knots knots{0.0};
  const int grown = ends == KnotEnds::kClamped ? 5 : 5 + 2 * degree;
  for (int k = 0; k < grown; ++k) {
    knots.push_back(knots.back() + width(random));
    if (k == grown / 2 && degree > 1) knots.push_back(knots.back());
  }
  if (ends == KnotEnds::kClamped) {
    knots.insert(knots.begin(), static_cast<std::size_t>(degree), knots.front());
    knots.insert(knots.end(), static_cast<std::size_t>(degree), knots.back());
  }
  return knots;
}

inline engine::Vector4 random_control_point(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::uniform_real_distribution<double> weight(0.4, 2.5);
  return engine::homogeneous({place(random), place(random), place(random)}, weight(random));
}

inline engine::NurbsCurve random_curve(int degree, KnotEnds ends, std::mt19937& random) {
  engine::NurbsCurve curve;
  curve.degree = degree;
  curve.knots = random_knots(degree, ends, random);
  const std::size_t count = curve.knots.size() - static_cast<std::size_t>(degree) - 1;
  for (std::size_t k = 0; k < count; ++k) curve.control_points.push_back(random_control_point(random));
  return curve;
}

inline engine::NurbsSurface random_surface(int degree_u, int degree_v, std::mt19937& random,
                                           KnotEnds ends = KnotEnds::kClamped) {
  engine::NurbsSurface surface;
  surface.degree_u = degree_u;
  surface.degree_v = degree_v;
  surface.knots_u = random_knots(degree_u, ends, random);
  surface.knots_v = random_knots(degree_v, ends, random);
  surface.net.count_u = surface.knots_u.size() - static_cast<std::size_t>(degree_u) - 1;
  surface.net.count_v = surface.knots_v.size() - static_cast<std::size_t>(degree_v) - 1;
  for (std::size_t k = 0; k < surface.net.count_u * surface.net.count_v; ++k) {
    surface.net.points.push_back(random_control_point(random));
  }
  return surface;
}

/// Visits (count + 1)^2 even parameters of the domain, its ends included.
template <typename Visit>
void for_each_parameter(const engine::NurbsSurface& surface, int count, Visit visit) {
  for (int i = 0; i <= count; ++i) {
    for (int j = 0; j <= count; ++j) {
      visit(surface.first_u() + (surface.last_u() - surface.first_u()) * i / count,
            surface.first_v() + (surface.last_v() - surface.first_v()) * j / count);
    }
  }
}

}  // namespace lamina::tests
