#pragma once

#include <string>
#include <vector>

namespace lamina::tools {

/// One line of a chart: a value for every place from 0 on.
struct ChartSeries {
  std::string name;
  std::string colour;  ///< as SVG has it
  std::vector<double> values;
};

/// Values over their place, as an SVG document.
std::string line_chart(const std::string& title, const std::string& across,
                       const std::vector<ChartSeries>& series);

struct ChartShare {
  std::string name;
  double value = 0.0;
};

/// Shares of a whole as bars, the largest first; `unit` follows the values.
std::string share_chart(const std::string& title, std::vector<ChartShare> shares, const std::string& unit);

}  // namespace lamina::tools
