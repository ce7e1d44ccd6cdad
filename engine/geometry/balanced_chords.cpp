#include "engine/geometry/balanced_chords.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/geometry/arc_length.h"
#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

using std::numbers::sqrt2;

constexpr double kJointAngle = 1e-4;         // rad; above it a joint is a corner
constexpr double kUnbalancedSagitta = 0.02;  // of the tolerance: a single inscribed chord may stand for this
constexpr double kMeasuredShare =
    0.98;  // of the tolerance: between the measured places the distance may be greater

bool is_line(const CurvePiece& piece) {
  return std::holds_alternative<LineSegment>(piece);
}

/// Whether the chain may leave the curve where one piece meets the next.
bool flows(const CurvePiece& piece, const CurvePiece& next) {
  return !is_line(piece) && !is_line(next) && (end_tangent(piece) - start_tangent(next)).norm() < kJointAngle;
}

/// Curved pieces that join smoothly, measured by bend: the integral of sqrt(curvature / 8), mm^(1/2). A chord
/// over the bend b has the sagitta b^2.
class BentRun {
 public:
  explicit BentRun(std::vector<const CurvePiece*> pieces) : pieces_(std::move(pieces)) {
    cells_.push_back({0, 0.0, 0.0, 0.0, 0.0});
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      area_ += swept_area(*pieces_[i]);
      if (const auto* arc = std::get_if<CircularArc>(pieces_[i])) {
        append(i, 1.0, arc->sweep, std::abs(arc->sweep) * arc->radius());
      } else {
        append_spline(i);
      }
    }
  }

  double bend() const { return cells_.back().bend; }
  double area() const { return area_; }

  struct Place {
    PointAndDerivative at;
    double turned = 0.0;  ///< direction from the start on, rad
    double turned_either_way = 0.0;
  };

  Place place_at(double bend) const {
    const auto above = std::upper_bound(cells_.begin() + 1, cells_.end() - 1, bend,
                                        [](double value, const Cell& cell) { return value < cell.bend; });
    const Cell& end = *above;
    const Cell& begin = *(above - 1);
    const double width = end.bend - begin.bend;
    const double share = width > 0.0 ? std::clamp((bend - begin.bend) / width, 0.0, 1.0) : 1.0;
    const double from = begin.piece == end.piece ? begin.place : 0.0;
    Place place;
    place.at = point_and_derivative(*pieces_[end.piece], from + share * (end.place - from));
    place.turned = begin.turned + share * (end.turned - begin.turned);
    place.turned_either_way =
        begin.turned_either_way + share * (end.turned_either_way - begin.turned_either_way);
    return place;
  }

 private:
  /// The end of a stretch of even curvature, and the sums up to there.
  struct Cell {
    std::size_t piece;
    double place;
    double bend;
    double turned;
    double turned_either_way;
  };

  void append(std::size_t piece, double place, double turn, double size) {
    const Cell& before = cells_.back();
    cells_.push_back({piece, place, before.bend + std::sqrt(std::abs(turn) * size / 8.0),
                      before.turned + turn, before.turned_either_way + std::abs(turn)});
  }

  void append_spline(std::size_t piece) {
    PointAndDerivative before = point_and_derivative(*pieces_[piece], 0.0);
    const std::vector<double> places = even_places(*pieces_[piece], 16);
    for (std::size_t k = 1; k < places.size(); ++k) {
      const PointAndDerivative here = point_and_derivative(*pieces_[piece], places[k]);
      const double turn =
          std::atan2(cross(before.derivative, here.derivative), before.derivative.dot(here.derivative));
      append(piece, places[k], turn, (here.point - before.point).norm());
      before = here;
    }
  }

  std::vector<const CurvePiece*> pieces_;
  std::vector<Cell> cells_;
  double area_ = 0.0;
};

double distance_to_chord(const Vector2& point, const Vector2& start, const Vector2& end) {
  const Vector2 side = end - start;
  const double squared = side.squaredNorm();
  const double share = squared > 0.0 ? std::clamp((point - start).dot(side) / squared, 0.0, 1.0) : 0.0;
  return (point - start - share * side).norm();
}

/// The chain of a run. A ring's first vertex is repeated at its end.
class RunChords {
 public:
  /// `bends` ascend from 0 to the run's whole bend.
  RunChords(const BentRun& run, std::vector<double> bends, double sagitta, bool ring)
      : run_(run), bends_(std::move(bends)), ring_(ring) {
    for (const double bend : bends_) places_.push_back(run.place_at(bend));
    place_vertices(sagitta);
    balance();
    balance();
  }

  const Polyline& vertices() const { return vertices_; }

  /// Between the curve and the chords, mm.
  double greatest_distance() const {
    double greatest = 0.0;
    constexpr int kParts = 8;
    for (std::size_t i = 0; i + 1 < vertices_.size(); ++i) {
      for (int k = 0; k < kParts; ++k) {
        const double bend = bends_[i] + (bends_[i + 1] - bends_[i]) * k / kParts;
        const Vector2 point = run_.place_at(bend).at.point;
        greatest = std::max(greatest, distance_to_chord(point, vertices_[i], vertices_[i + 1]));
      }
      greatest = std::max(greatest, (vertices_[i] - places_[i].at.point).norm());
    }
    return greatest;
  }

