#include "engine/contour/fit/banded_cholesky.h"

#include <cmath>
#include <type_traits>

namespace lamina::engine {
namespace {

/// Calls `visit` with the half width, as a compile-time constant for those of planar splines of degree 2 to 5
/// (their loops are unrolled then).
template <typename Visit>
decltype(auto) with_half_width(std::size_t half_width, Visit&& visit) {
  switch (half_width) {
    case 5:
      return visit(std::integral_constant<std::size_t, 5>{});
    case 7:
      return visit(std::integral_constant<std::size_t, 7>{});
    case 9:
      return visit(std::integral_constant<std::size_t, 9>{});
    case 11:
      return visit(std::integral_constant<std::size_t, 11>{});
    default:
      return visit(half_width);
  }
}

}  // namespace

void BandedMatrix::reset(std::size_t size, std::size_t half_width) {
  size_ = size;
  half_width_ = half_width;
  entries_.assign((size + half_width) * (half_width + 1), 0.0);
}

bool BandedMatrix::factorise() {
  diagonal_.resize(size_);
  for (std::size_t i = 0; i < size_; ++i) diagonal_[i] = entries_[i * (half_width_ + 1)];
  return with_half_width(half_width_, [this](const auto width) {
    double* column = entries_.data();
    for (std::size_t i = 0; i < size_; ++i, column += width + 1) {
      // What rounding leaves of a dependent row is no pivot.
      if (!(column[0] > 1e-13 * diagonal_[i])) return false;
      const double inverse = 1.0 / std::sqrt(column[0]);
      column[0] = inverse;  // it is only divided by
      for (std::size_t j = 1; j <= width; ++j) column[j] *= inverse;
      for (std::size_t j = 1; j <= width; ++j) {
        double* const later = column + j * (width + 1);
        for (std::size_t k = 0; k <= width - j; ++k) later[k] -= column[j] * column[j + k];
      }
    }
    return true;
  });
}

void BandedMatrix::solve(std::vector<double>& right) const {
  right.resize(size_ + half_width_, 0.0);
  with_half_width(half_width_, [&](const auto width) {
    const double* column = entries_.data();
    double* x = right.data();
    for (std::size_t i = 0; i < size_; ++i, column += width + 1, ++x) {
      x[0] *= column[0];
      for (std::size_t j = 1; j <= width; ++j) x[j] -= column[j] * x[0];
    }
    for (std::size_t i = size_; i-- > 0;) {
      column -= width + 1;
      --x;
      double odd = 0.0;
      double even = 0.0;
      for (std::size_t j = 1; j < width; j += 2) {
        odd += column[j] * x[j];
        even += column[j + 1] * x[j + 1];
      }
      if (width % 2 == 1) odd += column[width] * x[width];
      x[0] = (x[0] - (odd + even)) * column[0];
    }
  });
  right.resize(size_);
}

}  // namespace lamina::engine
