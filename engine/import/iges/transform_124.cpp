#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.21: x -> matrix x + translation, row by row. The form says whether it turns or
/// mirrors; the numbers say it too. Any matrix but a singular one is applied as it is.
Eigen::Affine3d read_transformation_matrix_124(ParameterRecord& record) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 4; ++column) {
      transform.matrix()(row, column) = record.real(column < 3 ? "matrix element" : "translation");
    }
  }
  const Eigen::Matrix3d matrix = transform.linear();
  const double size = matrix.norm();
  if (!(std::abs(matrix.determinant()) > 1e-12 * size * size * size)) {
    record.fail("the matrix is singular: it would flatten the model");
  }
  constexpr double kRounding = 1e-4;
  if ((matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).norm() > kRounding) {
    record.note(Tolerance::kUnusualMatrix, fmt::format("determinant {:.6g}", matrix.determinant()));
  }
  return transform;
}

}  // namespace lamina::engine
