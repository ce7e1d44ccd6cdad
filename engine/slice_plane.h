#pragma once

namespace lamina::engine {

/// Where a layer lies, mm in model space: material from `bottom` to `top`, sliced at height z.
/// bottom <= z <= top.
struct SlicePlane {
  double z = 0.0;
  double bottom = 0.0;
  double top = 0.0;

  double thickness() const { return top - bottom; }
};

}  // namespace lamina::engine
