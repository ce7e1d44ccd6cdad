#include "engine/contour/fit/spline_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/geometry/basis_window.h"

namespace lamina::engine {
namespace {

constexpr double kManageableSpans = 10.0;  // of an evenly turning cubic, in one spline

/// Cuts a long chain at nodes into parts of nearly equal expected numbers of spans.
std::vector<SmoothChain> manageable_parts(const SmoothChain& chain, const SplineFitOptions& options) {
  const std::vector<double> lengths = segment_lengths(chain);
  std::vector<double> sums{0.0};
  for (std::size_t i = 0; i < lengths.size(); ++i)
    sums.push_back(sums.back() + evenly_turning_spans(chain, i, lengths[i], options.tolerance));
  const double parts = std::max(1.0, std::ceil(sums.back() / kManageableSpans));
  std::vector<SmoothChain> result;
  std::size_t first = 0;
  for (double k = 1.0; k <= parts && first < lengths.size(); ++k) {
    const auto cut = std::lower_bound(sums.begin(), sums.end(), sums.back() * k / parts);
    const std::size_t last = k < parts ? static_cast<std::size_t>(cut - sums.begin()) : lengths.size();
    if (last > first) result.push_back(sub_chain(chain, first, last));
    first = std::max(first, last);
  }
  return result;
}

PlanarCurve cubic_curve(const SmoothChain& chain) {
  const Cubic cubic = hermite_cubic(chain, 0);
  const double size = segment_lengths(chain).front();
  return {3, {0.0, 0.0, 0.0, 0.0, size, size, size, size}, {cubic.begin(), cubic.end()}};
}

}  // namespace

SplineFit fit_splines(const SmoothChain& chain, const SplineFitOptions& options,
                      const std::optional<SplineHint>& hint) {
  assert(options.tolerance > 0.0 && options.least_degree >= 2 &&
         options.greatest_degree <= kHighestWindowDegree);
  SplineFit fit;
  fit.hint = hint;
  // Those still to be fitted, the foremost last.
  std::vector<SmoothChain> parts = manageable_parts(chain, options);
  std::reverse(parts.begin(), parts.end());
  while (!parts.empty()) {
    const SmoothChain part = std::move(parts.back());
    parts.pop_back();
    const std::size_t segments = part.positions.size() - 1;
    SplineSearch search = search_spline(part, options, fit.hint);
    fit.hint = search.hint;
    if (search.curve) {
      fit.greatest_distance = std::max(fit.greatest_distance, search.greatest_distance);
      fit.curves.push_back(std::move(*search.curve));
    } else if (segments == 1) {
      fit.curves.push_back(cubic_curve(part));
    } else {
      parts.push_back(sub_chain(part, segments / 2, segments));
      parts.push_back(sub_chain(part, 0, segments / 2));
    }
  }
  return fit;
}

}  // namespace lamina::engine
