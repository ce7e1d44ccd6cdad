#include "engine/contour/layer_curves.h"

#include <algorithm>
#include <utility>

#include "engine/contour/fit/fit_pieces.h"

namespace lamina::engine {

Layer make_curves(const LayerChains& chains, const SliceOptions& options) {
  PieceFitOptions fit_options;
  fit_options.tolerance = options.fit_part * options.epsilon;
  fit_options.greatest_degree = options.greatest_degree;
  Layer layer;
  const auto curve = [&](const NodeChain& chain) {
    PieceFit fit = fit_pieces(chain, fit_options);
    layer.report.control_points += control_count(fit.curve);
    layer.report.greatest_fit_distance = std::max(layer.report.greatest_fit_distance, fit.greatest_distance);
    return std::move(fit.curve);
  };
  for (const NodeChain& chain : chains.closed) layer.closed.push_back({curve(chain), false});
  for (const NodeChain& chain : chains.open) layer.open.push_back({curve(chain), false});
  for (const NodeChain& chain : chains.touch_curves) {
    if (chain.closed) {
      layer.closed.push_back({curve(chain), true});
    } else {
      layer.open.push_back({curve(chain), true});
    }
  }
  for (const LayerChains::Face& face : chains.faces) {
    PlanarContour planar{curve(face.outer), {}};
    for (const NodeChain& hole : face.inner) planar.inner.push_back(curve(hole));
    layer.planar.push_back(std::move(planar));
  }
  for (const Vector2& point : chains.touch_points) layer.points.push_back({point});
  return layer;
}

}  // namespace lamina::engine
