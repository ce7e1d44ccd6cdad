#include "engine/import/iges/trimmed_face.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "engine/import/iges/parameter_record.h"
#include "engine/import/trim/fitted_path.h"
#include "engine/nurbs/reverse.h"

namespace lamina::engine {
namespace {

/// Tolerances by which curves in parameters and in space may differ and still be the same.
constexpr double kAgreement = 4.0;

double parameter_at(const NurbsCurve& curve, double part) {
  return curve.first_parameter() + part * (curve.last_parameter() - curve.first_parameter());
}

Vector3 first_point(const NurbsCurve& curve) {
  return cartesian(curve.control_points.front());
}
Vector3 last_point(const NurbsCurve& curve) {
  return cartesian(curve.control_points.back());
}

/// Pieces in space turned round where that makes them meet.
std::vector<NurbsCurve> turned_to_meet(std::vector<NurbsCurve> pieces, double tolerance) {
  const auto to_next = [&](const Vector3& point, const NurbsCurve& next) {
    return std::min((point - first_point(next)).norm(), (point - last_point(next)).norm());
  };
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    NurbsCurve& piece = pieces[i];
    bool is_backwards = false;
    if (i > 0) {
      const double gap = (first_point(piece) - last_point(pieces[i - 1])).norm();
      is_backwards = gap > tolerance && 2.0 * (last_point(piece) - last_point(pieces[i - 1])).norm() < gap;
    } else if (pieces.size() > 1) {
      const double gap = to_next(last_point(piece), pieces[1]);
      is_backwards = gap > tolerance && 2.0 * to_next(first_point(piece), pieces[1]) < gap;
    }
    if (is_backwards) piece = reversed(piece);
  }
  return pieces;
}

/// Measures distances from curves in space.
class DistanceFromCurves {
 public:
  explicit DistanceFromCurves(const std::vector<NurbsCurve>& curves) {
    for (const NurbsCurve& curve : curves) {
      const std::vector<double> breaks = break_points(curve.knots, curve.degree);
      const int per_span = curve.degree == 1 ? 1 : breaks.size() > 20 ? 2 : 8;
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        for (int k = 0; k < per_span; ++k) {
          const double step = (breaks[i + 1] - breaks[i]) / per_span;
          const double first = breaks[i] + k * step;
          const double last = k + 1 == per_span ? breaks[i + 1] : first + step;
          chords_.push_back({&curve, first, last, evaluate(curve, first), evaluate(curve, last)});
        }
      }
    }
  }

  double operator()(const Vector3& point) const {
    const Chord* nearest = nullptr;
    double best = std::numeric_limits<double>::infinity();
    for (const Chord& chord : chords_) {
      const double distance = (chord.start + chord.part(point) * (chord.end - chord.start) - point).norm();
      if (distance >= best) continue;
      best = distance;
      nearest = &chord;
    }
    if (nearest == nullptr || nearest->curve->degree == 1) return best;
    // The curve beside its chord: the distance has one minimum there, which Gauss and Newton find at once.
    double t = nearest->first + nearest->part(point) * (nearest->last - nearest->first);
    best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) {
      const CurveDerivative at = evaluate_derivative(*nearest->curve, t);
      const Vector3 to = point - at.point;
      best = std::min(best, to.norm());
      const double squared = at.tangent.squaredNorm();
      if (!(squared > 0.0)) break;
      const double next = std::clamp(t + to.dot(at.tangent) / squared, nearest->first, nearest->last);
      const bool is_found = std::abs(next - t) <= 1e-9 * (nearest->last - nearest->first);
      t = next;
      if (is_found) break;
    }
    return best;
  }

 private:
  struct Chord {
    const NurbsCurve* curve;
    double first;
    double last;
    Vector3 start;
    Vector3 end;

    /// Where along it the foot of a point lies, 0 to 1.
    double part(const Vector3& point) const {
      const Vector3 along = end - start;
      const double squared = along.squaredNorm();
      return squared > 0.0 ? std::clamp(along.dot(point - start) / squared, 0.0, 1.0) : 0.0;
    }
  };

  std::vector<Chord> chords_;
};

/// How far a loop in the parameter plane is off the curves in space that should be the same, at three points
/// of each of its curves. Up to `enough` it is a bound only.
double disagreement(const ParameterLoop& loop, const std::vector<NurbsCurve>& in_space,
                    const LoopGround& ground, double enough) {
  double largest = 0.0;
  std::optional<DistanceFromCurves> distance;
  for (std::size_t i = 0; i < loop.curves.size(); ++i) {
    const NurbsCurve& curve = loop.curves[i];
    for (const double part : {0.0, 0.37, 0.71}) {
      const Vector3 point = ground.inverse.point(evaluate(curve, parameter_at(curve, part)).head<2>());
      // Most writers give both curves piece by piece and with one parameter.
      double off = std::numeric_limits<double>::infinity();
      if (loop.curves.size() == in_space.size())
        off = (evaluate(in_space[i], parameter_at(in_space[i], part)) - point).norm();
      if (off > enough) {
        if (!distance) distance.emplace(in_space);
        off = std::min(off, (*distance)(point));
      }
      largest = std::max(largest, off);
    }
  }
  return largest;
}

