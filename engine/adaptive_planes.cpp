#include "engine/adaptive_planes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "engine/model.h"
#include "engine/slicing_planes.h"

namespace lamina::engine {
namespace {

constexpr double kSlack = 1e-9;
constexpr int kMostRounds = 60;
constexpr double kMostLayers = 1e7;

void check(const AdaptiveOptions& options, double height) {
  if (!(options.least_thickness > 0.0))
    throw std::invalid_argument("the least layer thickness must be positive");
  if (!(options.greatest_thickness >= options.least_thickness))
    throw std::invalid_argument("the greatest layer thickness must not be below the least");
  if (!(options.cusp_height > 0.0)) throw std::invalid_argument("the cusp height must be positive");
  if (!(options.greatest_ratio > 1.0))
    throw std::invalid_argument("the ratio of neighbouring layers must be above 1");
  if (!(height / options.least_thickness <= kMostLayers))
    throw std::invalid_argument("more than ten million layers: is the unit right?");
}

/// The thickest layer that may begin in each bin.
class ThicknessLimit {
 public:
  ThicknessLimit(const SlopeProfile& profile, const AdaptiveOptions& options)
      : bottom_(profile.bottom), bin_(profile.bin), options_(options) {
    limit_.reserve(profile.normal_z.size());
    for (const double normal_z : profile.normal_z) {
      limit_.push_back(std::clamp(options.cusp_height / std::max(normal_z, 1e-9), options.least_thickness,
                                  options.greatest_thickness));
    }
  }

  /// Thickest layer from z upwards whose limit holds in every bin below `end` that it reaches; it may go
  /// beyond `end`.
  double thickest(double z, double end) const {
    double allowed = options_.greatest_thickness;
    for (std::size_t k = bin_of(z); k < limit_.size(); ++k) {
      const double begins = bottom_ + static_cast<double>(k) * bin_;
      if (begins >= std::min(z + allowed, end) - kSlack) break;
      // A bin that asks for less than the way to it is left to the next layer, where that is thick enough.
      if (limit_[k] < begins - z) return std::max(begins - z, options_.least_thickness);
      allowed = std::min(allowed, limit_[k]);
    }
    return allowed;
  }

  /// Lays a thickness down as a limit of its own place.
  void restrict(double from, double to, double thickness) {
    for (std::size_t k = bin_of(from); k < limit_.size() && bottom_ + static_cast<double>(k) * bin_ < to; ++k)
      limit_[k] = std::max(options_.least_thickness, std::min(limit_[k], thickness));
  }

  /// Makes the limit change so slowly with height that neighbours keep their ratio.
  void smooth() {
    const double rise = (options_.greatest_ratio - 1.0) * bin_;
    const double fall = (1.0 - 1.0 / options_.greatest_ratio) * bin_;
    for (std::size_t k = 1; k < limit_.size(); ++k) limit_[k] = std::min(limit_[k], limit_[k - 1] + rise);
    for (std::size_t k = limit_.size() - 1; k-- > 0;) limit_[k] = std::min(limit_[k], limit_[k + 1] + fall);
  }

 private:
  std::size_t bin_of(double z) const {
    const double k = std::floor((z - bottom_) / bin_ + kSlack);
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(limit_.size() - 1)));
  }

  double bottom_;
  double bin_;
  AdaptiveOptions options_;
  std::vector<double> limit_;
};

/// Layers that fill a height: thinned towards the least thickness alike, or, where that is not enough, one
/// layer less and the others thickened towards the greatest. Either brings neighbours nearer to each other.
void fit_height(std::vector<double>& layers, double height, const AdaptiveOptions& options) {
  const double sum = std::accumulate(layers.begin(), layers.end(), 0.0);
  const double spare = sum - options.least_thickness * static_cast<double>(layers.size());
  if (layers.size() == 1 || spare >= sum - height) {
    const double share = layers.size() == 1 ? 0.0 : (sum - height) / std::max(spare, kSlack);
    for (double& layer : layers) layer -= (layer - options.least_thickness) * share;
    if (layers.size() == 1) layers.front() = height;
    return;
  }
  const double missing = height - (sum - layers.back());
  layers.pop_back();
  double headroom = 0.0;
  for (const double layer : layers) headroom += options.greatest_thickness - layer;
  if (headroom >= missing) {
    for (double& layer : layers) layer += (options.greatest_thickness - layer) * missing / headroom;
  } else {  // no count of layers fits between the bounds: a little too thin is safer than too thick
    layers.assign(layers.size() + 1, height / static_cast<double>(layers.size() + 1));
  }
}

