#include "engine/geometry/bspline_basis.h"

#include <algorithm>
#include <cassert>

namespace lamina::engine {

namespace {

/// Turns the values of degree `low` on a span into those of the next degree.
void raise_values(const Knots& knots, int low, std::size_t span, double t, BasisRow& values) {
  const auto count = static_cast<std::size_t>(low) + 1;
  double saved = 0.0;
  for (std::size_t r = 0; r < count; ++r) {
    const double right = knots[span + 1 + r];
    const double left = knots[span + 1 + r - count];
    const double term = values[r] / ((right - t) + (t - left));
    values[r] = saved + (right - t) * term;
    saved = (t - left) * term;
  }
  values[count] = saved;
}

/// Turns k-th derivatives of degree `low` into the next derivatives of the next degree.
void raise_derivatives(const Knots& knots, int low, std::size_t span, BasisRow& row) {
  const auto count = static_cast<std::size_t>(low) + 1;
  double saved = 0.0;
  for (std::size_t r = 0; r < count; ++r) {
    const double steep =
        static_cast<double>(count) * row[r] / (knots[span + 1 + r] - knots[span + 1 + r - count]);
    row[r] = saved - steep;
    saved = steep;
  }
  row[count] = saved;
}

}  // namespace

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

BasisRow basis_functions(const Knots& knots, int degree, std::size_t span, double t) {
  BasisRow values(degree);
  values[0] = 1.0;
  for (int low = 0; low < degree; ++low) raise_values(knots, low, span, t, values);
  return values;
}

std::array<BasisRow, 3> basis_derivatives(const Knots& knots, int degree, std::size_t span, double t) {
  // The k-th derivative of a basis function of degree p is a combination of functions of degree p - k (The
  // NURBS Book, equation 2.7): they all come by on the way up.
  std::array<BasisRow, 3> rows{BasisRow(degree), BasisRow(degree), BasisRow(degree)};
  auto& [values, first, second] = rows;
  for (std::size_t k = 0; k < values.size(); ++k) first[k] = second[k] = 0.0;
  values[0] = 1.0;
  for (int low = 0; low < degree; ++low) {
    if (low == degree - 2) {
      second = values;
      raise_derivatives(knots, low, span, second);
    }
    if (low == degree - 1) {
      first = values;
      raise_derivatives(knots, low, span, first);
      if (degree > 1) raise_derivatives(knots, low, span, second);
    }
    raise_values(knots, low, span, t, values);
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