/// Largest distance from the surface of a few points on curves in space: what projecting them could not mend.
double distance_off_surface(const std::vector<NurbsCurve>& in_space, const LoopGround& ground) {
  double largest = 0.0;
  for (const NurbsCurve& curve : in_space) {
    for (const double part : {0.2, 0.55}) {
      largest =
          std::max(largest, ground.inverse.nearest(evaluate(curve, parameter_at(curve, part))).distance);
    }
  }
  return largest;
}

std::vector<NurbsCurve> mapped(const std::vector<NurbsCurve>& curves, const ParameterMap& map,
                               const LoopGround& ground) {
  if (map.is_identity()) return curves;
  std::vector<NurbsCurve> result;
  for (const NurbsCurve& curve : curves) {
    result.push_back(fitted_path(
        [&](double t) { return map(evaluate(curve, t).head<2>()); }, break_points(curve.knots, curve.degree),
        [&](const Vector2& at, const Vector2& by) { return ground.inverse.step_length(at, by); },
        0.1 * ground.tolerance));
  }
  return result;
}

ParameterLoop made_loop(ParameterRecord& record, const FaceSurface& surface, const Boundary& boundary,
                        const LoopGround& ground) {
  ParameterLoop loop;
  const bool has_parameters = surface.has_parameters && !boundary.in_parameters.empty();
  if (has_parameters) {
    loop = chained_loop(mapped(boundary.in_parameters, surface.map, ground), ground);
    if (boundary.in_space.empty()) return loop;
    const double agreeing = kAgreement * ground.tolerance;
    const double off = disagreement(loop, boundary.in_space, ground, agreeing);
    if (off <= agreeing || off <= 2.0 * distance_off_surface(boundary.in_space, ground)) return loop;
    ParameterLoop projected = projected_loop(turned_to_meet(boundary.in_space, ground.tolerance), ground);
    if (projected.curves.empty() || projected.largest_distance > off ||
        projected.largest_gap > std::max(off, loop.largest_gap))
      return loop;
    record.note(Tolerance::kTrimCurvesDiffer, fmt::format("{:.3g} file units", off));
    return projected;
  }
  return projected_loop(turned_to_meet(boundary.in_space, ground.tolerance), ground);
}

}  // namespace

std::vector<Vector3> cover_of(const std::vector<Boundary>& boundaries) {
  std::vector<Vector3> cover;
  for (const Boundary& boundary : boundaries) {
    for (const NurbsCurve& curve : boundary.in_space) {
      for (const Vector4& point : curve.control_points) cover.push_back(cartesian(point));
    }
  }
  return cover;
}

FaceSurface read_face_surface(ParameterRecord& record, EntityReader& reader, std::size_t index,
                              const std::vector<Boundary>& boundaries) {
  constexpr int kFirstAnalyticType = 190;
  constexpr int kLastAnalyticType = 198;
  constexpr int kPlaneType = 108;
  const int type = reader.entry(index).type;
  FaceSurface surface;
  surface.nurbs = reader.surface_of_face(record, index, cover_of(boundaries));
  surface.has_parameters = type != kPlaneType && (type < kFirstAnalyticType || type > kLastAnalyticType);
  surface.map = parameter_map(reader, record, index, surface.nurbs);
  return surface;
}

std::vector<TrimmedPatch> trimmed_face(ParameterRecord& record, EntityReader& reader,
                                       const FaceSurface& surface, const std::vector<Boundary>& boundaries,
                                       bool whole_outside) {
  // Of the size of the face, not of a plane's leftovers around it.
  Box3 box;
  for (const Vector3& point : cover_of(boundaries)) box.extend(point);
  if (box.isEmpty()) box = control_box(surface.nurbs.net);
  const double size = box.diagonal().norm();
  const double tolerance = reader.trim_tolerance(size);
  const SurfaceTopology topology = surface_topology(surface.nurbs, tolerance);
  const SurfaceInverse inverse(surface.nurbs, topology);
  const LoopGround ground{surface.nurbs, topology, inverse, tolerance};
  std::vector<ParameterLoop> loops;
  for (const Boundary& boundary : boundaries) {
    ParameterLoop loop = made_loop(record, surface, boundary, ground);
    if (loop.largest_gap > 10.0 * tolerance)
      record.note(Tolerance::kTrimGap, fmt::format("{:.3g} file units", loop.largest_gap));
    if (loop.largest_distance > 10.0 * tolerance)
      record.note(Tolerance::kTrimOffSurface, fmt::format("{:.3g} file units", loop.largest_distance));
    std::size_t points = 0;
    for (const NurbsCurve& curve : loop.curves) points += curve.control_points.size();
    reader.spend(record, points);
    loops.push_back(std::move(loop));
  }
  if (auto patch = trimmed_patch(surface.nurbs, topology, std::move(loops), whole_outside, tolerance))
    return {std::move(*patch)};
  record.note(Tolerance::kTrimLost);
  return {};
}

}  // namespace lamina::engine
