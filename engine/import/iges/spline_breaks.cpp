#include "engine/import/iges/spline_breaks.h"

#include <fmt/format.h>

namespace lamina::engine {

std::vector<double> read_break_points(ParameterRecord& record, std::size_t segments, std::string_view name) {
  record.require(segments + 1, name);
  std::vector<double> breaks;
  for (std::size_t i = 0; i <= segments; ++i) {
    const double value = record.real(name);
    if (i > 0 && !(value > breaks.back())) {
      record.fail(fmt::format("{} {} is {}, not above {} {} ({}): they must increase", name, i, value, name,
                              i - 1, breaks.back()));
    }
    breaks.push_back(value);
  }
  return breaks;
}

Knots bezier_knots(const std::vector<double>& breaks, std::size_t degree) {
  Knots knots{breaks.front()};
  for (const double value : breaks) knots.insert(knots.end(), degree, value);
  knots.push_back(breaks.back());
  return knots;
}

}  // namespace lamina::engine
