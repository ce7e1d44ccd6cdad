#include "engine/import/iges/cubic_fit.h"

#include <algorithm>
#include <array>

#include "engine/import/iges/spline_breaks.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kDegree = 3;

/// Bezier points of the cubic through four points at 0, 1/3, 2/3 and 1.
std::array<Vector3, 4> cubic_through(const std::array<Vector3, 4>& q) {
  return {q[0], (-5.0 * q[0] + 18.0 * q[1] - 9.0 * q[2] + 2.0 * q[3]) / 6.0,
          (2.0 * q[0] - 9.0 * q[1] + 18.0 * q[2] - 5.0 * q[3]) / 6.0, q[3]};
}

std::vector<double> halved(const std::vector<double>& breaks) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    result.push_back(breaks[i]);
    result.push_back(0.5 * (breaks[i] + breaks[i + 1]));
  }
  result.push_back(breaks.back());
  return result;
}

/// Parameters of the points that cubics go through: the breaks and thirds between them.
std::vector<double> with_thirds(const std::vector<double>& breaks) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double third = (breaks[i + 1] - breaks[i]) / 3.0;
    result.insert(result.end(), {breaks[i], breaks[i] + third, breaks[i + 1] - third});
  }
  result.push_back(breaks.back());
  return result;
}

/// Replaces points at breaks and thirds, every `stride`-th from `first`, by Bezier points.
void to_bezier(std::vector<Vector3>& points, std::size_t first, std::size_t stride, std::size_t pieces) {
  for (std::size_t k = 0; k < pieces; ++k) {
    std::array<Vector3, 4> q;
    for (std::size_t i = 0; i < 4; ++i) q[i] = points[first + (kDegree * k + i) * stride];
    const std::array<Vector3, 4> p = cubic_through(q);
    for (std::size_t i = 1; i < 3; ++i) points[first + (kDegree * k + i) * stride] = p[i];
  }
}

}  // namespace

CubicFit<NurbsCurve> fit_cubics(const std::function<Vector3(double)>& point, std::vector<double> breaks,
                                double tolerance, std::size_t most_points) {
  while (true) {
    const std::size_t pieces = breaks.size() - 1;
    std::vector<Vector3> points;
    for (const double t : with_thirds(breaks)) points.push_back(point(t));
    to_bezier(points, 0, 1, pieces);
    CubicFit<NurbsCurve> fit{{kDegree, bezier_knots(breaks, kDegree), {}}, 0.0};
    for (const Vector3& p : points) fit.fitted.control_points.push_back(homogeneous(p));
    for (std::size_t i = 0; i < pieces; ++i) {
      for (const double part : {1.0 / 6.0, 0.5, 5.0 / 6.0}) {
        const double t = breaks[i] + part * (breaks[i + 1] - breaks[i]);
        fit.error = std::max(fit.error, (evaluate(fit.fitted, t) - point(t)).norm());
      }
    }
    if (fit.error <= tolerance || 2 * points.size() > most_points) return fit;
    breaks = halved(breaks);
  }
}

CubicFit<NurbsSurface> fit_bicubics(const std::function<Vector3(double, double)>& point,
                                    std::vector<double> breaks_u, std::vector<double> breaks_v,
                                    double tolerance, std::size_t most_points) {
  while (true) {
    const std::vector<double> us = with_thirds(breaks_u);
    const std::vector<double> vs = with_thirds(breaks_v);
    std::vector<Vector3> points;
    points.reserve(us.size() * vs.size());
    for (const double u : us) {
      for (const double v : vs) points.push_back(point(u, v));
    }
    for (std::size_t i = 0; i < us.size(); ++i) to_bezier(points, i * vs.size(), 1, breaks_v.size() - 1);
    for (std::size_t j = 0; j < vs.size(); ++j) to_bezier(points, j, vs.size(), breaks_u.size() - 1);
    CubicFit<NurbsSurface> fit;
    NurbsSurface& surface = fit.fitted;
    surface.degree_u = kDegree;
    surface.degree_v = kDegree;
    surface.knots_u = bezier_knots(breaks_u, kDegree);
    surface.knots_v = bezier_knots(breaks_v, kDegree);
    surface.net.count_u = us.size();
    surface.net.count_v = vs.size();
    for (const Vector3& p : points) surface.net.points.push_back(homogeneous(p));
    // Off between the points along u, along v: lines through the others tell the directions apart.
    const auto off = [&](double u, double v) { return (evaluate(surface, u, v) - point(u, v)).norm(); };
    double error_u = 0.0;
    double error_v = 0.0;
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      for (const double v : vs) error_u = std::max(error_u, off(0.5 * (us[i] + us[i + 1]), v));
    }
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      for (const double u : us) error_v = std::max(error_v, off(u, 0.5 * (vs[j] + vs[j + 1])));
    }
    fit.error = error_u + error_v;
    if (fit.error <= tolerance || 2 * points.size() > most_points) return fit;
    if (error_u >= 0.5 * error_v) breaks_u = halved(breaks_u);
    if (error_v >= 0.5 * error_u) breaks_v = halved(breaks_v);
  }
}

}  // namespace lamina::engine
