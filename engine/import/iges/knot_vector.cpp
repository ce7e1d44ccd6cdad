#include "engine/import/iges/knot_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace lamina::engine {
namespace {

constexpr int kHighestReadDegree = 25;
constexpr double kLowestWeight = 1e-12;
constexpr double kHighestWeight = 1e12;

}  // namespace

int read_degree(ParameterRecord& record, std::size_t count, std::string_view name) {
  const int degree = record.integer(name);
  if (degree < 1 || degree > kHighestReadDegree) {
    record.fail(fmt::format("the {} is {}, and must be from 1 to {}", name, degree, kHighestReadDegree));
  }
  if (static_cast<std::size_t>(degree) >= count) {
    record.fail(
        fmt::format("the {} is {}, and must be below the number of control points, {}", name, degree, count));
  }
  return degree;
}

Knots read_knots(ParameterRecord& record, std::size_t count, int degree, int inner_repeats,
                 std::string_view name) {
  const auto order = static_cast<std::size_t>(degree) + 1;
  record.require(count + order, name);
  Knots knots;
  knots.reserve(count + order);
  for (std::size_t i = 0; i < count + order; ++i) {
    const double knot = record.real(name);
    if (i > 0 && knot < knots.back()) {
      record.fail(fmt::format("{} {} is {}, less than {} {} ({}): knots must not decrease", name, i, knot,
                              name, i - 1, knots.back()));
    }
    knots.push_back(knot);
  }
  const double first = knots[order - 1];
  const double last = knots[count];
  const double length = last - first;
  if (!(length > 0.0) || !std::isfinite(length)) {
    record.fail(fmt::format("the {} domain is from {} to {}, and must have a length", name, first, last));
  }
  for (std::size_t i = 0; i < knots.size();) {
    const auto next = std::upper_bound(knots.begin() + static_cast<std::ptrdiff_t>(i), knots.end(), knots[i]);
    const auto repeats = static_cast<std::size_t>(next - knots.begin()) - i;
    const bool is_inner = knots[i] > first && knots[i] < last;
    const std::size_t allowed = is_inner ? static_cast<std::size_t>(inner_repeats) : order;
    if (repeats > allowed) {
      record.fail(fmt::format("{} {} ({}) is repeated {} times, and may be {} times at degree {}", name, i,
                              knots[i], repeats, allowed, degree));
    }
    i += repeats;
  }
  return knots;
}

double read_weight(ParameterRecord& record) {
  const double weight = record.real("weight");
  if (!(weight >= kLowestWeight && weight <= kHighestWeight)) {
    record.fail(fmt::format("a weight is {}, and must be positive, from {} to {}", weight, kLowestWeight,
                            kHighestWeight));
  }
  return weight;
}

ParameterRange read_parameter_range(ParameterRecord& record, const Knots& knots, int degree) {
  const double low = knots[static_cast<std::size_t>(degree)];
  const double high = knots[knots.size() - 1 - static_cast<std::size_t>(degree)];
  const double rounding = 1e-9 * (high - low);
  const auto snapped = [&](double value) {
    const auto above = std::lower_bound(knots.begin(), knots.end(), value - rounding);
    return above != knots.end() && std::abs(*above - value) <= rounding ? *above : value;
  };
  ParameterRange range;
  range.first = snapped(record.real_or(low, "start of the parameter range"));
  range.last = snapped(record.real_or(high, "end of the parameter range"));
  if (range.first >= low && range.last <= high && range.first < range.last) return range;
  record.note(Tolerance::kParameterRange,
              fmt::format("{} to {} of {} to {}", range.first, range.last, low, high));
  return {low, high};
}

}  // namespace lamina::engine
