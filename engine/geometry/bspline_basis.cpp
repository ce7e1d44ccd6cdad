#include "engine/geometry/bspline_basis.h"

#include <algorithm>
#include <cassert>

namespace lamina::engine {

std::size_t find_span(const Knots& knots, int degree, double t) {
  const auto p = static_cast<std::ptrdiff_t>(degree);
  const auto first = knots.begin() + p;
  const auto last = knots.end() - p - 1;
  // The first knot greater than t, looked for in the domain only; at the upper end step back over the
  // repeats.
  auto upper = std::upper_bound(first, last, t);
  if (upper == last) upper = std::lower_bound(first, last, *last);
  if (upper == first) ++upper;
  return static_cast<std::size_t>(upper - knots.begin()) - 1;
}

std::vector<double> basis_functions(const Knots& knots, int degree, std::size_t span, double t) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> values(p + 1, 0.0);
  std::vector<double> left(p + 1, 0.0);
  std::vector<double> right(p + 1, 0.0);
  values[0] = 1.0;
  for (std::size_t j = 1; j <= p; ++j) {
    left[j] = t - knots[span + 1 - j];
    right[j] = knots[span + j] - t;
    double saved = 0.0;
    for (std::size_t r = 0; r < j; ++r) {
      const double term = values[r] / (right[r + 1] + left[j - r]);
      values[r] = saved + right[r + 1] * term;
      saved = left[j - r] * term;
    }
    values[j] = saved;
  }
  return values;
}

std::vector<std::vector<double>> basis_derivatives(const Knots& knots, int degree, std::size_t span, double t,
                                                   int order) {
  const auto p = static_cast<std::size_t>(degree);
  const auto highest = static_cast<std::size_t>(order);
  // The k-th derivative of a basis function of degree p is a combination of functions of degree p - 1 (The
  // NURBS Book, equation 2.7), so each row is built from the rows of one degree less.
  std::vector<std::vector<double>> rows(highest + 1, std::vector<double>(p + 1, 0.0));
  for (std::size_t k = 0; k <= highest && k <= p; ++k) {
    std::vector<double> values = basis_functions(knots, static_cast<int>(p - k), span, t);
    for (std::size_t q = p - k + 1; q <= p; ++q) {  // raise the degree, differentiating each time
      std::vector<double> raised(q + 1, 0.0);
      for (std::size_t r = 0; r <= q; ++r) {
        const std::size_t i = span - q + r;  // index of the function of degree q
        double derivative = 0.0;
        if (r > 0) derivative += values[r - 1] / (knots[i + q] - knots[i]);
        if (r < q) derivative -= values[r] / (knots[i + q + 1] - knots[i + 1]);
        raised[r] = static_cast<double>(q) * derivative;
      }
      values = std::move(raised);
    }
    rows[k] = std::move(values);
  }
  return rows;
}

std::vector<double> bernstein(int degree, double t) {
  std::vector<double> values(static_cast<std::size_t>(degree) + 1, 0.0);
  values[0] = 1.0;
  for (std::size_t j = 1; j < values.size(); ++j) {
    double saved = 0.0;
    for (std::size_t k = 0; k < j; ++k) {
      const double value = values[k];
      values[k] = saved + (1.0 - t) * value;
      saved = t * value;
    }
    values[j] = saved;
  }
  return values;
}

std::vector<double> break_points(const Knots& knots, int degree) {
  assert(knots.size() >= 2 * static_cast<std::size_t>(degree) + 2);
  std::vector<double> breaks(knots.begin() + degree, knots.end() - degree);
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

}  // namespace lamina::engine
