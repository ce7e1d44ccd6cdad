#pragma once

#include <cstddef>
#include <string>

#include "engine/layer.h"

namespace lamina::tools {

/// Contours as rows of points: x, y, z in mm, the contour's number (through the whole file, from 0), the
/// layer's, and what it is: closed, open, planar-outer, planar-inner or point.
class ContoursCsv {
 public:
  /// Points along a curve are at most `step` mm apart.
  explicit ContoursCsv(double step) : step_(step) {}

  static std::string header() { return "x,y,z,contour,layer,kind\n"; }

  /// The rows of one layer.
  std::string rows(const engine::Layer& layer);

 private:
  engine::Polyline points_of(const engine::PieceCurve& curve) const;
  void append(const engine::Polyline& points, const engine::Layer& layer, const char* kind,
              std::string& text);

  double step_;
  std::size_t next_contour_ = 0;
};

}  // namespace lamina::tools
