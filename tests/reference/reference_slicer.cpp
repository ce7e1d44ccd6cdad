#include "tests/reference/reference_slicer.h"

#include <cmath>

#include <fmt/format.h>

#include "tests/reference/contour/touch_cases.h"
#include "tests/reference/grid/mark_points.h"
#include "tests/reference/grid/separate.h"
#include "tests/reference/pointcloud/decompose.h"

namespace lamina::reference {
namespace {

constexpr int kHighestDegree = 9;

void check(const SliceOptions& options, const std::vector<SlicePlane>& planes) {
  if (!(options.layer_thickness > 0.0)) {
    throw SliceError(fmt::format("layer thickness is {} mm: it must be positive", options.layer_thickness));
  }
  if (!(options.epsilon > 2.0 * kModelTolerance)) {
    throw SliceError(fmt::format("tolerance is {} mm: it must be above {} mm, twice the model tolerance",
                                 options.epsilon, 2.0 * kModelTolerance));
  }
  if (options.degree < 1 || options.degree > kHighestDegree) {
    throw SliceError(fmt::format("curve degree is {}: it must be 1 to {}", options.degree, kHighestDegree));
  }
  if (options.band_constant < 2) {
    throw SliceError(fmt::format("band constant is {}: it must be at least 2", options.band_constant));
  }
  if (!(options.oversampling >= 1.0 && options.oversampling <= 10.0)) {
    throw SliceError(fmt::format("over-sampling is {}: it must be 1 to 10", options.oversampling));
  }
  for (std::size_t k = 1; k < planes.size(); ++k) {
    if (!(planes[k].z >= planes[k - 1].z)) {
      throw SliceError(fmt::format("plane {} at z = {} mm lies below the plane before it (z = {} mm)", k,
                                   planes[k].z, planes[k - 1].z));
    }
  }
}

Box3 box_of(const std::vector<ListedPatch>& patches) {
  Box3 box;
  for (const ListedPatch& patch : patches) box.extend(patch.box);
  return box;
}

std::vector<ListedPatch> listed_patches(const Model& model, const SliceOptions& options,
                                        const std::vector<SlicePlane>& planes) {
  check(options, planes);
  return make_global_list(decompose(model, {options.layer_thickness, options.band_constant}));
}

double height_of(const std::vector<ListedPatch>& patches) {
  const Box3 box = box_of(patches);
  return box.isEmpty() ? 0.0 : box.sizes().z();
}

void check_grid_size(const std::vector<ListedPatch>& patches, const SliceOptions& options) {
  const Box3 box = box_of(patches);
  if (box.isEmpty()) return;
  const Vector3 size = box.sizes();
  const double cells = (size.x() / options.epsilon + 1.0) * (size.y() / options.epsilon + 1.0);
  if (cells <= options.most_cells) return;
  throw SliceError(
      fmt::format("a layer of {:.6g} x {:.6g} mm has {:.3g} cells of {} mm: the limit is {:.3g}. Choose a "
                  "tolerance of {:.2g} mm or "
                  "more, or scale the model",
                  size.x(), size.y(), cells, options.epsilon, options.most_cells,
                  1.01 * std::sqrt(size.x() * size.y() / options.most_cells)));
}

void append(Layer& layer, ComponentContours contours) {
  const auto move_all = [](auto& from, auto& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  move_all(contours.closed, layer.closed);
  move_all(contours.open, layer.open);
  move_all(contours.planar, layer.planar);
  move_all(contours.points, layer.points);
  layer.report.boundary_cells += contours.boundary_cells;
  layer.report.unfitted_curves += contours.unfitted_curves;
  layer.report.dropped_spurs += contours.dropped_spurs;
}

std::size_t count_control_points(const Layer& layer) {
  std::size_t count = 0;
  for (const ClosedContour& contour : layer.closed) count += contour.curve.control_points.size();
  for (const OpenContour& contour : layer.open) count += contour.curve.control_points.size();
  for (const PlanarContour& contour : layer.planar) {
    count += contour.outer.control_points.size();
    for (const PlanarCurve& curve : contour.inner) count += curve.control_points.size();
  }
  return count;
}

}  // namespace

ReferenceSlicer::ReferenceSlicer(const Model& model, std::vector<SlicePlane> planes,
                                 const SliceOptions& options)
    : options_(options),
      planes_(std::move(planes)),
      global_list_(listed_patches(model, options_, planes_)),
      active_(global_list_, options_.layer_thickness, height_of(global_list_)) {
  check_grid_size(global_list_, options_);
}

std::optional<Layer> ReferenceSlicer::next() {
  if (next_plane_ == planes_.size()) return std::nullopt;
  Layer layer;
  layer.index = next_plane_;
  layer.plane = planes_[next_plane_++];
  const double z = layer.plane.z;

  active_.advance(global_list_, z, options_.epsilon, {options_.epsilon, options_.oversampling});
  const MarkedGrid marked = make_layer_grid(global_list_, active_, z, options_.epsilon);
  const std::vector<Component> components = separate(marked.grid);
  for (const Component& component : components) {
    layer.report.strong_cells += component.cells.size();
    append(layer, make_contours(component_grid(marked.grid, component), component.touch(),
                                {options_.epsilon, options_.degree}));
  }

  LayerReport& report = layer.report;
  report.active_patches = active_.patches().size();
  report.patches_added = active_.added();
  report.patches_removed = active_.removed();
  report.points_near_plane = marked.points_near_plane;
  for (const ActivePatch& patch : active_.patches()) report.points_held += patch.points.size();
  report.grid_cells = static_cast<std::size_t>(marked.grid.columns() * marked.grid.rows());
  report.components = components.size();
  report.control_points = count_control_points(layer);
  return layer;
}

}  // namespace lamina::reference
