#pragma once

#include <cstddef>

namespace lamina::engine {

// The heights of a patch's control net over a plane, times the weights, as rows of numbers in one array: the
// Bernstein coefficients of a polynomial that is zero where the patch meets the plane.

/// Changes of sign along `count` numbers, a zero counting as positive; the polynomial has no more zeros than
/// that (variation diminishing).
int sign_changes(const double* values, std::ptrdiff_t stride, int count);

bool all_zero(const double* values, std::ptrdiff_t stride, int count);

/// Whether all lie within `tolerance` of zero.
bool all_within(const double* values, std::ptrdiff_t stride, int count, double tolerance);

/// The two halves of one row, by de Casteljau at 1/2.
void halve_line(const double* net, double* low, double* high, std::ptrdiff_t stride, int count);

/// Whether `lines` rows of `count` numbers all go one way, which the polynomial then does too: 1 rising, -1
/// falling, 0 neither. `step` lies between the numbers of a row, `stride` between rows.
int monotone(const double* net, std::ptrdiff_t step, int count, std::ptrdiff_t stride, int lines);

}  // namespace lamina::engine
