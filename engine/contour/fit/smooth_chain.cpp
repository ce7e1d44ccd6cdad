#include "engine/contour/fit/smooth_chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

constexpr double kSamePlace = 1e-9;  // mm, to which nodes are exact
constexpr double kUnknownCornerAngle = std::numbers::pi / 6;

double turn(const Vector2& from, const Vector2& to) {
  return std::atan2(cross(from, to), from.dot(to));
}

/// The nodes without repeats; of nodes in one place the first gives the tangent in and the last the tangent
/// out.
std::vector<ContourNode> distinct_nodes(const NodeChain& chain) {
  std::vector<ContourNode> nodes;
  nodes.reserve(chain.nodes.size() + 1);
  const auto absorb = [](ContourNode& kept, const ContourNode& repeat) {
    kept.tangent_out = repeat.tangent_out;
    kept.corner = kept.corner || repeat.corner;
  };
  for (const ContourNode& node : chain.nodes) {
    if (!nodes.empty() && (nodes.back().position - node.position).norm() <= kSamePlace) {
      absorb(nodes.back(), node);
    } else {
      nodes.push_back(node);
    }
  }
  while (chain.closed && nodes.size() > 1 &&
         (nodes.back().position - nodes.front().position).norm() <= kSamePlace) {
    nodes.front().tangent_in = nodes.back().tangent_in;
    nodes.front().corner = nodes.front().corner || nodes.back().corner;
    nodes.pop_back();
  }
  return nodes;
}

/// Tangent in the middle of three points, of the circle through them.
Vector2 circle_tangent(const Vector2& before, const Vector2& here, const Vector2& after) {
  const Vector2 in = here - before;
  const Vector2 out = after - here;
  return (in / in.squaredNorm() + out / out.squaredNorm()).normalized();
}

/// Tangents as they are used: what the node says, or an estimate, or a corner's two sides.
void settle_tangents(std::vector<ContourNode>& nodes, bool closed, double corner_angle) {
  const std::size_t count = nodes.size();
  for (std::size_t i = 0; i < count; ++i) {
    ContourNode& node = nodes[i];
    const bool first = !closed && i == 0;
    const bool last = !closed && i + 1 == count;
    const Vector2& before = nodes[(i + count - 1) % count].position;
    const Vector2& after = nodes[(i + 1) % count].position;
    // Compared with both sides: on a closed chain of two nodes one and the same tangent may point against one
    // of them.
    const Vector2 side_in = first ? Vector2(after - node.position) : Vector2(node.position - before);
    const Vector2 side_out = last ? Vector2(node.position - before) : Vector2(after - node.position);
    const auto settled = [&](const Vector2& tangent, const Vector2& side, const Vector2& other_side) {
      const double size = tangent.norm();
      const bool usable = size > 0.5 && (tangent.dot(side) > 0.0 || tangent.dot(other_side) > 0.0);
      return usable ? Vector2(tangent / size) : Vector2(Vector2::Zero());
    };
    Vector2 in = settled(node.tangent_in, side_in, side_out);
    Vector2 out = settled(node.tangent_out, side_out, side_in);
    if (in.isZero(0.0) && out.isZero(0.0)) {
      if (std::abs(turn(side_in, side_out)) > kUnknownCornerAngle) node.corner = true;
      if (first || last || node.corner) {
        in = side_in.normalized();
        out = side_out.normalized();
      } else {
        in = out = circle_tangent(before, node.position, after);
      }
    } else if (in.isZero(0.0)) {
      in = node.corner ? Vector2(side_in.normalized()) : out;
    } else if (out.isZero(0.0)) {
      out = node.corner ? Vector2(side_out.normalized()) : in;
    }
    if (!first && !last && !node.corner) {
      // The angle is small where this matters: the chord between unit vectors stands for it.
      if ((out - in).norm() > corner_angle) {
        node.corner = true;
      } else {
        in = out = (in + out).normalized();
      }
    }
    node.tangent_in = in;
    node.tangent_out = out;
  }
}

}  // namespace

std::vector<SmoothChain> smooth_chains(const NodeChain& chain, double corner_angle) {
  std::vector<SmoothChain> chains;
  std::vector<ContourNode> nodes = distinct_nodes(chain);
  if (nodes.size() < 2) return chains;
  settle_tangents(nodes, chain.closed, corner_angle);
  bool smooth_all_round = false;
  if (chain.closed) {
    const auto corner =
        std::find_if(nodes.begin(), nodes.end(), [](const ContourNode& node) { return node.corner; });
    smooth_all_round = corner == nodes.end();
    if (!smooth_all_round) std::rotate(nodes.begin(), corner, nodes.end());
    nodes.push_back(nodes.front());
  }
  chains.emplace_back();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const ContourNode& node = nodes[i];
    const bool inside = i > 0 && i + 1 < nodes.size();
    chains.back().positions.push_back(node.position);
    chains.back().tangents.push_back(i == 0 ? node.tangent_out : node.tangent_in);
    if (inside && node.corner) {
      chains.emplace_back();
      chains.back().positions.push_back(node.position);
      chains.back().tangents.push_back(node.tangent_out);
    }
  }
  chains.front().closed = smooth_all_round;
  return chains;
}

Cubic hermite_cubic(const SmoothChain& chain, std::size_t segment) {
  const Vector2& start = chain.positions[segment];
  const Vector2& end = chain.positions[segment + 1];
  const Vector2& leaving = chain.tangents[segment];
  const Vector2& arriving = chain.tangents[segment + 1];
  const double half_cosine = std::sqrt(std::max(0.0, 0.5 * (1.0 + leaving.dot(arriving))));
  const double arm = (2.0 / 3.0) * (end - start).norm() / (1.0 + half_cosine);
  return {start, start + arm * leaving, end - arm * arriving, end};
}

Vector2 point_on(const Cubic& cubic, double u) {
  const double v = 1.0 - u;
  return v * v * v * cubic[0] + 3.0 * u * v * v * cubic[1] + 3.0 * u * u * v * cubic[2] +
         u * u * u * cubic[3];
}

Vector2 derivative_on(const Cubic& cubic, double u) {
  const double v = 1.0 - u;
  return 3.0 * (v * v * (cubic[1] - cubic[0]) + 2.0 * u * v * (cubic[2] - cubic[1]) +
                u * u * (cubic[3] - cubic[2]));
}

std::vector<double> segment_lengths(const SmoothChain& chain) {
  std::vector<double> lengths;
  lengths.reserve(chain.positions.size() - 1);
  for (std::size_t i = 0; i + 1 < chain.positions.size(); ++i) {
    const Cubic cubic = hermite_cubic(chain, i);
    const double chord = (cubic[3] - cubic[0]).norm();
    const double polygon =
        (cubic[1] - cubic[0]).norm() + (cubic[2] - cubic[1]).norm() + (cubic[3] - cubic[2]).norm();
    lengths.push_back(0.5 * (chord + polygon));
  }
  return lengths;
}

SmoothChain sub_chain(const SmoothChain& chain, std::size_t first, std::size_t last) {
  const auto part = [first, last](const std::vector<Vector2>& values) {
    return std::vector<Vector2>(values.begin() + static_cast<std::ptrdiff_t>(first),
                                values.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  };
  return {part(chain.positions), part(chain.tangents), false};
}

}  // namespace lamina::engine
