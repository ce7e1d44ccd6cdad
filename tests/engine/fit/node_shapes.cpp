#include "tests/engine/fit/node_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace lamina::tests {

using engine::ContourNode;
using engine::NodeChain;
using engine::PlanarCurve;
using engine::Vector2;
using std::numbers::pi;

ParametricCurve ellipse(double a, double b) {
  return {[=](double t) { return Vector2(a * std::cos(2 * pi * t), b * std::sin(2 * pi * t)); },
          [=](double t) { return Vector2(-a * std::sin(2 * pi * t), b * std::cos(2 * pi * t)); }};
}

ParametricCurve spiral(double inner, double growth, double turns) {
  return {[=](double t) {
            const double angle = 2 * pi * turns * t;
            return Vector2((inner + growth * angle) * Vector2(std::cos(angle), std::sin(angle)));
          },
          [=](double t) {
            const double angle = 2 * pi * turns * t;
            return Vector2(growth * Vector2(std::cos(angle), std::sin(angle)) +
                           (inner + growth * angle) * Vector2(-std::sin(angle), std::cos(angle)));
          }};
}

ParametricCurve flower(double radius, double depth, int petals) {
  return {[=](double t) {
            const double angle = 2 * pi * t;
            return Vector2((radius + depth * std::cos(petals * angle)) *
                           Vector2(std::cos(angle), std::sin(angle)));
          },
          [=](double t) {
            const double angle = 2 * pi * t;
            return Vector2(
                -petals * depth * std::sin(petals * angle) * Vector2(std::cos(angle), std::sin(angle)) +
                (radius + depth * std::cos(petals * angle)) * Vector2(-std::sin(angle), std::cos(angle)));
          }};
}

ParametricCurve spline(const PlanarCurve& curve) {
  const double begin = curve.first_parameter();
  const double width = curve.last_parameter() - begin;
  return {[=](double t) { return evaluate(curve, begin + t * width); },
          [=](double t) { return evaluate_derivative(curve, begin + t * width); }};
}

PlanarCurve random_spline(int degree, std::size_t control_points, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(-1.5, 1.5);
  std::uniform_real_distribution<double> stride(3.0, 5.0);
  PlanarCurve curve;
  curve.degree = degree;
  double x = 0.0;
  for (std::size_t i = 0; i < control_points; ++i) {
    curve.control_points.emplace_back(x, height(random));
    x += stride(random);
  }
  const std::size_t spans = control_points - static_cast<std::size_t>(degree);
  curve.knots.assign(static_cast<std::size_t>(degree), 0.0);
  for (std::size_t i = 0; i <= spans; ++i)
    curve.knots.push_back(static_cast<double>(i) / static_cast<double>(spans));
  curve.knots.insert(curve.knots.end(), static_cast<std::size_t>(degree), 1.0);
  return curve;
}

NodeChain nodes_on(const ParametricCurve& curve, std::size_t count, bool closed) {
  NodeChain chain;
  chain.closed = closed;
  for (std::size_t i = 0; i < (closed ? count : count + 1); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count);
    ContourNode node;
    node.position = curve.point(t);
    node.tangent_in = node.tangent_out = curve.derivative(t).normalized();
    chain.nodes.push_back(node);
  }
  return chain;
}

NodePen::NodePen(const Vector2& start, double heading) : heading_(heading) {
  ContourNode node;
  node.position = start;
  node.tangent_in = node.tangent_out = heading_vector();
  chain_.nodes.push_back(node);
}

Vector2 NodePen::heading_vector() const {
  return {std::cos(heading_), std::sin(heading_)};
}

void NodePen::step_to(const Vector2& position) {
  ContourNode node;
  node.position = position;
  node.tangent_in = node.tangent_out = heading_vector();
  chain_.nodes.push_back(node);
}

NodePen& NodePen::line(double length, std::size_t segments) {
  const Vector2 start = chain_.nodes.back().position;
  for (std::size_t k = 1; k <= segments; ++k) {
    step_to(start + length * static_cast<double>(k) / static_cast<double>(segments) * heading_vector());
  }
  return *this;
}

NodePen& NodePen::arc(double radius, double angle, std::size_t segments) {
  const double side = angle > 0.0 ? 1.0 : -1.0;
  const double begin = heading_;
  const auto spoke = [side](double heading) {
    return Vector2(side * Vector2(std::sin(heading), -std::cos(heading)));
  };
  const Vector2 centre = chain_.nodes.back().position - radius * spoke(begin);
  for (std::size_t k = 1; k <= segments; ++k) {
    heading_ = begin + angle * static_cast<double>(k) / static_cast<double>(segments);
    step_to(centre + radius * spoke(heading_));
  }
  return *this;
}

NodePen& NodePen::turn(double angle) {
  heading_ += angle;
  chain_.nodes.back().tangent_out = heading_vector();
  return *this;
}

NodeChain NodePen::open() const {
  return chain_;
}

NodeChain NodePen::closed() const {
  NodeChain chain = chain_;
  chain.closed = true;
  chain.nodes.front().tangent_in = chain.nodes.back().tangent_in;
  chain.nodes.pop_back();
  return chain;
}

NodeChain rounded_rectangle(double width, double height, double radius, std::size_t segments) {
  NodePen pen({radius, 0.0});
  for (const double side : {width, height, width, height}) {
    pen.line(side - 2 * radius).arc(radius, pi / 2, segments);
  }
  return pen.closed();
}

NodeChain reversed(const NodeChain& chain) {
  NodeChain result = chain;
  std::reverse(result.nodes.begin(), result.nodes.end());
  for (ContourNode& node : result.nodes) {
    const Vector2 in = node.tangent_in;
    node.tangent_in = -node.tangent_out;
    node.tangent_out = -in;
  }
  return result;
}

NodeChain placed(const NodeChain& chain, double angle, double scale, const Vector2& shift) {
  const Eigen::Rotation2Dd rotation(angle);
  NodeChain result = chain;
  for (ContourNode& node : result.nodes) {
    node.position = scale * (rotation * node.position) + shift;
    node.tangent_in = rotation * node.tangent_in;
    node.tangent_out = rotation * node.tangent_out;
  }
  return result;
}

std::string letters(const engine::PieceCurve& curve) {
  std::string result;
  for (const engine::CurvePiece& piece : curve.pieces) result += "LAS"[piece.index()];
  return result;
}

}  // namespace lamina::tests
