#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/model.h"
#include "engine/sparse/bezier_spans.h"

namespace lamina::engine {

/// The control net of a Bezier patch that the current plane may meet; homogeneous points, v fastest.
struct FrontPatch {
  int degree_u = 1;
  int degree_v = 1;
  std::uint32_t surface = 0;  ///< of the model
  double z_min = 0.0;         ///< of the net, mm
  double z_max = 0.0;
  std::vector<Vector4> points;
};

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

  /// In the order in which the plane reached them.
  const std::vector<FrontPatch>& active() const { return active_; }
  std::size_t patch_count() const { return spans_.size(); }
  std::size_t added() const { return added_; }      ///< by the last advance
  std::size_t removed() const { return removed_; }  ///< by the last advance

 private:
  struct Source {
    BezierSpans u;
    BezierSpans v;
    ControlNet net;
  };
  struct Span {
    double z_min;
    double z_max;
    std::uint32_t surface;
    std::uint32_t u;
    std::uint32_t v;
  };

  void cut(const Span& span, std::vector<Vector4>& points);

  std::vector<Source> sources_;
  std::vector<Span> spans_;
  std::vector<FrontPatch> active_;
  std::vector<std::vector<Vector4>> spare_;  ///< nets to be used again
  std::vector<Vector4> half_cut_;
  std::size_t next_ = 0;
  std::size_t added_ = 0;
  std::size_t removed_ = 0;
};

}  // namespace lamina::engine
