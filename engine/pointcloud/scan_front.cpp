#include "engine/pointcloud/scan_front.h"

#include <algorithm>
#include <numeric>

#include "engine/scan/scan_field.h"

namespace lamina::engine {
namespace {

/// Spacings from the plane within which points are near it.
constexpr double kNear = 2.0;

}  // namespace

ScanFront::ScanFront(const Model& model) {
  for (const PointCloud& cloud : model.clouds) {
    Scan scan{std::make_shared<const ScanField>(cloud), {}, 0, 0};
    scan.by_z.resize(cloud.points.size());
    std::iota(scan.by_z.begin(), scan.by_z.end(), 0U);
    std::stable_sort(scan.by_z.begin(), scan.by_z.end(), [&](std::uint32_t a, std::uint32_t b) {
      return cloud.points[a].z() < cloud.points[b].z();
    });
    scans_.push_back(std::move(scan));
  }
}

void ScanFront::advance(double z, double reach) {
  for (Scan& scan : scans_) {
    const PointCloud& cloud = scan.field->cloud();
    const double near = reach + kNear * cloud.spacing;
    const auto height = [&](std::size_t k) { return static_cast<double>(cloud.points[scan.by_z[k]].z()); };
    while (scan.last < scan.by_z.size() && height(scan.last) <= z + near) ++scan.last;
    while (scan.first < scan.last && height(scan.first) < z - near) ++scan.first;
  }
}

std::vector<FrontScan> ScanFront::active() const {
  std::vector<FrontScan> result;
  for (const Scan& scan : scans_) {
    const auto begin = scan.by_z.begin();
    result.push_back(
        {scan.field,
         {begin + static_cast<std::ptrdiff_t>(scan.first), begin + static_cast<std::ptrdiff_t>(scan.last)}});
  }
  return result;
}

}  // namespace lamina::engine
