#include "engine/contour/fit/banded_cholesky.h"

#include <random>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using lamina::engine::BandedMatrix;

TEST_CASE("a banded system has the solution that a dense solver finds") {
  std::mt19937 random(20261);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  for (const std::size_t width : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{11}}) {
    for (const std::size_t size : {std::size_t{1}, std::size_t{5}, std::size_t{40}}) {
      const auto n = static_cast<Eigen::Index>(size);
      BandedMatrix banded;
      banded.reset(size, width);
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
      for (std::size_t row = 0; row < size; ++row) {
        for (std::size_t column = row > width ? row - width : 0; column <= row; ++column) {
          const double value = row == column ? 2.0 * static_cast<double>(width) + 1.5 : entry(random);
          banded.at(row, column) = value;
          dense(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = value;
          dense(static_cast<Eigen::Index>(column), static_cast<Eigen::Index>(row)) = value;
        }
      }
      Eigen::VectorXd right = Eigen::VectorXd::NullaryExpr(n, [&] { return entry(random); });
      std::vector<double> solution(right.begin(), right.end());
      REQUIRE(banded.factorise());
      banded.solve(solution);
      const Eigen::VectorXd expected = dense.partialPivLu().solve(right);
      CAPTURE(width, size);
      CHECK((Eigen::Map<Eigen::VectorXd>(solution.data(), n) - expected).norm() < 1e-12);
    }
  }
}

TEST_CASE("a matrix that is not positive definite is refused") {
  BandedMatrix matrix;
  matrix.reset(2, 1);
  matrix.at(0, 0) = 1.0;
  matrix.at(1, 0) = 1.0;
  matrix.at(1, 1) = 1.0;  // singular
  CHECK_FALSE(matrix.factorise());
  matrix.reset(1, 0);
  matrix.at(0, 0) = -1.0;
  CHECK_FALSE(matrix.factorise());
}
