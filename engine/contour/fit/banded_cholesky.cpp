#include "engine/contour/fit/banded_cholesky.h"

#include <cmath>

namespace lamina::engine {

void BandedMatrix::reset(std::size_t size, std::size_t half_width) {
  size_ = size;
  half_width_ = half_width;
  entries_.assign(size * (half_width + 1), 0.0);
}

bool BandedMatrix::factorise() {
  const std::size_t stride = half_width_ + 1;
  for (std::size_t row = 0; row < size_; ++row) {
    double* const here = &entries_[row * stride];  // here[half_width_ + column - row]
    const std::size_t begin = row > half_width_ ? row - half_width_ : 0;
    const double untouched = here[half_width_];
    for (std::size_t column = begin; column <= row; ++column) {
      const double* const other = &entries_[column * stride];
      double sum = here[half_width_ + column - row];
      const double* a = here + (half_width_ + begin - row);
      const double* b = other + (half_width_ + begin - column);
      for (std::size_t k = begin; k < column; ++k) sum -= *a++ * *b++;
      if (column < row) {
        here[half_width_ + column - row] = sum * other[half_width_];
      } else {
        // What rounding leaves of a dependent row is no pivot.
        if (!(sum > 1e-13 * untouched)) return false;
        here[half_width_] =
            1.0 / std::sqrt(sum);  // the diagonal is kept as its inverse: it is only divided by
      }
    }
  }
  return true;
}

void BandedMatrix::solve(std::vector<double>& right) const {
  const std::size_t stride = half_width_ + 1;
  for (std::size_t row = 0; row < size_; ++row) {
    const double* const here = &entries_[row * stride];
    const std::size_t begin = row > half_width_ ? row - half_width_ : 0;
    double sum = right[row];
    for (std::size_t k = begin; k < row; ++k) sum -= here[half_width_ + k - row] * right[k];
    right[row] = sum * here[half_width_];
  }
  for (std::size_t row = size_; row-- > 0;) {
    const double* const here = &entries_[row * stride];
    const std::size_t begin = row > half_width_ ? row - half_width_ : 0;
    const double value = right[row] * here[half_width_];
    right[row] = value;
    for (std::size_t k = begin; k < row; ++k) right[k] -= here[half_width_ + k - row] * value;
  }
}

}  // namespace lamina::engine
