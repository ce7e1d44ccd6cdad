#include "tools/bench/section_picture.h"

#include "tools/preview/svg.h"

namespace lamina::tools {
namespace {

constexpr double kSide = 100.0;  // mm that the longer side is drawn as, whatever its size
constexpr double kMargin = 3.0;

}  // namespace

std::string section_picture(const engine::Region& ours, const std::vector<engine::Polyline>& theirs,
                            const std::string& title) {
  engine::Box2 box = engine::bounds(ours);
  for (const engine::Polyline& line : theirs) {
    for (const engine::Vector2& point : line) box.extend(point);
  }
  const double scale = kSide / box.sizes().maxCoeff();
  const auto drawn = [&](const engine::Polyline& line) {
    engine::Polyline result;
    for (const engine::Vector2& point : line) result.emplace_back(scale * (point - box.min()));
    return result;
  };
  const engine::Vector2 margin = engine::Vector2::Constant(kMargin);
  SvgPicture picture({-margin, scale * box.sizes() + margin}, 8.0, title);
  picture.begin_group("fill=\"#9cc4e4\" fill-rule=\"evenodd\" stroke=\"#1b4f72\" stroke-width=\"0.25\"");
  for (const engine::Polygon& polygon : ours) {
    std::vector<engine::Loop> loops{drawn(polygon.outer)};
    for (const engine::Loop& hole : polygon.holes) loops.push_back(drawn(hole));
    picture.loops(loops);
  }
  picture.end_group();
  picture.begin_group("fill=\"none\" stroke=\"#d00\" stroke-width=\"0.12\"");
  for (const engine::Polyline& line : theirs) picture.line(drawn(line), false);
  picture.end_group();
  picture.begin_group("fill=\"#d00\"");
  for (const engine::Polyline& line : theirs) {
    for (const engine::Vector2& end : {line.front(), line.back()})
      picture.dot(scale * (end - box.min()), 0.4);
  }
  picture.end_group();
  return picture.finish();
}

}  // namespace lamina::tools
