#include "engine/pointcloud/bezier_spans.h"

#include "engine/geometry/bspline_basis.h"

namespace lamina::engine {
namespace {

/// Weights of the control points of `span` in the blossom at `degree - k` times first and k times last.
std::vector<double> blossom_weights(const Knots& knots, std::size_t degree, std::size_t span, std::size_t k) {
  const double first = knots[span];
  const double last = knots[span + 1];
  // Row j holds the weights of the j-th intermediate point of the de Boor scheme.
  const std::size_t order = degree + 1;
  std::vector<std::vector<double>> d(order, std::vector<double>(order, 0.0));
  for (std::size_t j = 0; j < order; ++j) d[j][j] = 1.0;
  for (std::size_t level = 1; level <= degree; ++level) {
    const double argument = level <= degree - k ? first : last;
    for (std::size_t j = degree; j >= level; --j) {
      const std::size_t i = span - degree + j;
      const double low = knots[i];
      const double ratio = (argument - low) / (knots[i + degree - level + 1] - low);
      for (std::size_t c = 0; c < order; ++c) d[j][c] = (1.0 - ratio) * d[j - 1][c] + ratio * d[j][c];
    }
  }
  return d[degree];
}

}  // namespace

BezierSpans::BezierSpans(const Knots& knots, int degree) : degree_(degree) {
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t span = p; span + p + 1 < knots.size(); ++span) {
    if (!(knots[span] < knots[span + 1])) continue;
    firsts_.push_back(span - p);
    for (std::size_t k = 0; k <= p; ++k) {
      const std::vector<double> row = blossom_weights(knots, p, span, k);
      weights_.insert(weights_.end(), row.begin(), row.end());
    }
  }
}

}  // namespace lamina::engine
