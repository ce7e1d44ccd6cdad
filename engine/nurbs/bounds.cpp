#include "engine/nurbs/bounds.h"

#include "engine/nurbs/curve.h"

namespace lamina::engine {
namespace {

void extend_by_corners(Box3& box, const ControlNet& net) {
  for (const std::size_t i : {std::size_t{0}, net.count_u - 1}) {
    for (const std::size_t j : {std::size_t{0}, net.count_v - 1}) box.extend(cartesian(net.at(i, j)));
  }
}

}  // namespace

Box3 surface_bounds(const std::vector<BezierPatch>& patches, double tolerance, Box3 known) {
  for (const BezierPatch& patch : patches) extend_by_corners(known, patch.net);
  const Vector3 margin = Vector3::Constant(tolerance);
  std::vector<BezierPatch> open;
  for (const BezierPatch& patch : patches) {
    open.push_back(patch);
    while (!open.empty()) {
      const BezierPatch current = std::move(open.back());
      open.pop_back();
      const Box3 reached(known.min() - margin, known.max() + margin);
      if (reached.contains(control_box(current.net))) continue;
      const auto [low, high] = halves_in_u(current);
      for (const BezierPatch& half : {low, high}) {
        const auto [first, second] = halves_in_v(half);
        extend_by_corners(known, first.net);
        extend_by_corners(known, second.net);
        open.push_back(first);
        open.push_back(second);
      }
    }
  }
  return known;
}

}  // namespace lamina::engine
