#include "engine/import/inspect/edge_chords.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/import/trim/parameter_loop.h"

namespace lamina::engine {
namespace {

constexpr double kPointPart = 1e-9;  ///< of the model: shorter edges are points

bool has_length(const Model& model, const FaceEdge& edge, double shortest) {
  const double first = edge.curve.first_parameter();
  const double range = edge.curve.last_parameter() - first;
  const Vector3 start = edge_point(model, edge, first);
  for (const double part : {0.31, 0.5, 0.77, 1.0}) {
    if ((edge_point(model, edge, first + part * range) - start).norm() > shortest) return true;
  }
  return false;
}

double distance_to_chord(const Vector3& point, const EdgeChords::Chord& chord) {
  const Vector3 along = chord.end - chord.start;
  const double squared = along.squaredNorm();
  const double part = squared > 0.0 ? std::clamp(along.dot(point - chord.start) / squared, 0.0, 1.0) : 0.0;
  return (chord.start + part * along - point).norm();
}

}  // namespace

std::vector<FaceEdge> face_edges(const Model& model) {
  const double shortest = kPointPart * control_box(model).diagonal().norm();
  std::vector<FaceEdge> edges;
  for (std::size_t i = 0; i < model.surfaces.size(); ++i) {
    const Surface& surface = model.surfaces[i];
    const NurbsSurface& s = surface.nurbs;
    std::vector<NurbsCurve> curves;
    for (const TrimLoop& loop : surface.trim)
      curves.insert(curves.end(), loop.curves.begin(), loop.curves.end());
    if (surface.trim.empty()) {
      const Vector2 a(s.first_u(), s.first_v());
      const Vector2 c(s.last_u(), s.last_v());
      const Vector2 b(c.x(), a.y());
      const Vector2 d(a.x(), c.y());
      curves = {parameter_line(a, b), parameter_line(b, c), parameter_line(c, d), parameter_line(d, a)};
    }
    for (NurbsCurve& curve : curves) {
      FaceEdge edge{i, std::move(curve)};
      if (has_length(model, edge, shortest)) edges.push_back(std::move(edge));
    }
  }
  return edges;
}

Vector3 edge_point(const Model& model, const FaceEdge& edge, double t) {
  const NurbsSurface& s = model.surfaces[edge.surface].nurbs;
  const Vector3 at = evaluate(edge.curve, t);
  return evaluate(s, std::clamp(at.x(), s.first_u(), s.last_u()),
                  std::clamp(at.y(), s.first_v(), s.last_v()));
}

EdgeChords::EdgeChords(const Model& model, const std::vector<FaceEdge>& edges, double reach)
    : model_(model), edges_(edges), reach_(reach), cell_(8.0 * reach) {
  constexpr int kStraight = 8;
  constexpr int kCurved = 16;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const NurbsCurve& curve = edges[i].curve;
    const std::vector<double> breaks = break_points(curve.knots, curve.degree);
    const NurbsSurface& s = model.surfaces[edges[i].surface].nurbs;
    const bool is_straight = curve.degree == 1 && s.degree_u == 1 && s.degree_v == 1;
    // A straight side of a surface of many spans is a curve of as many.
    const int spans = static_cast<int>(s.net.count_u + s.net.count_v) / 8;
    const int most = is_straight ? kStraight : std::clamp(kCurved + spans, kCurved, 64);
    const int pieces = breaks.size() > 9 ? 4 : most;
    for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
      const double step = (breaks[b + 1] - breaks[b]) / pieces;
      Vector3 start = edge_point(model, edges[i], breaks[b]);
      for (int k = 0; k < pieces; ++k) {
        const double last = k + 1 == pieces ? breaks[b + 1] : breaks[b] + (k + 1) * step;
        const Vector3 end = edge_point(model, edges[i], last);
        chords_.push_back({i, breaks[b] + k * step, last, start, end});
        start = end;
      }
    }
  }
  double longest = 0.0;
  for (const Chord& chord : chords_) longest = std::max(longest, (chord.end - chord.start).norm());
  cell_ = std::max(cell_, longest / 16.0);
  for (std::size_t c = 0; c < chords_.size(); ++c) {
    const Chord& chord = chords_[c];
    // The edge may bulge from its chord by a good part of it.
    const double room = reach_ + 0.2 * (chord.end - chord.start).norm();
    Box3 box(chord.start);
    box.extend(chord.end);
    const Vector3 low = (box.min().array() - room) / cell_;
    const Vector3 high = (box.max().array() + room) / cell_;
    for (double x = std::floor(low.x()); x <= high.x(); ++x) {
      for (double y = std::floor(low.y()); y <= high.y(); ++y) {
        for (double z = std::floor(low.z()); z <= high.z(); ++z) {
          cells_[cell_of(cell_ * (Vector3(x, y, z).array() + 0.5))].push_back(static_cast<std::uint32_t>(c));
        }
      }
    }
  }
}

