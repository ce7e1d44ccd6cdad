#include "engine/contour/fit/fit_pieces.h"

#include <algorithm>
#include <utility>

#include "engine/contour/fit/runs.h"
#include "engine/contour/fit/smooth_chain.h"
#include "engine/contour/fit/spline_fit.h"

namespace lamina::engine {

PieceFit fit_pieces(const NodeChain& chain, const PieceFitOptions& options) {
  const SplineFitOptions spline_options{options.tolerance, options.least_degree, options.greatest_degree};
  PieceFit result;
  result.curve.closed = chain.closed;
  std::vector<CurvePiece>& pieces = result.curve.pieces;
  std::optional<SplineHint> hint;
  for (SmoothChain& smooth : smooth_chains(chain, options.corner_angle)) {
    const RunCover cover = recognise_runs(std::move(smooth), options.recognition_tolerance);
    for (const Run& run : cover.runs) {
      if (run.shape == RunShape::kFree) {
        SplineFit fit = fit_splines(sub_chain(cover.chain, run.first, run.last), spline_options, hint);
        hint = fit.hint;
        result.greatest_distance = std::max(result.greatest_distance, fit.greatest_distance);
        std::move(fit.curves.begin(), fit.curves.end(), std::back_inserter(pieces));
      } else {
        const std::vector<CurvePiece> exact = exact_pieces(cover.chain, run);
        pieces.insert(pieces.end(), exact.begin(), exact.end());
      }
    }
  }
  return result;
}

std::size_t control_count(const PieceCurve& curve) {
  std::size_t count = 0;
  for (const CurvePiece& piece : curve.pieces) {
    if (const auto* spline = std::get_if<PlanarCurve>(&piece)) {
      count += spline->control_points.size();
    } else {
      count += std::holds_alternative<LineSegment>(piece) ? 2 : 3;
    }
  }
  return count;
}

}  // namespace lamina::engine
