#include "engine/import/trim/fitted_path.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lamina::engine {
namespace {

constexpr int kMostHalvings = 12;

/// One cubic, or a straight piece as one.
struct Piece {
  double last = 0.0;  ///< parameter of its end
  std::array<Vector2, 4> points;
  bool is_straight = false;
};

Vector2 on_cubic(const std::array<Vector2, 4>& p, double s) {
  const double r = 1.0 - s;
  return r * r * r * p[0] + 3.0 * r * r * s * p[1] + 3.0 * r * s * s * p[2] + s * s * s * p[3];
}

class PathFitter {
 public:
  PathFitter(const ParameterPath& path, const StepLength& length, double tolerance)
      : path_(path), length_(length), tolerance_(tolerance) {}

  void fit(double first, double last, const Vector2& start, const Vector2& end) {
    const double third = (last - first) / 3.0;
    fit(first, last, {start, path_(first + third), path_(last - third), end}, kMostHalvings);
  }

  std::vector<Piece> pieces;

 private:
  /// `known`: the points at thirds.
  void fit(double first, double last, const std::array<Vector2, 4>& known, int halvings) {
    const auto at_sixth = [&](int i) { return path_(first + (last - first) * i / 6.0); };
    const std::array<Vector2, 7> at{known[0], at_sixth(1), known[1], at_sixth(3),
                                    known[2], at_sixth(5), known[3]};
    const Vector2& start = at.front();
    const Vector2& end = at.back();
    if (is_straight(at)) {
      const Vector2 third = (end - start) / 3.0;
      pieces.push_back({last, {start, start + third, end - third, end}, true});
      return;
    }
    // Bezier points of the cubic through the points at 0, 1/3, 2/3 and 1.
    const Vector2& a = at[2];
    const Vector2& b = at[4];
    const std::array<Vector2, 4> cubic{start, (-5.0 * start + 18.0 * a - 9.0 * b + 2.0 * end) / 6.0,
                                       (2.0 * start - 9.0 * a + 18.0 * b - 5.0 * end) / 6.0, end};
    bool is_near = true;
    for (const std::size_t i : {std::size_t{1}, std::size_t{3}, std::size_t{5}}) {
      is_near =
          is_near && length_(at[i], on_cubic(cubic, static_cast<double>(i) / 6.0) - at[i]) <= tolerance_;
    }
    if (is_near || halvings == 0) {
      pieces.push_back({last, cubic, false});
      return;
    }
    const double middle = 0.5 * (first + last);
    fit(first, middle, {start, at[1], at[2], at[3]}, halvings - 1);
    fit(middle, last, {at[3], at[4], at[5], end}, halvings - 1);
  }

  bool is_straight(const std::array<Vector2, 7>& at) const {
    const Vector2 chord = at.back() - at.front();
    const double squared = chord.squaredNorm();
    for (std::size_t i = 1; i < 6; ++i) {
      const Vector2 to = at[i] - at.front();
      const double part = squared > 0.0 ? std::clamp(to.dot(chord) / squared, 0.0, 1.0) : 0.0;
      if (length_(at[i], part * chord - to) > tolerance_) return false;
    }
    return true;
  }

  const ParameterPath& path_;
  const StepLength& length_;
  double tolerance_;
};

Vector4 in_plane(const Vector2& point) {
  return {point.x(), point.y(), 0.0, 1.0};
}

}  // namespace

NurbsCurve fitted_path(const ParameterPath& path, const std::vector<double>& breaks, const StepLength& length,
                       double tolerance) {
  PathFitter fitter(path, length, tolerance);
  const Vector2 first = path(breaks.front());
  Vector2 start = first;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const Vector2 end = path(breaks[i]);
    fitter.fit(breaks[i - 1], breaks[i], start, end);
    start = end;
  }
  const auto& pieces = fitter.pieces;
  const bool straight =
      std::all_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.is_straight; });
  NurbsCurve curve;
  curve.degree = straight ? 1 : 3;
  const auto degree = static_cast<std::size_t>(curve.degree);
  curve.knots.assign(degree + 1, breaks.front());
  curve.control_points.push_back(in_plane(first));
  for (const Piece& piece : pieces) {
    if (!straight) {
      curve.control_points.push_back(in_plane(piece.points[1]));
      curve.control_points.push_back(in_plane(piece.points[2]));
    }
    curve.control_points.push_back(in_plane(piece.points[3]));
    curve.knots.insert(curve.knots.end(), degree, piece.last);
  }
  curve.knots.push_back(breaks.back());
  return curve;
}

}  // namespace lamina::engine
