#include "engine/pointcloud/patch_section.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "engine/model.h"
#include "engine/pointcloud/arc_nodes.h"
#include "engine/pointcloud/height_net.h"

namespace lamina::engine {
namespace {

constexpr int kDeepestCell = 60;

/// Longest polygon along each direction of the net.
std::pair<double, double> net_size(const FrontPatch& patch) {
  const std::vector<Vector4>& points = patch.points();
  const int order_v = patch.degree_v + 1;
  const auto at = [&](int i, int j) {
    const Vector4& p = points[static_cast<std::size_t>(i * order_v + j)];
    return Vector3(p.head<3>() / p.w());
  };
  double size_u = 0.0;
  double size_v = 0.0;
  for (int j = 0; j < order_v; ++j) {
    double along = 0.0;
    for (int i = 1; i <= patch.degree_u; ++i) along += (at(i, j) - at(i - 1, j)).norm();
    size_u = std::max(size_u, along);
  }
  for (int i = 0; i <= patch.degree_u; ++i) {
    double along = 0.0;
    for (int j = 1; j < order_v; ++j) along += (at(i, j) - at(i, j - 1)).norm();
    size_v = std::max(size_v, along);
  }
  return {size_u, size_v};
}

}  // namespace

void PatchSection::cut(const FrontPatch& patch, double z, Section& section) {
  patch_ = &patch;
  section_ = &section;
  z_ = z;
  const std::vector<Vector4>& points = patch.points();
  const std::size_t size = points.size();
  // Two children on the stack at each depth.
  const std::size_t needed = size * 2 * (kDeepestCell + 2);
  if (nets_.size() < needed) nets_.resize(needed);
  double* net = nets_.data();
  for (std::size_t k = 0; k < size; ++k) net[k] = points[k].z() - z * points[k].w();
  size_u_ = -1.0;  // found when a cell has to be divided
  // A vertex in the plane is exactly so for every patch around it.
  const int order_v = patch.degree_v + 1;
  const auto corner = [&](int i, int j) {
    const auto index = static_cast<std::size_t>(i * order_v + j);
    if (std::abs(net[index]) <= kModelTolerance * points[index].w()) net[index] = 0.0;
  };
  corner(0, 0);
  corner(0, patch.degree_v);
  corner(patch.degree_u, 0);
  corner(patch.degree_u, patch.degree_v);
  visit(net, {0.0, 1.0, 0.0, 1.0}, 0);
}

bool PatchSection::snap_edges(double* net) const {
  const int order_u = patch_->degree_u + 1;
  const int order_v = patch_->degree_v + 1;
  const double tolerance = kModelTolerance;
  const auto snap = [&](double* first, std::ptrdiff_t stride, int count) {
    if (!all_within(first, stride, count, tolerance)) return false;
    for (int k = 0; k < count; ++k) first[k * stride] = 0.0;
    return true;
  };
  const bool a = snap(net, 1, order_v);
  const bool b = snap(net + patch_->degree_u * order_v, 1, order_v);
  const bool c = snap(net, order_v, order_u);
  const bool d = snap(net + patch_->degree_v, order_v, order_u);
  return a || b || c || d;
}

void PatchSection::visit(double* net, const Rectangle& rectangle, int depth) {
  ++section_->cells;
  const int order_u = patch_->degree_u + 1;
  const int order_v = patch_->degree_v + 1;
  const int size = order_u * order_v;
  double lowest = net[0];
  double highest = net[0];
  for (int k = 1; k < size; ++k) {
    lowest = std::min(lowest, net[k]);
    highest = std::max(highest, net[k]);
  }
  if (lowest > kModelTolerance || highest < -kModelTolerance) return;
  if (lowest >= -kModelTolerance && highest <= kModelTolerance) {
    emit_flat(rectangle);
    return;
  }
  const bool edge_in_plane = snap_edges(net);
  if (lowest >= -kModelTolerance && (edge_in_plane || lowest >= 0.0)) {
    emit_one_sided(net, rectangle, true);
    return;
  }
  if (highest <= kModelTolerance && (edge_in_plane || highest <= 0.0)) {
    emit_one_sided(net, rectangle, false);
    return;
  }
  if (lowest >= 0.0 || highest < 0.0) return;

  const int rise_u = monotone(net, order_v, order_u, 1, order_v);
  const int rise_v = monotone(net, 1, order_v, order_v, order_u);
  if (!edge_in_plane && (rise_u != 0 || rise_v != 0)) {
    // Where both hold, the parameter that the height depends on more is solved for.
    const auto range = [&](int step_index) {
      return std::abs(net[step_index] - net[0]) + std::abs(net[size - 1] - net[size - 1 - step_index]);
    };
    const bool by_u = rise_v == 0 || (rise_u != 0 && range((order_u - 1) * order_v) >= range(order_v - 1));
    const Direction solved = by_u ? Direction::kU : Direction::kV;
    if (emit_monotone(net, rectangle, solved, (by_u ? rise_u : rise_v) > 0, false)) return;
    if (rise_u != 0 && rise_v != 0 &&
        emit_monotone(net, rectangle, other(solved), (by_u ? rise_v : rise_u) > 0, false))
      return;
  }
  if (size_u_ < 0.0) std::tie(size_u_, size_v_) = net_size(*patch_);
  const double along_u = size_u_ * (rectangle.u1 - rectangle.u0);
  const double along_v = size_v_ * (rectangle.v1 - rectangle.v0);
  if (depth >= kDeepestCell || std::max(along_u, along_v) <= options_.smallest_cell) {
    emit_unresolved(net, rectangle);
    return;
  }
  halve(net, rectangle, net + size, depth, along_u >= along_v ? Direction::kU : Direction::kV);
}

void PatchSection::halve(const double* net, const Rectangle& r, double* free, int depth,
                         Direction direction) {
  const int order_u = patch_->degree_u + 1;
  const int order_v = patch_->degree_v + 1;
  const int size = order_u * order_v;
  // The high half lies below the low one on the stack, so that it outlives the visit to it.
  double* high = free;
  double* low = free + size;
  if (direction == Direction::kU) {
    for (int j = 0; j < order_v; ++j) halve_line(net + j, low + j, high + j, order_v, order_u);
    const double middle = 0.5 * (r.u0 + r.u1);
    visit(low, {r.u0, middle, r.v0, r.v1}, depth + 1);
    visit(high, {middle, r.u1, r.v0, r.v1}, depth + 1);
  } else {
    for (int i = 0; i < order_u; ++i) {
      halve_line(net + i * order_v, low + i * order_v, high + i * order_v, 1, order_v);
    }
    const double middle = 0.5 * (r.v0 + r.v1);
    visit(low, {r.u0, r.u1, r.v0, middle}, depth + 1);
    visit(high, {r.u0, r.u1, middle, r.v1}, depth + 1);
  }
}

bool PatchSection::emit_monotone(const double* net, const Rectangle& r, Direction solved, bool rising,
                                 bool at_limit) {
  const int order_u = patch_->degree_u + 1;
  const int order_v = patch_->degree_v + 1;
  const bool by_u = solved == Direction::kU;
  // The edges across the solved direction, as numbers along the running one.
  const std::ptrdiff_t stride = by_u ? 1 : order_v;
  const int count = by_u ? order_v : order_u;
  const double* low_edge = net;
  const double* high_edge = by_u ? net + patch_->degree_u * order_v : net + patch_->degree_v;
  if (!at_limit && (sign_changes(low_edge, stride, count) > 1 || sign_changes(high_edge, stride, count) > 1))
    return false;
  const double s0 = by_u ? r.u0 : r.v0;
  const double s1 = by_u ? r.u1 : r.v1;
  const double t0 = by_u ? r.v0 : r.u0;
  const double t1 = by_u ? r.v1 : r.u1;

  // Where a line between two heights is zero, as a first guess for the curve between them.
  const auto zero_between = [](double from, double f_from, double to, double f_to) {
    return from + (to - from) * f_from / (f_from - f_to);
  };
  // Where the running parameter can go: the height must be below the plane at one edge and above at the
  // other.
  struct End {
    double t;
    std::optional<CrossingPoint> on_edge;
  };
  End first{t0, std::nullopt};
  End last{t1, std::nullopt};
  const auto restrict_to = [&](const double* edge, bool wants_below, double s) {
    const double f0 = edge[0];
    const double f1 = edge[(count - 1) * stride];
    const bool start_fits = (f0 < 0.0) == wants_below;
    const bool end_fits = (f1 < 0.0) == wants_below;
    if (start_fits && end_fits) return true;
    if (!start_fits && !end_fits) return false;
    CrossingPoint point =
        crossing_on_line(*patch_, z_, {solved, s, t0, t1, f0 < 0.0, zero_between(t0, f0, t1, f1)});
    const double t = point.parameter;
    if (start_fits ? t > last.t : t < first.t) return true;
    // As seen from lines across.
    point.parameter = s;
    point.slope = 1.0 / point.slope;
    (start_fits ? last : first) = {t, point};
    return true;
  };
  if (!restrict_to(low_edge, rising, s0)) return true;
  if (!restrict_to(high_edge, !rising, s1)) return true;
  if (!(first.t < last.t)) return true;

  const LineCrossing line{other(solved), 0.0, s0, s1, rising};
  const auto end_point = [&](const End& end, std::ptrdiff_t at) {
    if (end.on_edge) return *end.on_edge;
    LineCrossing across = line;
    across.at = end.t;
    across.guess = zero_between(s0, low_edge[at], s1, high_edge[at]);
    return crossing_on_line(*patch_, z_, across);
  };
  const CrossingPoint start = end_point(first, 0);
  const CrossingPoint end = end_point(last, (count - 1) * stride);
  // The outward normal lies on the right when v falls where the height rises with u, and u rises where it
  // rises with v.
  const bool flipped = by_u == rising;
  ArcNodes nodes = arc_nodes();
  section_->arcs.push_back(flipped ? nodes.crossing(line, last.t, end, first.t, start)
                                   : nodes.crossing(line, first.t, start, last.t, end));
  return true;
}

void PatchSection::emit_unresolved(const double* net, const Rectangle& r) {
  ++section_->unresolved_cells;
  const int order_v = patch_->degree_v + 1;
  const double corner[4] = {net[0], net[patch_->degree_u * order_v],
                            net[patch_->degree_u * order_v + patch_->degree_v], net[patch_->degree_v]};
  // Edges in turn around the cell, each from a corner to the next.
  const LineCrossing edges[4] = {{Direction::kV, r.v0, r.u0, r.u1, true},
                                 {Direction::kU, r.u1, r.v0, r.v1, true},
                                 {Direction::kV, r.v1, r.u0, r.u1, false},
                                 {Direction::kU, r.u0, r.v0, r.v1, false}};
  SectionNode crossings[4];
  int found = 0;
  for (int k = 0; k < 4; ++k) {
    const bool below = corner[k] < 0.0;
    if (below == (corner[(k + 1) % 4] < 0.0)) continue;
    LineCrossing edge = edges[k];
    edge.rising = edge.rising == below;
    crossings[found++] = crossing_on_line(*patch_, z_, edge).node;
  }
  for (int k = 0; k + 1 < found; k += 2) {
    SectionNode a = crossings[k];
    SectionNode b = crossings[k + 1];
    if ((b.position - a.position).dot(a.tangent + b.tangent) < 0.0) std::swap(a, b);
    const SectionArc arc{static_cast<std::uint32_t>(section_->nodes.size()), 2, patch_->span.surface,
                         ArcKind::kCrossing};
    section_->nodes.push_back(a);
    section_->nodes.push_back(b);
    section_->arcs.push_back(arc);
  }
}

void PatchSection::emit_one_sided(const double* net, const Rectangle& r, bool above) {
  const int order_u = patch_->degree_u + 1;
  const int order_v = patch_->degree_v + 1;
  const double* last_row = net + patch_->degree_u * order_v;
  const double* last_column = net + patch_->degree_v;
  const ArcKind kind = above ? ArcKind::kEdgeAbove : ArcKind::kEdgeBelow;
  const bool upright =
      point_on_line(*patch_, Direction::kU, 0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1)).upright();
  bool corner_covered[4] = {false, false, false, false};  // (u0,v0), (u1,v0), (u1,v1), (u0,v1)
  const auto edge = [&](bool in_plane, Direction held, double at, double from, double to, int corner_a,
                        int corner_b) {
    if (!in_plane) return;
    corner_covered[corner_a] = corner_covered[corner_b] = true;
    const std::size_t before = section_->nodes.size();
    SectionArc arc = arc_nodes().edge(held, at, from, to, kind);
    arc.upright = arc.upright && upright;
    double length = 0.0;
    for (std::size_t k = before + 1; k < section_->nodes.size(); ++k) {
      length += (section_->nodes[k].position - section_->nodes[k - 1].position).norm();
    }
    if (length > kModelTolerance) {
      section_->arcs.push_back(arc);
    } else {
      section_->touches.push_back({section_->nodes[before].position, above});
      section_->nodes.resize(before);
    }
  };
  edge(all_zero(net, order_v, order_u), Direction::kV, r.v0, r.u0, r.u1, 0, 1);
  edge(all_zero(last_row, 1, order_v), Direction::kU, r.u1, r.v0, r.v1, 1, 2);
  edge(all_zero(last_column, order_v, order_u), Direction::kV, r.v1, r.u0, r.u1, 3, 2);
  edge(all_zero(net, 1, order_v), Direction::kU, r.u0, r.v0, r.v1, 0, 3);
  const auto corner = [&](int index, double value, double u, double v) {
    if (value != 0.0 || corner_covered[index]) return;
    section_->touches.push_back({point_on_line(*patch_, Direction::kU, u, v).position, above});
  };
  corner(0, net[0], r.u0, r.v0);
  corner(1, last_row[0], r.u1, r.v0);
  corner(2, last_row[patch_->degree_v], r.u1, r.v1);
  corner(3, last_column[0], r.u0, r.v1);
}

void PatchSection::emit_flat(const Rectangle& r) {
  const std::size_t first = section_->flat_rims.size();
  section_->flat_rims.push_back(arc_nodes().edge(Direction::kV, r.v0, r.u0, r.u1, ArcKind::kFlatRim));
  section_->flat_rims.push_back(arc_nodes().edge(Direction::kU, r.u1, r.v0, r.v1, ArcKind::kFlatRim));
  section_->flat_rims.push_back(arc_nodes().edge(Direction::kV, r.v1, r.u1, r.u0, ArcKind::kFlatRim));
  section_->flat_rims.push_back(arc_nodes().edge(Direction::kU, r.u0, r.v1, r.v0, ArcKind::kFlatRim));
  Box2 box;
  for (std::size_t k = section_->flat_rims[first].first; k < section_->nodes.size(); ++k)
    box.extend(section_->nodes[k].position);
  section_->flats.push_back({static_cast<std::uint32_t>(first), 4, box.sizes().maxCoeff(), false});
}

}  // namespace lamina::engine