/// Boundaries of one stretch between two heights that must be boundaries: as few layers as the limit allows,
/// made to fill the stretch.
std::vector<double> fill(double from, double to, const ThicknessLimit& limit,
                         const AdaptiveOptions& options) {
  std::vector<double> layers;
  for (double z = from; to - z > kModelTolerance; z += layers.back()) layers.push_back(limit.thickest(z, to));
  fit_height(layers, to - from, options);
  std::vector<double> boundaries{from};
  for (const double layer : layers) boundaries.push_back(boundaries.back() + layer);
  boundaries.back() = to;
  return boundaries;
}

/// Heights that must be boundaries, rising: the bottom, the first layer's top, level faces, the top.
std::vector<double> fixed_heights(const SlopeProfile& profile, double top, double first, double least,
                                  std::size_t& missed) {
  std::vector<double> fixed{profile.bottom, top};
  if (first > 0.0 && profile.bottom + first < top) fixed.push_back(profile.bottom + first);
  std::vector<LevelFace> faces = profile.level;
  std::stable_sort(faces.begin(), faces.end(),
                   [](const LevelFace& a, const LevelFace& b) { return a.area > b.area; });
  for (const LevelFace& face : faces) {
    const bool inside = face.z > profile.bottom + kModelTolerance && face.z < top - kModelTolerance;
    if (!inside) continue;
    const bool near = std::any_of(fixed.begin(), fixed.end(),
                                  [&](double z) { return std::abs(z - face.z) < least - kSlack; });
    if (!near) {
      fixed.push_back(face.z);
    } else if (std::none_of(fixed.begin(), fixed.end(),
                            [&](double z) { return std::abs(z - face.z) <= 2.0 * kModelTolerance; })) {
      ++missed;
    }
  }
  std::sort(fixed.begin(), fixed.end());
  return fixed;
}

}  // namespace

AdaptivePlanes make_adaptive_planes(const SlopeProfile& profile, double top,
                                    const SlicingPlanesOptions& options) {
  const AdaptiveOptions& adaptive = options.adaptive;
  check(adaptive, top - profile.bottom);
  AdaptivePlanes result;
  const std::vector<double> fixed = fixed_heights(profile, top, options.first_layer_thickness,
                                                  adaptive.least_thickness, result.missed_faces);
  ThicknessLimit limit(profile, adaptive);
  const bool has_first = options.first_layer_thickness > 0.0;
  std::vector<double> boundaries;
  for (int round = 0; round < kMostRounds; ++round) {
    limit.smooth();
    boundaries.assign(1, fixed.front());
    for (std::size_t k = 1; k < fixed.size(); ++k) {
      // The first layer is as thick as it was asked for.
      const std::vector<double> stretch = has_first && k == 1 ? std::vector<double>{fixed[0], fixed[1]}
                                                              : fill(fixed[k - 1], fixed[k], limit, adaptive);
      boundaries.insert(boundaries.end(), stretch.begin() + 1, stretch.end());
    }
    // Where shrinking upset the ratio, the thinner of the two becomes the limit of its place, and its
    // neighbours'.
    result.uneven_pairs = 0;
    for (std::size_t k = has_first ? 2 : 1; k + 1 < boundaries.size(); ++k) {
      const double below = boundaries[k] - boundaries[k - 1];
      const double above = boundaries[k + 1] - boundaries[k];
      if (std::max(below, above) <= adaptive.greatest_ratio * std::min(below, above) + kSlack) continue;
      ++result.uneven_pairs;
      if (below < above) {
        limit.restrict(boundaries[k - 1], boundaries[k], below);
        limit.restrict(boundaries[k], boundaries[k + 1], adaptive.greatest_ratio * below);
      } else {
        limit.restrict(boundaries[k], boundaries[k + 1], above);
        limit.restrict(boundaries[k - 1], boundaries[k], adaptive.greatest_ratio * above);
      }
    }
    if (result.uneven_pairs == 0) break;
  }
  for (std::size_t k = 1; k < boundaries.size(); ++k) {
    const double bottom = boundaries[k - 1];
    const double above = boundaries[k];
    result.thin_layers += above - bottom < adaptive.least_thickness - kSlack ? 1 : 0;
    result.planes.push_back({plane_height(bottom, above, options.position), bottom, above});
  }
  return result;
}

}  // namespace lamina::engine
