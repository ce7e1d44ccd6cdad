#include "tests/reference/grid/layer_grid.h"

#include <cmath>

namespace lamina::reference {

LayerGrid::LayerGrid(const Vector2& origin, double epsilon, std::ptrdiff_t columns, std::ptrdiff_t rows)
    : origin_(origin),
      epsilon_(epsilon),
      columns_(columns),
      rows_(rows),
      cells_(static_cast<std::size_t>(columns * rows), std::uint8_t{0}) {}

LayerGrid LayerGrid::covering(const Box2& box, double epsilon) {
  const Vector2 origin = box.min() - Vector2::Constant(kModelTolerance);
  const Vector2 size = (box.max() - origin) + Vector2::Constant(kModelTolerance);
  return {origin, epsilon, static_cast<std::ptrdiff_t>(std::ceil(size.x() / epsilon)),
          static_cast<std::ptrdiff_t>(std::ceil(size.y() / epsilon))};
}

Cell LayerGrid::cell_at(const Vector2& point) const {
  const Vector2 scaled = (point - origin_) / epsilon_;
  return {static_cast<std::ptrdiff_t>(std::floor(scaled.x())),
          static_cast<std::ptrdiff_t>(std::floor(scaled.y()))};
}

}  // namespace lamina::reference
