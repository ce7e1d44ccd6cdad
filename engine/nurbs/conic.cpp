#include "engine/nurbs/conic.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "engine/nurbs/arc.h"

namespace lamina::engine {
namespace {

/// Above this weight a segment is halved: parameters then run evenly along the arc.
constexpr double kHighestWeight = 1.5;

Eigen::Matrix3d matrix_of(const Conic& q) {
  Eigen::Matrix3d matrix;
  matrix << q.a, q.b / 2.0, q.d / 2.0, q.b / 2.0, q.c, q.e / 2.0, q.d / 2.0, q.e / 2.0, q.f;
  return matrix;
}

/// Whether the determinant is nothing but the rounding of its terms.
bool determinant_vanishes(const Conic& q) {
  const double terms = std::abs(q.a * q.c * q.f) + std::abs(q.b * q.d * q.e) / 4.0 +
                       std::abs(q.a * q.e * q.e) / 4.0 + std::abs(q.c * q.d * q.d) / 4.0 +
                       std::abs(q.f * q.b * q.b) / 4.0;
  return std::abs(matrix_of(q).determinant()) <= 1e-14 * terms;
}

Vector3 projective(const Vector2& point) {
  return {point.x(), point.y(), 1.0};
}

/// Center and principal axes of an ellipse or hyperbola.
struct CentralForm {
  Vector2 center;
  Eigen::Matrix2d axes;     // columns: unit directions, right-handed
  Vector2 squared_lengths;  // of the semi-axes; the conjugate axis of a hyperbola has a negative one
};

CentralForm central_form(const Conic& conic) {
  const Eigen::Matrix3d matrix = matrix_of(conic);
  const Eigen::Matrix2d quadratic = matrix.topLeftCorner<2, 2>();
  CentralForm form;
  form.center = -quadratic.inverse() * matrix.topRightCorner<2, 1>();
  const Vector3 center = projective(form.center);
  const double constant = center.dot(matrix * center);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(quadratic);
  form.axes = solver.eigenvectors();
  if (form.axes.determinant() < 0.0) form.axes.col(1) *= -1.0;
  form.squared_lengths = -constant * solver.eigenvalues().cwiseInverse();
  return form;
}

NurbsCurve ellipse(const Conic& conic, const Vector2& start, const Vector2& end, double z) {
  const CentralForm form = central_form(conic);
  const Eigen::Matrix2d axes = form.axes * form.squared_lengths.cwiseSqrt().asDiagonal();
  const Eigen::Matrix2d to_circle = axes.inverse();
  const auto angle = [&](const Vector2& point) {
    const Vector2 on_circle = to_circle * (point - form.center);
    return std::atan2(on_circle.y(), on_circle.x());
  };
  const double first = angle(start);
  double last = start == end ? first : angle(end);
  if (last <= first) last += 2.0 * std::numbers::pi;
  const auto lifted = [](const Vector2& v) { return Vector3(v.x(), v.y(), 0.0); };
  return ellipse_arc({form.center.x(), form.center.y(), z}, lifted(axes.col(0)), lifted(axes.col(1)), first,
                     last);
}

/// Segment of a conic with weights 1, w, 1.
struct Segment {
  Vector2 start;
  Vector2 shoulder_tangent;
  Vector2 end;
  double weight = 1.0;
};

void append_halved(const Segment& segment, std::vector<Segment>& segments) {
  if (segment.weight <= kHighestWeight) {
    segments.push_back(segment);
    return;
  }
  // Halving at the shoulder, in standard form (The NURBS Book, equation 7.42).
  const double w = segment.weight;
  const Vector2 left = (segment.start + w * segment.shoulder_tangent) / (1.0 + w);
  const Vector2 right = (segment.end + w * segment.shoulder_tangent) / (1.0 + w);
  const Vector2 shoulder = 0.5 * (left + right);
  const double half_weight = std::sqrt((1.0 + w) / 2.0);
  append_halved({segment.start, left, shoulder, half_weight}, segments);
  append_halved({shoulder, right, segment.end, half_weight}, segments);
}

NurbsCurve curve_of(const std::vector<Segment>& segments, double z) {
  const auto point = [z](const Vector2& p, double weight) { return homogeneous({p.x(), p.y(), z}, weight); };
  NurbsCurve curve;
  curve.degree = 2;
  curve.knots.assign(3, 0.0);
  curve.control_points.push_back(point(segments.front().start, 1.0));
  for (std::size_t i = 0; i < segments.size(); ++i) {
    curve.control_points.push_back(point(segments[i].shoulder_tangent, segments[i].weight));
    curve.control_points.push_back(point(segments[i].end, 1.0));
    curve.knots.insert(curve.knots.end(), 2,
                       static_cast<double>(i + 1) / static_cast<double>(segments.size()));
  }
  curve.knots.push_back(1.0);
  return curve;
}

bool on_one_branch(const Conic& hyperbola, const Vector2& p, const Vector2& q) {
  const CentralForm form = central_form(hyperbola);
  const Vector2 transverse = form.axes.col(form.squared_lengths.x() > 0.0 ? 0 : 1);
  return (p - form.center).dot(transverse) * (q - form.center).dot(transverse) > 0.0;
}

std::optional<NurbsCurve> open_arc(const Conic& conic, const Vector2& start, const Vector2& end, double z,
                                   bool is_parabola) {
  const Eigen::Matrix3d matrix = matrix_of(conic);
  // The tangents at the ends meet in the pole of the chord.
  const Vector3 pole = (matrix * projective(start)).cross(matrix * projective(end));
  if (pole.z() == 0.0 || !pole.allFinite()) return std::nullopt;
  Segment segment{start, pole.head<2>() / pole.z(), end, 1.0};
  if (!is_parabola) {
    // Middle of the chord + w * pole lies on the conic; the mixed term vanishes, as the pole is conjugate to
    // the chord.
    const Vector3 middle = projective(0.5 * (start + end));
    const Vector3 tangent = projective(segment.shoulder_tangent);
    const double squared = -middle.dot(matrix * middle) / tangent.dot(matrix * tangent);
    if (!(squared > 0.0) || !std::isfinite(squared)) return std::nullopt;
    segment.weight = std::sqrt(squared);
  }
  std::vector<Segment> segments;
  append_halved(segment, segments);
  return curve_of(segments, z);
}

}  // namespace

ConicKind classify(const Conic& conic) {
  constexpr double kSingular = 1e-10;
  const Eigen::Matrix3d matrix = matrix_of(conic);
  const Eigen::Matrix2d quadratic = matrix.topLeftCorner<2, 2>();
  const double size = quadratic.squaredNorm();
  if (!matrix.allFinite() || size == 0.0 || determinant_vanishes(conic)) return ConicKind::kDegenerate;
  const double discriminant = quadratic.determinant();
  if (std::abs(discriminant) <= kSingular * size) return ConicKind::kParabola;
  if (discriminant < 0.0) return ConicKind::kHyperbola;
  return matrix.determinant() * quadratic.trace() < 0.0 ? ConicKind::kEllipse : ConicKind::kDegenerate;
}

double distance_to(const Conic& q, const Vector2& p) {
  const double value =
      q.a * p.x() * p.x() + q.b * p.x() * p.y() + q.c * p.y() * p.y() + q.d * p.x() + q.e * p.y() + q.f;
  const Vector2 gradient(2.0 * q.a * p.x() + q.b * p.y() + q.d, q.b * p.x() + 2.0 * q.c * p.y() + q.e);
  return std::abs(value) / gradient.norm();
}

std::optional<NurbsCurve> conic_arc(const Conic& conic, const Vector2& start, const Vector2& end, double z) {
  const ConicKind kind = classify(conic);
  if (kind == ConicKind::kEllipse) return ellipse(conic, start, end, z);
  if (kind == ConicKind::kDegenerate || start == end) return std::nullopt;
  if (kind == ConicKind::kHyperbola && !on_one_branch(conic, start, end)) return std::nullopt;
  return open_arc(conic, start, end, z, kind == ConicKind::kParabola);
}

}  // namespace lamina::engine
