#include "tools/bench/trim_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/bspline_basis.h"
#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::tools {
namespace {

constexpr int kChordsPerSpan = 256;
constexpr int kBisections = 45;
constexpr int kThirds = 40;
constexpr int kChordsPerLine = 64;  // straight in the parameter plane only

engine::BezierPatch facet_patch(const engine::TriangleMesh& mesh, const std::array<std::uint32_t, 3>& facet) {
  const auto corner = [&](int k) {
    const engine::Vector3 place = mesh.vertices[facet[static_cast<std::size_t>(k)]].cast<double>();
    return engine::Vector4(place.x(), place.y(), place.z(), 1.0);
  };
  engine::BezierPatch patch;
  patch.net.count_u = patch.net.count_v = 2;
  patch.net.points = {corner(0), corner(2), corner(1), corner(2)};
  return patch;
}

}  // namespace

TrimOutline::TrimOutline(const engine::Surface& surface) : surface_(surface.nurbs) {
  for (const engine::TrimLoop& loop : surface.trim) {
    const std::size_t first = chords_.size();
    for (const engine::NurbsCurve& curve : loop.curves) {
      const std::size_t number = curves_.size();
      curves_.push_back(curve);
      const std::vector<double> breaks = engine::break_points(curve.knots, curve.degree);
      const int count = curve.degree > 1 ? kChordsPerSpan : kChordsPerLine;
      for (std::size_t span = 0; span + 1 < breaks.size(); ++span) {
        const double step = (breaks[span + 1] - breaks[span]) / count;
        for (int k = 0; k < count; ++k) {
          Chord chord{number, breaks[span] + k * step, breaks[span] + (k + 1) * step, {}, {}, {}, {}};
          chord.a = engine::evaluate(curve, chord.t0).head<2>();
          chord.b = engine::evaluate(curve, chord.t1).head<2>();
          chord.from = place(number, chord.t0);
          chord.to = place(number, chord.t1);
          chords_.push_back(chord);
        }
      }
    }
    const std::size_t last = chords_.size();
    for (std::size_t k = first; k < last; ++k) {
      const Chord& next = chords_[k + 1 < last ? k + 1 : first];
      if (chords_[k].curve != next.curve || k + 1 == last)
        chords_.push_back({Chord::kNoCurve, 0.0, 0.0, chords_[k].b, next.a, chords_[k].to, next.from});
    }
  }
}

engine::Vector3 TrimOutline::place(std::size_t curve, double t) const {
  const engine::Vector2 parameters = engine::evaluate(curves_[curve], t).head<2>();
  return engine::evaluate(surface_, parameters.x(), parameters.y());
}

bool TrimOutline::contains(const engine::Vector2& parameters) const {
  bool inside = false;
  for (const Chord& chord : chords_) {
    if ((chord.a.y() > parameters.y()) == (chord.b.y() > parameters.y())) continue;
    const double x = chord.a.x() + (parameters.y() - chord.a.y()) / (chord.b.y() - chord.a.y()) *
                                       (chord.b.x() - chord.a.x());
    if (x > parameters.x()) inside = !inside;
  }
  return inside;
}

double TrimOutline::distance_to_rim(const engine::Vector3& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  const Chord* nearest_chord = nullptr;
  for (const Chord& chord : chords_) {
    const engine::Vector3 along = chord.to - chord.from;
    const double length = along.squaredNorm();
    const double s = length > 0.0 ? std::clamp((point - chord.from).dot(along) / length, 0.0, 1.0) : 0.0;
    const double distance = (chord.from + s * along - point).norm();
    if (distance < nearest) {
      nearest = distance;
      nearest_chord = &chord;
    }
  }
  if (nearest_chord == nullptr || nearest_chord->curve == Chord::kNoCurve) return nearest;
  // On the curve itself the chord's foot is a little elsewhere: narrowed down by thirds.
  double low = nearest_chord->t0;
  double high = nearest_chord->t1;
  const auto distance_at = [&](double t) { return (place(nearest_chord->curve, t) - point).norm(); };
  for (int k = 0; k < kThirds; ++k) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (distance_at(a) < distance_at(b) ? high : low) = distance_at(a) < distance_at(b) ? b : a;
  }
  return distance_at(0.5 * (low + high));
}

TrimOutline::Crossings TrimOutline::crossings(double z) const {
  Crossings crossings;
  for (const Chord& chord : chords_) {
    if (chord.curve == Chord::kNoCurve || (chord.from.z() < z) == (chord.to.z() < z)) continue;
    double low = chord.t0;
    double high = chord.t1;
    for (int k = 0; k < kBisections; ++k) {
      const double middle = 0.5 * (low + high);
      ((place(chord.curve, middle).z() < z) == (chord.from.z() < z) ? low : high) = middle;
    }
    // Which side an end in the plane is on is for rounding to say.
    const bool ends_there =
        std::min(std::abs(chord.from.z() - z), std::abs(chord.to.z() - z)) <= engine::kModelTolerance;
    (ends_there ? crossings.in_plane : crossings.through).emplace_back(place(chord.curve, low).head<2>());
  }
  return crossings;
}

ModelPatches::ModelPatches(const engine::Model& model) {
  outlines.reserve(model.surfaces.size());
  for (const engine::Surface& surface : model.surfaces) {
    const TrimOutline* trim = nullptr;
    if (!surface.trim.empty()) trim = &outlines.emplace_back(surface);
    const std::vector<double> us = engine::break_points(surface.nurbs.knots_u, surface.nurbs.degree_u);
    const std::vector<double> vs = engine::break_points(surface.nurbs.knots_v, surface.nurbs.degree_v);
    std::size_t k = 0;
    for (engine::BezierPatch& patch : engine::bezier_patches(surface.nurbs)) {
      const std::size_t u = k / (vs.size() - 1);
      const std::size_t v = k % (vs.size() - 1);
      patches.push_back({std::move(patch), {us[u], vs[v]}, {us[u + 1], vs[v + 1]}, trim, surface.solid});
      ++k;
    }
  }
  for (const engine::TriangleMesh& mesh : model.meshes) {
    for (const auto& facet : mesh.facets) {
      ModelPatch patch;
      patch.patch = facet_patch(mesh, facet);
      patch.solid = mesh.solid;
      patches.push_back(std::move(patch));
    }
  }
}

}  // namespace lamina::tools
