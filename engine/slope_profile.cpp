#include "engine/slope_profile.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/pointcloud/placed_patches.h"

namespace lamina::engine {
namespace {

constexpr double kLargestSpread = 0.01;
constexpr int kDeepest = 24;

struct Interval {
  double low;
  double high;

  double width() const { return high - low; }
};

Interval height_of(const ControlNet& net) {
  const Box3 box = control_box(net);
  return {box.min().z(), box.max().z()};
}

class Profiler {
 public:
  Profiler(double bottom, double top, double bin) {
    profile_.bottom = bottom;
    profile_.bin = bin;
    profile_.normal_z.assign(static_cast<std::size_t>(std::ceil(std::max(top - bottom, bin) / bin)), 0.0);
  }

  void add(const BezierPatch& patch, int depth) {
    const Interval height = height_of(patch.net);
    if (height.width() <= kModelTolerance) {
      add_level(0.5 * (height.low + height.high), level_area(patch));
      return;
    }
    const Interval normal = normals_of(patch);
    if (height.width() <= profile_.bin || normal.width() <= kLargestSpread || depth == kDeepest) {
      record(height, normal.high);
      return;
    }
    const auto [first, second] = rises_more_along_u(patch) ? halves_in_u(patch) : halves_in_v(patch);
    add(first, depth + 1);
    add(second, depth + 1);
  }

  void add(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 normal = (b - a).cross(c - a);
    const double length = normal.norm();
    if (length == 0.0) return;
    const Interval height{std::min({a.z(), b.z(), c.z()}), std::max({a.z(), b.z(), c.z()})};
    if (height.width() <= kModelTolerance) {
      add_level(height.low, 0.5 * length);
    } else {
      record(height, std::abs(normal.z()) / length);
    }
  }

  /// A point of a scan stands for the surface around it.
  void add(const Vector3& point, const Vector3& normal, double spacing) {
    record({point.z() - 0.5 * spacing, point.z() + 0.5 * spacing}, std::abs(normal.z()));
  }

  SlopeProfile finish() {
    std::sort(level_.begin(), level_.end(), [](const LevelFace& a, const LevelFace& b) { return a.z < b.z; });
    for (const LevelFace& face : level_) {
      if (profile_.level.empty() || face.z - profile_.level.back().z > 2.0 * kModelTolerance) {
        profile_.level.push_back(face);
      } else {
        profile_.level.back().area += face.area;
      }
    }
    return std::move(profile_);
  }

 private:
  /// |z component| of the unit normals at nine points.
  static Interval normals_of(const BezierPatch& patch) {
    const NurbsSurface surface = as_surface(patch);
    Interval result{1.0, 0.0};
    for (const double u : {0.0, 0.5, 1.0}) {
      for (const double v : {0.0, 0.5, 1.0}) {
        const SurfaceDerivatives at = evaluate_derivatives(surface, u, v);
        const Vector3 normal = at.du.cross(at.dv);
        const double length = normal.norm();
        if (!(length > 1e-12 * at.du.norm() * at.dv.norm()) || length == 0.0) continue;  // a pole
        const double z = std::abs(normal.z()) / length;
        result = {std::min(result.low, z), std::max(result.high, z)};
      }
    }
    if (result.low > result.high) return {0.0, 0.0};  // nowhere a normal: the patch has no area
    return result;
  }

  static NurbsSurface as_surface(const BezierPatch& patch) {
    const auto knots = [](int degree) {
      Knots result(static_cast<std::size_t>(degree) + 1, 0.0);
      result.resize(2 * result.size(), 1.0);
      return result;
    };
    return {patch.degree_u, patch.degree_v, knots(patch.degree_u), knots(patch.degree_v), patch.net};
  }

  static bool rises_more_along_u(const BezierPatch& patch) {
    const ControlNet& net = patch.net;
    const auto z = [&](std::size_t i, std::size_t j) { return net.at(i, j).z() / net.at(i, j).w(); };
    double along_u = 0.0;
    double along_v = 0.0;
    for (std::size_t i = 0; i < net.count_u; ++i) {
      for (std::size_t j = 0; j < net.count_v; ++j) {
        if (i > 0) along_u = std::max(along_u, std::abs(z(i, j) - z(i - 1, j)));
        if (j > 0) along_v = std::max(along_v, std::abs(z(i, j) - z(i, j - 1)));
      }
    }
    return along_u >= along_v;
  }

  /// Of the corners' quadrilateral: enough to tell a face from a splinter.
  static double level_area(const BezierPatch& patch) {
    const Vector3 a = evaluate(patch, 0.0, 0.0);
    const Vector3 b = evaluate(patch, 1.0, 0.0);
    const Vector3 c = evaluate(patch, 1.0, 1.0);
    const Vector3 d = evaluate(patch, 0.0, 1.0);
    return 0.5 * (c - a).cross(d - b).norm();
  }

  void add_level(double z, double area) {
    if (area > 0.0) level_.push_back({z, area});
  }

  void record(const Interval& height, double normal_z) {
    const auto last = static_cast<double>(profile_.normal_z.size() - 1);
    const auto index = [&](double z) {
      return static_cast<std::size_t>(
          std::clamp(std::floor((z - profile_.bottom) / profile_.bin), 0.0, last));
    };
    const std::size_t end = index(height.high);
    for (std::size_t k = index(height.low); k <= end; ++k) {
      profile_.normal_z[k] = std::max(profile_.normal_z[k], normal_z);
    }
  }

  SlopeProfile profile_;
  std::vector<LevelFace> level_;
};

}  // namespace

SlopeProfile measure_slopes(const Model& model, double bottom, double top, double bin) {
  Profiler profiler(bottom, top, bin);
  for (const Surface& surface : model.surfaces) {
    std::optional<TrimRegion> region;
    if (!surface.trim.empty()) region.emplace(surface, 0);
    for (const PlacedPatch& placed : placed_patches(surface, region ? &*region : nullptr))
      profiler.add(placed.patch, 0);
  }
  for (const TriangleMesh& mesh : model.meshes) {
    const auto vertex = [&](std::uint32_t v) { return Vector3(mesh.vertices[v].cast<double>()); };
    for (const auto& facet : mesh.facets) profiler.add(vertex(facet[0]), vertex(facet[1]), vertex(facet[2]));
  }
  for (const PointCloud& cloud : model.clouds) {
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      profiler.add(cloud.points[i].cast<double>(), cloud.normals[i].cast<double>(), cloud.spacings[i]);
  }
  return profiler.finish();
}

}  // namespace lamina::engine
