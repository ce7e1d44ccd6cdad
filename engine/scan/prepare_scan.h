#pragma once

#include <cstddef>
#include <vector>

#include "engine/model.h"

namespace lamina::engine {

/// Points as a scanner gives them, mm.
struct ScannedPoints {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;  ///< one for each point, of any length, or none at all
};

/// A scan made ready, and what was done to it.
struct PreparedScan {
  PointCloud cloud;
  std::size_t repeated = 0;        ///< points given more than once
  std::size_t outliers = 0;        ///< points far from the surface of their neighbours
  bool estimated_normals = false;  ///< none were given, or they contradict each other
};

/// Fewer points are no surface.
inline constexpr std::size_t kFewestScanPoints = 32;

/// Measures spacing and noise, takes repeated points and outliers out, and gives each point a normal: the
/// given one, or that of the plane through its neighbours, turned outwards. With fewer than
/// `kFewestScanPoints` points left the cloud is empty.
PreparedScan prepare_scan(ScannedPoints scanned);

/// The smallest epsilon for which a scan is dense enough, mm: half its spacing and twice its noise. Between
/// points farther apart than two epsilon a feature of that size could hide.
double served_epsilon(const PointCloud& cloud);

}  // namespace lamina::engine
