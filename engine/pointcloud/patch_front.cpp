#include "engine/pointcloud/patch_front.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/geometry/bspline_basis.h"
#include "engine/pointcloud/trim_region.h"

namespace lamina::engine {

PatchFront::PatchFront(const Model& model) {
  sources_.reserve(model.surfaces.size());
  std::size_t count = 0;
  for (const Surface& surface : model.surfaces) {
    const NurbsSurface& nurbs = surface.nurbs;
    Source source{BezierSpans(nurbs.knots_u, nurbs.degree_u),
                  BezierSpans(nurbs.knots_v, nurbs.degree_v),
                  nurbs.net,
                  {},
                  {},
                  nullptr};
    if (!surface.trim.empty()) {
      source.trim = std::make_shared<TrimRegion>(surface, static_cast<std::uint32_t>(sources_.size()));
      source.breaks_u = break_points(nurbs.knots_u, nurbs.degree_u);
      source.breaks_v = break_points(nurbs.knots_v, nurbs.degree_v);
      regions_.push_back(source.trim);
    }
    count += source.u.count() * source.v.count();
    sources_.push_back(std::move(source));
  }
  spans_.reserve(count);
  for (std::uint32_t s = 0; s < sources_.size(); ++s) add_spans(s);
  std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) {
    return std::tie(a.z_min, a.surface, a.u, a.v) < std::tie(b.z_min, b.surface, b.u, b.v);
  });
}

void PatchFront::add_spans(std::uint32_t surface) {
  const Source& source = sources_[surface];
  if (source.trim != nullptr && source.trim->level()) return;  // its loops are its face
  const auto order_u = static_cast<std::size_t>(source.u.degree()) + 1;
  const auto order_v = static_cast<std::size_t>(source.v.degree()) + 1;
  // Only heights and weights are asked for here, and a row cut along v serves every span along u.
  std::vector<Vector2> rows(source.net.count_u * order_v);
  for (std::uint32_t v = 0; v < source.v.count(); ++v) {
    const double* weights_v = source.v.weights(v);
    for (std::size_t i = 0; i < source.net.count_u; ++i) {
      const Vector4* net = &source.net.at(i, source.v.first(v));
      for (std::size_t l = 0; l < order_v; ++l) {
        Vector2 sum = weights_v[l * order_v] * net[0].tail<2>();
        for (std::size_t j = 1; j < order_v; ++j) sum += weights_v[l * order_v + j] * net[j].tail<2>();
        rows[i * order_v + l] = sum;
      }
    }
    for (std::uint32_t u = 0; u < source.u.count(); ++u) {
      Span span{std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity(),
                surface,
                u,
                v,
                false};
      if (source.trim != nullptr) {
        const TrimPlace place = source.trim->place_of({source.breaks_u[u], source.breaks_v[v]},
                                                      {source.breaks_u[u + 1], source.breaks_v[v + 1]});
        if (place == TrimPlace::kOutside) continue;
        span.trimmed = place == TrimPlace::kCut;
      }
      const double* weights_u = source.u.weights(u);
      const Vector2* row = &rows[source.u.first(u) * order_v];
      for (std::size_t k = 0; k < order_u; ++k) {
        for (std::size_t l = 0; l < order_v; ++l) {
          Vector2 sum = weights_u[k * order_u] * row[l];
          for (std::size_t i = 1; i < order_u; ++i) sum += weights_u[k * order_u + i] * row[i * order_v + l];
          const double z = sum.x() / sum.y();
          span.z_min = std::min(span.z_min, z);
          span.z_max = std::max(span.z_max, z);
        }
      }
      spans_.push_back(span);
    }
  }
}

void PatchFront::advance(double z, double reach) {
  state_.removed = std::erase_if(state_.patches, [&](const auto& patch) { return patch->z_max < z - reach; });
  state_.added = 0;
  for (; next_ < spans_.size() && spans_[next_].z_min <= z + reach; ++next_) {
    const Span& span = spans_[next_];
    if (span.z_max < z - reach) continue;  // between two planes: never met
    const Source& source = sources_[span.surface];
    auto patch = std::make_shared<FrontPatch>();
    patch->degree_u = source.u.degree();
    patch->degree_v = source.v.degree();
    patch->surface = span.surface;
    patch->z_min = span.z_min;
    patch->z_max = span.z_max;
    if (span.trimmed) {
      patch->low = {source.breaks_u[span.u], source.breaks_v[span.v]};
      patch->high = {source.breaks_u[span.u + 1], source.breaks_v[span.v + 1]};
      patch->trim = source.trim;
    }
    cut(span, patch->points);
    state_.patches.push_back(std::move(patch));
    ++state_.added;
  }
  state_.regions.clear();
  for (const auto& region : regions_) {
    if (region->z_min() <= z + reach && region->z_max() >= z - reach) state_.regions.push_back(region);
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
