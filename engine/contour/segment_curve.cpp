#include "engine/contour/segment_curve.h"

#include <algorithm>
#include <cmath>

namespace lamina::engine {
namespace {

constexpr int kMostSteps = 8;
constexpr double kLeastSine = 1e-3;
constexpr double kBeyondEnds = 0.2;

}  // namespace

SegmentCurve::SegmentCurve(const NodeChain& chain, std::size_t segment) {
  const ContourNode& from = chain.nodes[segment];
  const ContourNode& to = chain.nodes[segment + 1 == chain.nodes.size() ? 0 : segment + 1];
  start_ = from.position;
  end_ = to.position;
  const Vector2 chord = end_ - start_;
  const double length = chord.norm();
  const bool known = from.tangent_out.dot(chord) > 0.5 * length && to.tangent_in.dot(chord) > 0.5 * length;
  start_slope_ = known ? Vector2(length * from.tangent_out) : chord;
  end_slope_ = known ? Vector2(length * to.tangent_in) : chord;
}

Vector2 SegmentCurve::point(double t) const {
  const double s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * start_ + t * t * (3.0 - 2.0 * t) * end_ + s * s * t * start_slope_ -
         t * t * s * end_slope_;
}

Vector2 SegmentCurve::derivative(double t) const {
  const double s = 1.0 - t;
  return 6.0 * s * t * (end_ - start_) + s * (s - 2.0 * t) * start_slope_ + t * (t - 2.0 * s) * end_slope_;
}

Vector2 SegmentCurve::tangent(double t) const {
  const Vector2 d = derivative(std::clamp(t, 0.0, 1.0));
  const double length = d.norm();
  return length > 0.0 ? Vector2(d / length) : Vector2(Vector2::Zero());
}

double SegmentCurve::parameter_near(const Vector2& place) const {
  const Vector2 chord = end_ - start_;
  const double length = chord.squaredNorm();
  return length > 0.0 ? std::clamp((place - start_).dot(chord) / length, 0.0, 1.0) : 0.0;
}

CurveMeeting meet(const SegmentCurve& first, const SegmentCurve& second, const Vector2& place) {
  const CurveMeeting fallback{place, first.parameter_near(place), second.parameter_near(place)};
  CurveMeeting meeting = fallback;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector2 off = second.point(meeting.second) - first.point(meeting.first);
    const Vector2 a = first.derivative(meeting.first);
    const Vector2 b = second.derivative(meeting.second);
    const double determinant = b.x() * a.y() - a.x() * b.y();
    if (std::abs(determinant) < kLeastSine * a.norm() * b.norm()) return fallback;
    const double move_a = (b.x() * off.y() - b.y() * off.x()) / determinant;
    const double move_b = (a.x() * off.y() - a.y() * off.x()) / determinant;
    meeting.first += move_a;
    meeting.second += move_b;
    const auto lost = [](double t) { return !(t > -kBeyondEnds && t < 1.0 + kBeyondEnds); };
    if (lost(meeting.first) || lost(meeting.second)) return fallback;
    if (std::abs(move_a) + std::abs(move_b) < 1e-14) break;
  }
  meeting.position = 0.5 * (first.point(meeting.first) + second.point(meeting.second));
  return meeting;
}

}  // namespace lamina::engine
