#include "tools/cli/arrangement.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "tools/cli/failure.h"

namespace lamina::tools {

using engine::Vector2;

std::vector<Vector2> arrange(const std::vector<Vector2>& sizes, double spacing, const Vector2& bed) {
  std::vector<std::size_t> by_depth(sizes.size());
  std::iota(by_depth.begin(), by_depth.end(), 0U);
  std::stable_sort(by_depth.begin(), by_depth.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a].y() > sizes[b].y(); });
  std::vector<Vector2> corners(sizes.size(), Vector2::Zero());
  Vector2 next = Vector2::Zero();  // where the next part of the row goes
  double row_depth = 0.0;
  Vector2 used = Vector2::Zero();
  for (const std::size_t part : by_depth) {
    if (next.x() > 0.0 && next.x() + sizes[part].x() > bed.x()) {
      next = {0.0, next.y() + row_depth + spacing};
      row_depth = 0.0;
    }
    corners[part] = next;
    used = used.cwiseMax(next + sizes[part]);
    next.x() += sizes[part].x() + spacing;
    row_depth = std::max(row_depth, sizes[part].y());
  }
  if (used.x() > bed.x() || used.y() > bed.y()) {
    throw Failure(
        ExitCode::kFit,
        fmt::format("{} parts, {} mm apart, need {:.1f} x {:.1f} mm: the bed has {:.1f} x {:.1f} mm",
                    sizes.size(), spacing, used.x(), used.y(), bed.x(), bed.y()),
        "print fewer at a time, or bring them closer with --spacing");
  }
  for (Vector2& corner : corners) corner += 0.5 * (bed - used);
  return corners;
}

}  // namespace lamina::tools
