#include "engine/import/inspect/trimmed_area.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/import/trim/parameter_loop.h"

namespace lamina::engine {
namespace {

struct GaussPoint {
  double at;      ///< on [0, 1]
  double weight;  ///< they sum to 1
};

/// Abramowitz and Stegun, table 25.4, moved to [0, 1].
constexpr std::array<GaussPoint, 5> kRule{{{0.0469100770306680, 0.1184634425280945},
                                           {0.2307653449471585, 0.2393143352496832},
                                           {0.5, 0.2844444444444444},
                                           {0.7692346550528415, 0.2393143352496832},
                                           {0.9530899229693320, 0.1184634425280945}}};

void add(SurfaceIntegrals& sum, double factor, const SurfaceIntegrals& part) {
  sum.area += factor * part.area;
  sum.vector_area += factor * part.vector_area;
  sum.flux += factor * part.flux;
}

/// Integrals of the integrand along u from the lower end of the domain to `last`, at one v.
SurfaceIntegrals along_u(const NurbsSurface& surface, const std::vector<double>& breaks, double last,
                         double v) {
  SurfaceIntegrals sum;
  for (std::size_t i = 0; i + 1 < breaks.size() && breaks[i] < last; ++i) {
    const double length = std::min(breaks[i + 1], last) - breaks[i];
    for (const GaussPoint& point : kRule) {
      const SurfaceDerivatives d = evaluate_derivatives(surface, breaks[i] + length * point.at, v);
      const Vector3 normal = d.du.cross(d.dv);
      add(sum, length * point.weight, {normal.norm(), normal, d.point.dot(normal) / 3.0});
    }
  }
  return sum;
}

/// Integrals over the whole domain.
SurfaceIntegrals over_domain(const NurbsSurface& surface, const std::vector<double>& breaks_u,
                             const std::vector<double>& breaks_v) {
  SurfaceIntegrals sum;
  for (std::size_t j = 0; j + 1 < breaks_v.size(); ++j) {
    const double length = breaks_v[j + 1] - breaks_v[j];
    for (const GaussPoint& point : kRule) {
      const double v = breaks_v[j] + length * point.at;
      add(sum, length * point.weight, along_u(surface, breaks_u, surface.last_u(), v));
    }
  }
  return sum;
}

/// Knots cut so that arcs of a quarter turn are integrated well.
std::vector<double> refined(const std::vector<double>& breaks, int degree) {
  const int pieces = degree == 1 || breaks.size() > 6 ? 1 : 3;
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (int k = 0; k < pieces; ++k) result.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / pieces);
  }
  result.push_back(breaks.back());
  return result;
}

/// Where a straight edge of the parameter plane passes the knots in v: the integrand is smooth between.
std::vector<double> cuts(const Vector2& a, const Vector2& b, const std::vector<double>& breaks_u,
                         const std::vector<double>& breaks_v) {
  std::vector<double> parts{0.0, 1.0};
  const auto cut = [&parts](double from, double to, const std::vector<double>& breaks) {
    if (from == to) return;
    for (const double value : breaks) {
      const double part = (value - from) / (to - from);
      if (part > 0.0 && part < 1.0) parts.push_back(part);
    }
  };
  cut(a.x(), b.x(), breaks_u);
  cut(a.y(), b.y(), breaks_v);
  std::sort(parts.begin(), parts.end());
  return parts;
}

}  // namespace

SurfaceIntegrals surface_integrals(const Surface& surface) {
  const NurbsSurface& s = surface.nurbs;
  const std::vector<double> breaks_u = refined(break_points(s.knots_u, s.degree_u), s.degree_u);
  const std::vector<double> breaks_v = refined(break_points(s.knots_v, s.degree_v), s.degree_v);
  if (surface.trim.empty()) return over_domain(s, breaks_u, breaks_v);
  SurfaceIntegrals sum;
  for (const TrimLoop& loop : surface.trim) {
    for (const NurbsCurve& curve : loop.curves) {
      // A curved edge as its span's pieces, each integrated with its own slope.
      const std::vector<double> breaks = break_points(curve.knots, curve.degree);
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const int pieces = curve.degree == 1 ? 1 : 4;
        for (int k = 0; k < pieces; ++k) {
          const double step = (breaks[i + 1] - breaks[i]) / pieces;
          const double first = breaks[i] + k * step;
          const auto at = [&](double t) {
            return Vector2(evaluate(curve, std::clamp(t, breaks.front(), breaks.back())).head<2>());
          };
          const std::vector<double> parts = curve.degree == 1
                                                ? cuts(at(first), at(first + step), breaks_u, breaks_v)
                                                : std::vector<double>{0.0, 1.0};
          for (std::size_t part = 0; part + 1 < parts.size(); ++part) {
            const double begin = first + parts[part] * step;
            const double length = (parts[part + 1] - parts[part]) * step;
            for (const GaussPoint& point : kRule) {
              const double t = begin + length * point.at;
              const double h = 1e-5 * length;
              const double slope = (at(t + h).y() - at(t - h).y()) / (2.0 * h);
              if (slope == 0.0) continue;
              const Vector2 uv = at(t);
              const double v = std::clamp(uv.y(), s.first_v(), s.last_v());
              add(sum, length * point.weight * slope, along_u(s, breaks_u, std::min(uv.x(), s.last_u()), v));
            }
          }
        }
      }
    }
  }
  return sum;
}

}  // namespace lamina::engine
