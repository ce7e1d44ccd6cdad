#include "engine/pointcloud/bezier_spans.h"

#include "engine/geometry/bspline_basis.h"

namespace lamina::engine {
namespace {

/// Weights of the control points of `span` in the blossom at `degree - k` times first and k times last, by
/// the de Boor scheme: row j of `d` holds those of the j-th intermediate point. They are its last row at the
/// end.
void blossom_weights(const Knots& knots, std::size_t degree, std::size_t span, std::size_t k,
                     std::vector<double>& d) {
  const double first = knots[span];
  const double last = knots[span + 1];
  const std::size_t order = degree + 1;
  d.assign(order * order, 0.0);
  for (std::size_t j = 0; j < order; ++j) d[j * order + j] = 1.0;
  for (std::size_t level = 1; level <= degree; ++level) {
    const double argument = level <= degree - k ? first : last;
    for (std::size_t j = degree; j >= level; --j) {
      const std::size_t i = span - degree + j;
      const double low = knots[i];
      const double ratio = (argument - low) / (knots[i + degree - level + 1] - low);
      double* const row = &d[j * order];
      for (std::size_t c = j - level; c <= j; ++c) row[c] = (1.0 - ratio) * row[c - order] + ratio * row[c];
    }
  }
}

}  // namespace

BezierSpans::BezierSpans(const Knots& knots, int degree) : degree_(degree) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> scheme;
  for (std::size_t span = p; span + p + 1 < knots.size(); ++span) {
    if (!(knots[span] < knots[span + 1])) continue;
    firsts_.push_back(span - p);
    for (std::size_t k = 0; k <= p; ++k) {
      blossom_weights(knots, p, span, k, scheme);
      weights_.insert(weights_.end(), scheme.end() - static_cast<std::ptrdiff_t>(p + 1), scheme.end());
    }
  }
}

}  // namespace lamina::engine
