#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/model.h"
#include "engine/pointcloud/bezier_spans.h"
#include "engine/pointcloud/front_state.h"

namespace lamina::engine {

/// The model's Bezier patches, one to each pair of knot spans, by ascending z minimum (the global list), and
/// those that a rising plane may meet (the active list; dissertation p. 124 to 128). A net is cut out of its
/// surface when the plane reaches it and freed when the plane has passed, so memory follows the section, not
/// the model.
class PatchFront {
 public:
  explicit PatchFront(const Model& model);

  /// Moves the plane up to z: patches whose z interval lies within `reach` of it become active. z must not
  /// decrease.
  void advance(double z, double reach);

  /// The active list; no facets.
  const FrontState& state() const { return state_; }
  std::size_t patch_count() const { return spans_.size(); }

 private:
  struct Source {
    BezierSpans u;
    BezierSpans v;
    ControlNet net;
    std::vector<double> breaks_u;
    std::vector<double> breaks_v;
    std::shared_ptr<const TrimRegion> trim;  ///< null: the whole surface
  };
  struct Span {
    double z_min;
    double z_max;
    std::uint32_t surface;
    std::uint32_t u;
    std::uint32_t v;
    bool trimmed;  ///< trim curves cut it
  };

  void add_spans(std::uint32_t surface);
  void cut(const Span& span, std::vector<Vector4>& points);

  std::vector<Source> sources_;
  std::vector<std::shared_ptr<const TrimRegion>> regions_;
  std::vector<Span> spans_;
  FrontState state_;
  std::vector<Vector4> half_cut_;
  std::size_t next_ = 0;
};

}  // namespace lamina::engine
