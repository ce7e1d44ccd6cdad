#include "tests/reference/pointcloud/decompose.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "engine/nurbs/curve.h"
#include "engine/nurbs/knot_insertion.h"

namespace lamina::reference {
namespace {

/// `count` evenly spaced knots inside each non-zero span.
std::vector<double> knots_within_spans(const Knots& knots, int degree, int count) {
  const std::vector<double> breaks = break_points(knots, degree);
  std::vector<double> inserted;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (int k = 1; k <= count; ++k) {
      inserted.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / (count + 1));
    }
  }
  return inserted;
}

}  // namespace

Extent net_extent(const ControlNet& net) {
  Extent extent;
  for (std::size_t j = 0; j < net.count_v; ++j) {
    double along_u = 0.0;
    for (std::size_t i = 1; i < net.count_u; ++i) {
      along_u += (cartesian(net.at(i, j)) - cartesian(net.at(i - 1, j))).norm();
    }
    extent.u = std::max(extent.u, along_u);
  }
  for (std::size_t i = 0; i < net.count_u; ++i) {
    double along_v = 0.0;
    for (std::size_t j = 1; j < net.count_v; ++j) {
      along_v += (cartesian(net.at(i, j)) - cartesian(net.at(i, j - 1))).norm();
    }
    extent.v = std::max(extent.v, along_v);
  }
  return extent;
}

Extent surface_extent(const NurbsSurface& surface) {
  const NurbsSurface refined = insert_knots(surface, knots_within_spans(surface.knots_u, surface.degree_u, 1),
                                            knots_within_spans(surface.knots_v, surface.degree_v, 1));
  return net_extent(refined.net);
}

int inserted_knots_per_span(double extent, std::size_t spans, double band) {
  return static_cast<int>(std::floor(extent / static_cast<double>(spans) / band + 0.5));
}

std::vector<BezierPatch> decompose(const Model& model, const DecomposeOptions& options) {
  if (!(options.layer_thickness > 0.0)) throw std::invalid_argument("layer thickness must be positive");
  if (options.band_constant < 2) throw std::invalid_argument("band constant must be greater than one");
  const double band = options.band_constant * options.layer_thickness;
  std::vector<BezierPatch> patches;
  for (const Surface& surface : model.surfaces) {
    const NurbsSurface& nurbs = surface.nurbs;
    const Extent extent = surface_extent(nurbs);
    const std::size_t spans_u = break_points(nurbs.knots_u, nurbs.degree_u).size() - 1;
    const std::size_t spans_v = break_points(nurbs.knots_v, nurbs.degree_v).size() - 1;
    const int count_u = inserted_knots_per_span(extent.u, spans_u, band);
    const int count_v = inserted_knots_per_span(extent.v, spans_v, band);
    const NurbsSurface refined =
        insert_knots(nurbs, knots_within_spans(nurbs.knots_u, nurbs.degree_u, count_u),
                     knots_within_spans(nurbs.knots_v, nurbs.degree_v, count_v));
    std::vector<BezierPatch> cut = bezier_patches(refined);
    patches.insert(patches.end(), std::make_move_iterator(cut.begin()), std::make_move_iterator(cut.end()));
  }
  return patches;
}

}  // namespace lamina::reference
