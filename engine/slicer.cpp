#include "engine/slicer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "engine/layer_queue.h"
#include "engine/pointcloud/patch_point.h"
#include "engine/scan/prepare_scan.h"

namespace lamina::engine {
namespace {

/// To three digits, such that it is enough.
double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return std::ceil(value / unit) * unit;
}

void check(const Model& model, const std::vector<SlicePlane>& planes, const SliceOptions& options) {
  if (!(options.epsilon > 2.0 * kModelTolerance)) {
    throw SliceError(fmt::format("tolerance is {} mm: it must be above {} mm, twice the model tolerance",
                                 options.epsilon, 2.0 * kModelTolerance));
  }
  if (options.greatest_degree < 2 || options.greatest_degree > 5) {
    throw SliceError(fmt::format("curve degree is {}: it must be 2 to 5", options.greatest_degree));
  }
  if (options.threads < 0) {
    throw SliceError(
        fmt::format("thread count is {}: it must be positive, or 0 for one a core", options.threads));
  }
  for (std::size_t k = 1; k < planes.size(); ++k) {
    if (!(planes[k].z >= planes[k - 1].z)) {
      throw SliceError(fmt::format("plane {} at z = {} mm lies below the plane before it (z = {} mm)", k,
                                   planes[k].z, planes[k - 1].z));
    }
  }
  for (const Surface& surface : model.surfaces) {
    const int degree = std::max(surface.nurbs.degree_u, surface.nurbs.degree_v);
    if (degree > kHighestPatchDegree) {
      throw SliceError(fmt::format("the surface at directory line {} has degree {}: up to {} can be sliced",
                                   surface.directory_line, degree, kHighestPatchDegree));
    }
  }
  for (const PointCloud& cloud : model.clouds) {
    const double served = served_epsilon(cloud);
    if (options.epsilon >= served) continue;
    throw SliceError(fmt::format(
        "the scan is too sparse for a tolerance of {} mm: its points are {:.3g} mm apart with {:.2g} mm of "
        "noise, which serves {:.3g} mm: slice it with that tolerance, or scan it more densely",
        options.epsilon, cloud.spacing, cloud.noise, rounded_up(served)));
  }
}

std::vector<SlicePlane> checked(const Model& model, std::vector<SlicePlane> planes,
                                const SliceOptions& options) {
  check(model, planes, options);
  return planes;
}

}  // namespace

Slicer::Slicer(const Model& model, std::vector<SlicePlane> planes, const SliceOptions& options)
    : planes_(checked(model, std::move(planes), options)),
      contained_(options.containment != Containment::kNominal),
      patches_(model),
      facets_(model),
      scans_(model),
      queue_(std::make_unique<LayerQueue>(options, SolidNumbers(model))) {}

Slicer::~Slicer() = default;
Slicer::Slicer(Slicer&&) noexcept = default;
Slicer& Slicer::operator=(Slicer&&) noexcept = default;

std::optional<Layer> Slicer::next() {
  while (queue_->has_room() && next_plane_ < planes_.size()) {
    const SlicePlane& plane = planes_[next_plane_];
    const double middle = contained_ ? 0.5 * (plane.bottom + plane.top) : plane.z;
    const double reach = contained_ ? 0.5 * plane.thickness() + kModelTolerance : kModelTolerance;
    patches_.advance(middle, reach);
    facets_.advance(middle, reach);
    scans_.advance(middle, reach);
    FrontState front = patches_.state();
    front.facets = facets_.active();
    front.scans = scans_.active();
    front.added += facets_.added();
    front.removed += facets_.removed();
    queue_->push(std::move(front), plane, next_plane_++);
  }
  return queue_->pop();
}

}  // namespace lamina::engine