/// Cells far apart may share a number: what is found is measured anyway.
std::uint64_t EdgeChords::cell_of(const Vector3& point) const {
  std::uint64_t number = 0;
  for (const double coordinate : point) {
    const auto index = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(coordinate / cell_)));
    number = number << 21U ^ (index & 0x1fffffU);
  }
  return number;
}

/// Of the edge itself, from its chord on by Gauss and Newton, with slopes by small steps.
double EdgeChords::distance_to_edge(const FaceEdge& edge, const Chord& chord, const Vector3& point) const {
  const double range = chord.last - chord.first;
  const double step = 1e-4 * range;
  const double lowest = edge.curve.first_parameter();
  const double highest = edge.curve.last_parameter();
  const Vector3 along = chord.end - chord.start;
  const double squared = along.squaredNorm();
  double t = chord.first +
             (squared > 0.0 ? range * std::clamp(along.dot(point - chord.start) / squared, 0.0, 1.0) : 0.0);
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 6; ++i) {
    t = std::clamp(t, lowest, highest);
    const Vector3 at = edge_point(model_, edge, t);
    const double distance = (at - point).norm();
    if (distance > 0.9 * best) return std::min(best, distance);
    best = distance;
    const double other = t + step <= highest ? t + step : t - step;
    const Vector3 slope = (edge_point(model_, edge, other) - at) / (other - t);
    if (!(slope.squaredNorm() > 0.0)) return best;
    t += slope.dot(point - at) / slope.squaredNorm();
  }
  return best;
}

std::optional<EdgeChords::Nearest> EdgeChords::nearest(const Vector3& point, std::size_t other_than) const {
  const auto cell = cells_.find(cell_of(point));
  if (cell == cells_.end()) return std::nullopt;
  // The nearest chord of each of some edges: which edge itself is nearest only shows beside the chords.
  struct Candidate {
    double distance = std::numeric_limits<double>::infinity();
    const Chord* chord = nullptr;
  };
  std::array<Candidate, 4> candidates;
  for (const std::uint32_t index : cell->second) {
    const Chord& chord = chords_[index];
    if (chord.edge == other_than) continue;
    const double to_chord = distance_to_chord(point, chord);
    if (to_chord >= candidates.back().distance) continue;
    auto place = std::find_if(candidates.begin(), candidates.end(), [&chord](const Candidate& known) {
      return known.chord == nullptr || known.chord->edge == chord.edge;
    });
    if (place == candidates.end()) place = candidates.end() - 1;
    if (place->distance <= to_chord) continue;
    *place = {to_chord, &chord};
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& x, const Candidate& y) { return x.distance < y.distance; });
  }
  std::optional<Nearest> found;
  for (const Candidate& candidate : candidates) {
    if (candidate.chord == nullptr) break;
    const Chord& chord = *candidate.chord;
    const double bulge = 0.2 * (chord.end - chord.start).norm();
    if (candidate.distance > reach_ + bulge) continue;
    const double distance =
        candidate.distance == 0.0
            ? 0.0
            : std::min(candidate.distance, distance_to_edge(edges_[chord.edge], chord, point));
    if (distance > reach_) continue;
    const bool is_same = found && std::abs(distance - found->distance) <= 1e-4 * reach_;
    const std::size_t alike = found && is_same ? found->alike + 1 : 1;
    if (!found || distance < found->distance) {
      found = Nearest{chord.edge, distance, chord.end - chord.start, alike};
    } else if (is_same) {
      found->alike = alike;
    }
  }
  return found;
}

}  // namespace lamina::engine
