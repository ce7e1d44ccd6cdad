#include "tools/bench/chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tools/preview/svg.h"

namespace lamina::tools {
namespace {

using engine::Vector2;

// Of the picture, in its own unit.
constexpr double kWidth = 160.0;
constexpr double kHeight = 80.0;
constexpr double kMargin = 20.0;
constexpr double kTextSize = 3.5;
constexpr double kPixels = 5.0;
constexpr int kTicks = 4;

/// The next of 1, 2, 5 times a power of ten.
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-12))));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * power) return step * power;
  }
  return 10.0 * power;
}

SvgPicture picture(double height, const std::string& title) {
  SvgPicture svg({Vector2(0, 0), Vector2(kWidth + 2.0 * kMargin, height + 2.0 * kMargin)}, kPixels, title);
  svg.text({kMargin, height + 1.5 * kMargin}, 1.3 * kTextSize, title);
  return svg;
}

}  // namespace

std::string line_chart(const std::string& title, const std::string& across,
                       const std::vector<ChartSeries>& series) {
  double most = 0.0;
  std::size_t count = 1;
  for (const ChartSeries& line : series) {
    for (const double value : line.values) most = std::max(most, value);
    count = std::max(count, line.values.size());
  }
  const double top = round_up(most);
  const double last = static_cast<double>(std::max<std::size_t>(count, 2) - 1);
  const auto place = [&](double x, double y) {
    return Vector2(kMargin + kWidth * x / last, kMargin + kHeight * y / top);
  };
  SvgPicture svg = picture(kHeight, title);
  svg.begin_group("stroke=\"#bbb\" stroke-width=\"0.2\"");
  for (int k = 0; k <= kTicks; ++k) {
    const double y = top * k / kTicks;
    svg.line({place(0, y), place(last, y)}, false);
    svg.text({1.0, place(0, y).y() - 1.0}, kTextSize, fmt::format("{:g}", y));
    const double x = std::round(last * k / kTicks);
    svg.text({place(x, 0).x() - 2.0, kMargin - 6.0}, kTextSize, fmt::format("{:g}", x));
  }
  svg.end_group();
  svg.text({kMargin + 0.45 * kWidth, kMargin - 12.0}, kTextSize, across);
  double legend = kMargin;
  for (const ChartSeries& line : series) {
    engine::Polyline points;
    for (std::size_t k = 0; k < line.values.size(); ++k)
      points.push_back(place(static_cast<double>(k), line.values[k]));
    svg.begin_group(fmt::format("stroke=\"{}\" stroke-width=\"0.4\"", line.colour));
    svg.line(points, false);
    svg.line({{legend, kMargin + kHeight + 4.0}, {legend + 6.0, kMargin + kHeight + 4.0}}, false);
    svg.end_group();
    svg.text({legend + 7.0, kMargin + kHeight + 3.0}, kTextSize, line.name);
    legend += 12.0 + 0.6 * kTextSize * static_cast<double>(line.name.size());
  }
  return svg.finish();
}

std::string share_chart(const std::string& title, std::vector<ChartShare> shares, const std::string& unit) {
  std::stable_sort(shares.begin(), shares.end(),
                   [](const ChartShare& a, const ChartShare& b) { return a.value > b.value; });
  double whole = 0.0;
  for (const ChartShare& share : shares) whole += share.value;
  constexpr double kBar = 8.0;
  const double height = kBar * static_cast<double>(shares.size());
  SvgPicture svg = picture(height, title);
  double y = kMargin + height;
  for (const ChartShare& share : shares) {
    y -= kBar;
    const double part = whole > 0.0 ? share.value / whole : 0.0;
    const double left = 2.5 * kMargin;
    const double right = left + part * (kWidth - 3.0 * kMargin);
    svg.begin_group("fill=\"#4a7ab5\" stroke=\"none\"");
    svg.loops({{{left, y + 1.0}, {right, y + 1.0}, {right, y + kBar - 1.0}, {left, y + kBar - 1.0}}});
    svg.end_group();
    svg.text({2.0, y + 3.0}, kTextSize, share.name);
    svg.text({right + 2.0, y + 3.0}, kTextSize,
             fmt::format("{:.0f} %, {:.3g} {}", 100.0 * part, share.value, unit));
  }
  return svg.finish();
}

}  // namespace lamina::tools
