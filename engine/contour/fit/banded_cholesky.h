#pragma once

#include <cstddef>
#include <vector>

namespace lamina::engine {

/// A symmetric matrix with `half_width` diagonals beside the main one; only the lower part is stored.
class BandedMatrix {
 public:
  /// Zero everywhere; reuses the storage that it has.
  void reset(std::size_t size, std::size_t half_width);

  std::size_t size() const { return size_; }
  std::size_t half_width() const { return half_width_; }

  /// Entry (row, column) with row >= column and row - column <= half_width.
  double& at(std::size_t row, std::size_t column) {
    return entries_[column * (half_width_ + 1) + row - column];
  }
  double at(std::size_t row, std::size_t column) const {
    return entries_[column * (half_width_ + 1) + row - column];
  }

  /// Whether the matrix was positive definite; if so it now holds its Cholesky factor L with A = L L^T, the
  /// diagonal as its inverse. O(size * half_width^2), the outer product form (Golub and Van Loan, Matrix
  /// Computations, section 4.3.5): its inner loop runs along a column.
  bool factorise();

  /// Solves A x = right with the factor; `right` becomes x.
  void solve(std::vector<double>& right) const;

 private:
  std::size_t size_ = 0;
  std::size_t half_width_ = 0;
  // Column by column, from the diagonal down. Behind the last column follow half_width more, always zero: so
  // that the inner loops need not look out for the end.
  std::vector<double> entries_;
  std::vector<double> diagonal_;  // before the factorisation
};

}  // namespace lamina::engine
