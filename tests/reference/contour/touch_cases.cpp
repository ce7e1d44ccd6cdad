#include "tests/reference/contour/touch_cases.h"

#include "tests/reference/grid/boundary.h"
#include "tests/reference/grid/planar.h"
#include "tests/reference/grid/polyomino.h"
#include "tests/reference/grid/thin.h"
#include "tests/reference/grid/trace.h"

namespace lamina::reference {
namespace {

Polyline locations(const LayerGrid& grid, const CellChain& chain) {
  Polyline points;
  points.reserve(chain.cells.size() + 1);
  for (const Cell cell : chain.cells) points.push_back(grid.location(cell));
  if (chain.closed) points.push_back(points.front());
  return points;
}

PlanarCurve fit_chain(const LayerGrid& grid, const CellChain& chain, const FitOptions& options,
                      ComponentContours& contours) {
  FitResult fit = fit_curve(locations(grid, chain), options);
  if (!fit.within_tolerance) ++contours.unfitted_curves;
  return std::move(fit.curve);
}

void add_chain(const LayerGrid& grid, const CellChain& chain, bool touch, const FitOptions& options,
               ComponentContours& contours) {
  if (chain.cells.size() == 1) {
    contours.points.push_back({grid.location(chain.cells.front())});
  } else if (chain.closed) {
    contours.closed.push_back({fit_chain(grid, chain, options, contours), touch});
  } else {
    contours.open.push_back({fit_chain(grid, chain, options, contours), touch});
  }
}

/// Fitted curves around the holes of a face.
std::vector<PlanarCurve> hole_curves(LayerGrid& grid, const FitOptions& options,
                                     ComponentContours& contours) {
  eliminate_polyominoes(grid, CellState::kInteriorBoundary);
  const TraceResult traced = trace(grid, CellState::kInteriorBoundary);
  contours.dropped_spurs += traced.dropped_spurs;
  std::vector<PlanarCurve> curves;
  for (const CellChain& chain : traced.chains) {
    contours.boundary_cells += chain.cells.size();
    if (chain.closed) {
      curves.push_back(fit_chain(grid, chain, options, contours));
    } else {
      contours.dropped_spurs += chain.cells.size();
    }
  }
  return curves;
}

}  // namespace

ComponentContours make_contours(LayerGrid grid, bool touch, const FitOptions& options) {
  ComponentContours contours;
  identify_boundary(grid);
  const PlanarCase planar = identify_planar(grid);
  eliminate_polyominoes(grid, CellState::kBoundary);
  if (planar == PlanarCase::kNothingInside) thin_lines(grid);
  const TraceResult traced = trace(grid, CellState::kBoundary);
  contours.dropped_spurs = traced.dropped_spurs;

  bool face_found = planar != PlanarCase::kWithoutHoles && planar != PlanarCase::kWithHoles;
  for (const CellChain& chain : traced.chains) {
    contours.boundary_cells += chain.cells.size();
    if (!face_found && chain.closed) {
      // The boundary of a connected face is one chain; what may hang on it beside is a curve.
      face_found = true;
      contours.planar.push_back({fit_chain(grid, chain, options, contours), {}});
    } else {
      add_chain(grid, chain, touch, options, contours);
    }
  }
  if (planar == PlanarCase::kWithHoles && !contours.planar.empty()) {
    contours.planar.front().inner = hole_curves(grid, options, contours);
  }
  return contours;
}

}  // namespace lamina::reference
