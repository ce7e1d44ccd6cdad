#pragma once

#include <cstddef>
#include <string_view>

#include "engine/geometry/bspline_basis.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// Takes the degree of a B-spline with `count` control points: from 1 to 25, and below `count`.
int read_degree(ParameterRecord& record, std::size_t count, std::string_view name);

/// Takes the `count + degree + 1` knots: they must not decrease, no knot may repeat more than degree + 1
/// times (inside the domain `inner_repeats`), and the domain must have a length.
Knots read_knots(ParameterRecord& record, std::size_t count, int degree, int inner_repeats,
                 std::string_view name);

/// Takes a weight, which must be positive.
double read_weight(ParameterRecord& record);

/// A piece of the domain.
struct ParameterRange {
  double first = 0.0;
  double last = 1.0;
};

/// Takes the two ends of the range on which a B-spline is used; ends within rounding of a knot are that knot.
/// Gives the whole domain where they are missing or make no sense.
ParameterRange read_parameter_range(ParameterRecord& record, const Knots& knots, int degree);

}  // namespace lamina::engine
