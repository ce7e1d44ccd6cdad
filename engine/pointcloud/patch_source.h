#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "engine/model.h"
#include "engine/pointcloud/bezier_spans.h"

namespace lamina::engine {

class TrimRegion;

/// A surface ready to be cut into its Bezier patches, one to each pair of knot spans.
class PatchSource {
 public:
  /// One patch: its knot spans, and the z interval of its control net, mm.
  struct Span {
    double z_min = std::numeric_limits<double>::infinity();
    double z_max = -std::numeric_limits<double>::infinity();
    std::uint32_t surface = 0;  ///< of the model
    std::uint32_t u = 0;
    std::uint32_t v = 0;
    bool trimmed = false;  ///< trim curves cut it
  };

  PatchSource(const Surface& surface, std::uint32_t index);

  int degree_u() const { return spans_u_.degree(); }
  int degree_v() const { return spans_v_.degree(); }
  std::size_t count() const { return spans_u_.count() * spans_v_.count(); }

  /// All patches but those that the trim curves leave out.
  std::vector<Span> spans() const;

  /// Control net of a patch; homogeneous points, v fastest.
  std::vector<Vector4> net_of(const Span& span) const;

  /// Null: the whole surface counts.
  const std::shared_ptr<const TrimRegion>& trim() const { return trim_; }

  /// Corners of a patch of a trimmed surface in its parameter plane.
  Vector2 low(const Span& span) const { return {breaks_u_[span.u], breaks_v_[span.v]}; }
  Vector2 high(const Span& span) const { return {breaks_u_[span.u + 1], breaks_v_[span.v + 1]}; }

 private:
  BezierSpans spans_u_;
  BezierSpans spans_v_;
  ControlNet net_;
  std::uint32_t index_;
  std::vector<double> breaks_u_;
  std::vector<double> breaks_v_;
  std::shared_ptr<const TrimRegion> trim_;
};

}  // namespace lamina::engine
