#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/geometry/bspline_basis.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// Takes the `segments + 1` break points of a parametric spline (112, 114), which must increase.
std::vector<double> read_break_points(ParameterRecord& record, std::size_t segments, std::string_view name);

/// Knot vector over the break points with full multiplicity at each: that of Bezier segments of this degree.
Knots bezier_knots(const std::vector<double>& breaks, std::size_t degree);

}  // namespace lamina::engine