 private:
  bool kept(std::size_t i) const { return !ring_ && (i == 0 || i + 1 == places_.size()); }
  std::size_t count() const { return places_.size() - 1; }

  /// To the right of the direction: outwards where the curve turns to the left.
  Vector2 right(std::size_t i) const {
    const Vector2 along = places_[i].at.derivative.normalized();
    return {along.y(), -along.x()};
  }

  void place_vertices(double sagitta) {
    const std::size_t last = count();
    for (std::size_t i = 0; i <= last; ++i) {
      double offset = 0.0;
      if (!kept(i)) {
        // The share of the bends on both sides that goes to the left: 1 or -1 but near an inflection.
        const auto over = [&](auto sum) {
          const double before =
              i > 0 ? sum(places_[i]) - sum(places_[i - 1]) : sum(places_[last]) - sum(places_[last - 1]);
          const double after =
              i < last ? sum(places_[i + 1]) - sum(places_[i]) : sum(places_[1]) - sum(places_[0]);
          return before + after;
        };
        const double signed_turn = over([](const BentRun::Place& place) { return place.turned; });
        const double whole_turn = over([](const BentRun::Place& place) { return place.turned_either_way; });
        if (whole_turn > 0.0) offset = 2.0 / 3.0 * sagitta * signed_turn / whole_turn;
      }
      offsets_.push_back(offset);
      vertices_.push_back(places_[i].at.point + offset * right(i));
    }
    if (ring_) vertices_.back() = vertices_.front();
  }

  /// Moves the vertices, each in proportion to its offset, until the areas agree to first order.
  void balance() {
    double area = 0.0;
    double greatest = 0.0;
    for (std::size_t i = 0; i < count(); ++i) {
      area += 0.5 * cross(vertices_[i], vertices_[i + 1]);
      greatest = std::max(greatest, std::abs(offsets_[i]));
    }
    if (greatest == 0.0) return;
    const std::size_t first = ring_ ? 0 : 1;
    double gain = 0.0;
    for (std::size_t i = first; i < count(); ++i) {
      const Vector2& before = i > 0 ? vertices_[i - 1] : vertices_[count() - 1];
      gain += std::abs(offsets_[i]) / greatest * 0.5 * cross(right(i), vertices_[i + 1] - before);
    }
    if (!(gain > 0.0)) return;
    const double shift = (run_.area() - area) / gain;
    for (std::size_t i = first; i < count(); ++i) {
      vertices_[i] += shift * std::abs(offsets_[i]) / greatest * right(i);
    }
    if (ring_) vertices_.back() = vertices_.front();
  }

  const BentRun& run_;
  std::vector<double> bends_;
  bool ring_;
  std::vector<BentRun::Place> places_;
  std::vector<double> offsets_;
  Polyline vertices_;
};

/// Vertices of a run, both ends included.
Polyline run_vertices(const std::vector<const CurvePiece*>& pieces, double tolerance, bool ring) {
  const BentRun run(pieces);
  Polyline best{start_point(*pieces.front()), end_point(*pieces.back())};
  if (!ring && run.bend() * run.bend() <= kUnbalancedSagitta * tolerance) return best;
  double sagitta = 1.45 * tolerance;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const double wanted = run.bend() / std::sqrt(sagitta);
    const double chords =
        ring ? std::max(3.0, std::ceil(wanted)) : std::max(2.0, std::ceil(wanted + 2.0 - sqrt2));
    const double unit = run.bend() / (ring ? chords : chords - 2.0 + sqrt2);
    std::vector<double> bends{0.0};
    for (double k = 1.0; k < chords; ++k) bends.push_back(unit * (ring ? k : k - 1.0 + 1.0 / sqrt2));
    bends.push_back(run.bend());
    const RunChords result(run, std::move(bends), unit * unit, ring);
    best = result.vertices();
    const double distance = result.greatest_distance();
    if (distance <= kMeasuredShare * tolerance) break;
    sagitta *= std::clamp(0.95 * kMeasuredShare * tolerance / distance, 0.3, 0.9);
  }
  return best;
}

}  // namespace

Polyline flatten_balanced(const PieceCurve& curve, double tolerance) {
  const std::size_t count = curve.pieces.size();
  if (count == 0) return {};
  const auto next = [count](std::size_t i) { return i + 1 < count ? i + 1 : 0; };
  // A closed curve is cut where its chain may not leave it; if there is no such joint it is one ring.
  std::size_t first = 0;
  bool ring = false;
  if (curve.closed) {
    while (first < count && flows(curve.pieces[(first + count - 1) % count], curve.pieces[first])) ++first;
    ring = first == count;
    if (ring) first = 0;
  }
  Polyline points;
  std::size_t done = 0;
  while (done < count) {
    std::size_t i = (first + done) % count;
    std::vector<const CurvePiece*> run{&curve.pieces[i]};
    while (done + run.size() < count && flows(curve.pieces[i], curve.pieces[next(i)])) {
      i = next(i);
      run.push_back(&curve.pieces[i]);
    }
    const Polyline part = is_line(*run.front()) ? Polyline{start_point(*run.front()), end_point(*run.front())}
                                                : run_vertices(run, tolerance, ring);
    points.insert(points.end(), part.begin() + (points.empty() ? 0 : 1), part.end());
    done += run.size();
  }
  if (curve.closed) points.pop_back();
  return points;
}

}  // namespace lamina::engine
