#include "engine/pointcloud/patch_source.h"

#include <algorithm>

#include "engine/geometry/bspline_basis.h"
#include "engine/pointcloud/trim_region.h"

namespace lamina::engine {

PatchSource::PatchSource(const Surface& surface, std::uint32_t index)
    : spans_u_(surface.nurbs.knots_u, surface.nurbs.degree_u),
      spans_v_(surface.nurbs.knots_v, surface.nurbs.degree_v),
      net_(surface.nurbs.net),
      index_(index) {
  if (surface.trim.empty()) return;
  trim_ = std::make_shared<TrimRegion>(surface, index);
  breaks_u_ = break_points(surface.nurbs.knots_u, surface.nurbs.degree_u);
  breaks_v_ = break_points(surface.nurbs.knots_v, surface.nurbs.degree_v);
}

std::vector<PatchSource::Span> PatchSource::spans() const {
  std::vector<Span> spans;
  if (trim_ != nullptr && trim_->level()) return spans;  // its loops are its face
  spans.reserve(count());
  const auto order_u = static_cast<std::size_t>(degree_u()) + 1;
  const auto order_v = static_cast<std::size_t>(degree_v()) + 1;
  // Only heights and weights are asked for here, and a row cut along v serves every span along u.
  std::vector<Vector2> rows(net_.count_u * order_v);
  for (std::uint32_t v = 0; v < spans_v_.count(); ++v) {
    const double* weights_v = spans_v_.weights(v);
    for (std::size_t i = 0; i < net_.count_u; ++i) {
      const Vector4* net = &net_.at(i, spans_v_.first(v));
      for (std::size_t l = 0; l < order_v; ++l) {
        Vector2 sum = weights_v[l * order_v] * net[0].tail<2>();
        for (std::size_t j = 1; j < order_v; ++j) sum += weights_v[l * order_v + j] * net[j].tail<2>();
        rows[i * order_v + l] = sum;
      }
    }
    for (std::uint32_t u = 0; u < spans_u_.count(); ++u) {
      Span span;
      span.surface = index_;
      span.u = u;
      span.v = v;
      if (trim_ != nullptr) {
        const TrimPlace place = trim_->chords().place_of(low(span), high(span));
        if (place == TrimPlace::kOutside) continue;
        span.trimmed = place == TrimPlace::kCut;
      }
      const double* weights_u = spans_u_.weights(u);
      const Vector2* row = &rows[spans_u_.first(u) * order_v];
      for (std::size_t k = 0; k < order_u; ++k) {
        for (std::size_t l = 0; l < order_v; ++l) {
          Vector2 sum = weights_u[k * order_u] * row[l];
          for (std::size_t i = 1; i < order_u; ++i) sum += weights_u[k * order_u + i] * row[i * order_v + l];
          const double z = sum.x() / sum.y();
          span.z_min = std::min(span.z_min, z);
          span.z_max = std::max(span.z_max, z);
        }
      }
      spans.push_back(span);
    }
  }
  return spans;
}

std::vector<Vector4> PatchSource::net_of(const Span& span) const {
  const auto order_u = static_cast<std::size_t>(degree_u()) + 1;
  const auto order_v = static_cast<std::size_t>(degree_v()) + 1;
  const double* weights_u = spans_u_.weights(span.u);
  const double* weights_v = spans_v_.weights(span.v);
  const Vector4* net = &net_.at(spans_u_.first(span.u), spans_v_.first(span.v));
  const std::size_t stride = net_.count_v;
  std::vector<Vector4> half_cut(order_u * order_v);
  std::vector<Vector4> points(order_u * order_v);
  for (std::size_t i = 0; i < order_u; ++i) {
    for (std::size_t l = 0; l < order_v; ++l) {
      Vector4 sum = weights_v[l * order_v] * net[i * stride];
      for (std::size_t j = 1; j < order_v; ++j) sum += weights_v[l * order_v + j] * net[i * stride + j];
      half_cut[i * order_v + l] = sum;
    }
  }
  for (std::size_t k = 0; k < order_u; ++k) {
    for (std::size_t l = 0; l < order_v; ++l) {
      Vector4 sum = weights_u[k * order_u] * half_cut[l];
      for (std::size_t i = 1; i < order_u; ++i) sum += weights_u[k * order_u + i] * half_cut[i * order_v + l];
      points[k * order_v + l] = sum;
    }
  }
  return points;
}

}  // namespace lamina::engine
