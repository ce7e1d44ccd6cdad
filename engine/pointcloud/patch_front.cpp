#include "engine/pointcloud/patch_front.h"

#include <algorithm>
#include <limits>

namespace lamina::engine {

PatchFront::PatchFront(const Model& model) {
  sources_.reserve(model.surfaces.size());
  std::size_t count = 0;
  for (const Surface& surface : model.surfaces) {
    const NurbsSurface& nurbs = surface.nurbs;
    sources_.push_back(
        {BezierSpans(nurbs.knots_u, nurbs.degree_u), BezierSpans(nurbs.knots_v, nurbs.degree_v), nurbs.net});
    count += sources_.back().u.count() * sources_.back().v.count();
  }
  spans_.reserve(count);
  std::vector<Vector4> points;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    for (std::size_t u = 0; u < sources_[s].u.count(); ++u) {
      for (std::size_t v = 0; v < sources_[s].v.count(); ++v) {
        Span span{0.0, 0.0, static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(u),
                  static_cast<std::uint32_t>(v)};
        cut(span, points);
        span.z_min = std::numeric_limits<double>::infinity();
        span.z_max = -span.z_min;
        for (const Vector4& point : points) {
          const double z = point.z() / point.w();
          span.z_min = std::min(span.z_min, z);
          span.z_max = std::max(span.z_max, z);
        }
        spans_.push_back(span);
      }
    }
  }
  std::stable_sort(spans_.begin(), spans_.end(),
                   [](const Span& a, const Span& b) { return a.z_min < b.z_min; });
}

void PatchFront::advance(double z, double reach) {
  state_.removed = std::erase_if(state_.patches, [&](const auto& patch) { return patch->z_max < z - reach; });
  state_.added = 0;
  for (; next_ < spans_.size() && spans_[next_].z_min <= z + reach; ++next_) {
    const Span& span = spans_[next_];
    if (span.z_max < z - reach) continue;  // between two planes: never met
    const Source& source = sources_[span.surface];
    auto patch = std::make_shared<FrontPatch>(
        FrontPatch{source.u.degree(), source.v.degree(), span.surface, span.z_min, span.z_max, {}});
    cut(span, patch->points);
    state_.patches.push_back(std::move(patch));
    ++state_.added;
  }
}

void PatchFront::cut(const Span& span, std::vector<Vector4>& points) {
  const Source& source = sources_[span.surface];
  const auto order_u = static_cast<std::size_t>(source.u.degree()) + 1;
  const auto order_v = static_cast<std::size_t>(source.v.degree()) + 1;
  const double* weights_u = source.u.weights(span.u);
  const double* weights_v = source.v.weights(span.v);
  const Vector4* net = &source.net.at(source.u.first(span.u), source.v.first(span.v));
  const std::size_t stride = source.net.count_v;
  half_cut_.resize(order_u * order_v);
  points.resize(order_u * order_v);
  for (std::size_t i = 0; i < order_u; ++i) {
    for (std::size_t l = 0; l < order_v; ++l) {
      Vector4 sum = weights_v[l * order_v] * net[i * stride];
      for (std::size_t j = 1; j < order_v; ++j) sum += weights_v[l * order_v + j] * net[i * stride + j];
      half_cut_[i * order_v + l] = sum;
    }
  }
  for (std::size_t k = 0; k < order_u; ++k) {
    for (std::size_t l = 0; l < order_v; ++l) {
      Vector4 sum = weights_u[k * order_u] * half_cut_[l];
      for (std::size_t i = 1; i < order_u; ++i)
        sum += weights_u[k * order_u + i] * half_cut_[i * order_v + l];
      points[k * order_v + l] = sum;
    }
  }
}

}  // namespace lamina::engine
