#include "engine/pointcloud/height_net.h"

#include <cmath>

namespace lamina::engine {
namespace {

/// Heights, mm, that differ by less are equal: rounding must neither spoil a monotone direction nor feign
/// one.
constexpr double kHeightNoise = 1e-11;

}  // namespace

int sign_changes(const double* values, std::ptrdiff_t stride, int count) {
  int changes = 0;
  for (int k = 1; k < count; ++k) {
    changes += (values[k * stride] < 0.0) != (values[(k - 1) * stride] < 0.0) ? 1 : 0;
  }
  return changes;
}

bool all_zero(const double* values, std::ptrdiff_t stride, int count) {
  for (int k = 0; k < count; ++k) {
    if (values[k * stride] != 0.0) return false;
  }
  return true;
}

bool all_within(const double* values, std::ptrdiff_t stride, int count, double tolerance) {
  for (int k = 0; k < count; ++k) {
    if (std::abs(values[k * stride]) > tolerance) return false;
  }
  return true;
}

void halve_line(const double* net, double* low, double* high, std::ptrdiff_t stride, int count) {
  for (int k = 0; k < count; ++k) low[k * stride] = net[k * stride];
  for (int level = 0; level < count; ++level) {
    high[(count - 1 - level) * stride] = low[(count - 1) * stride];
    for (int k = count - 1; k > level; --k) low[k * stride] = 0.5 * (low[k * stride] + low[(k - 1) * stride]);
  }
}

int monotone(const double* net, std::ptrdiff_t step, int count, std::ptrdiff_t stride, int lines) {
  bool rises = false;
  bool falls = false;
  for (int l = 0; l < lines; ++l) {
    for (int k = 1; k < count; ++k) {
      const double difference = net[l * stride + k * step] - net[l * stride + (k - 1) * step];
      rises = rises || difference > kHeightNoise;
      falls = falls || difference < -kHeightNoise;
    }
  }
  return rises == falls ? 0 : (rises ? 1 : -1);
}

}  // namespace lamina::engine
