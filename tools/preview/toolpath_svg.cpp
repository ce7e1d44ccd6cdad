#include "tools/preview/toolpath_svg.h"

#include <algorithm>

#include "tools/preview/svg.h"

namespace lamina::tools {
namespace {

constexpr std::size_t kColumns = 3;
constexpr double kSheetWidth = 1500.0;  ///< pixels
constexpr double kTravelStroke = 0.05;  ///< mm

/// The colours that other viewers have taught people to expect for each role.
const char* colour(gcode::Role role) {
  switch (role) {
    case gcode::Role::kOuterWall:
      return "#ff7d38";
    case gcode::Role::kInnerWall:
      return "#ffe64d";
    case gcode::Role::kSparseInfill:
      return "#b03029";
    case gcode::Role::kSolidInfill:
      return "#9654cc";
    case gcode::Role::kTopSurface:
      return "#f04040";
    case gcode::Role::kBottomSurface:
      return "#9654cc";
    case gcode::Role::kBridge:
      return "#4d80ba";
    case gcode::Role::kGapFill:
      return "#999999";
    case gcode::Role::kSkirt:
    case gcode::Role::kBrim:
      return "#00876e";
    case gcode::Role::kSupport:
      return "#00c000";
    case gcode::Role::kTravel:
      break;
  }
  return "#8899aa";
}

engine::Box2 common_frame(const std::vector<PicturedLayer>& layers) {
  engine::Box2 frame;
  for (const PicturedLayer& layer : layers) {
    const engine::Box3 box = gcode::extrusion_bounds(layer.toolpath, layer.start);
    if (box.isEmpty()) continue;
    frame.extend(engine::Vector2(box.min().head<2>()));
    frame.extend(engine::Vector2(box.max().head<2>()));
  }
  if (frame.isEmpty()) frame.extend(engine::Vector2::Zero());
  const engine::Vector2 margin = engine::Vector2::Constant(1.0);
  return {frame.min() - margin, frame.max() + margin};
}

/// Runs of moves of one role and width are one stroke.
void draw(SvgPicture& picture, const PicturedLayer& layer, const engine::Vector2& offset) {
  engine::Vector2 from = layer.start.head<2>();
  engine::Polyline run;
  const gcode::Move* style = nullptr;
  const auto flush = [&] {
    if (style != nullptr && run.size() > 1) {
      const bool travel = style->role == gcode::Role::kTravel;
      picture.begin_group(std::string("stroke=\"") + colour(style->role) + "\" stroke-width=\"" +
                          svg_number(travel ? kTravelStroke : style->width) + '"');
      picture.line(run, false);
      picture.end_group();
    }
    run.clear();
  };
  for (const gcode::Move& move : layer.toolpath.moves) {
    const engine::Vector2 to = move.end.head<2>();
    if (to == from) continue;
    if (style == nullptr || style->role != move.role || style->width != move.width) {
      flush();
      style = &move;
      run.push_back(from + offset);
    }
    run.push_back(to + offset);
    from = to;
  }
  flush();
}

}  // namespace

std::string toolpath_sheet_svg(const std::vector<PicturedLayer>& layers) {
  const engine::Box2 frame = common_frame(layers);
  const engine::Vector2 size = frame.sizes();
  const double caption = size.maxCoeff() / 20.0;
  const engine::Vector2 pitch = size + engine::Vector2(0.0, 2.0 * caption);
  const std::size_t columns = std::min(kColumns, std::max<std::size_t>(1, layers.size()));
  const std::size_t rows = (layers.size() + columns - 1) / columns;
  const engine::Box2 sheet(engine::Vector2(0.0, -pitch.y() * static_cast<double>(rows)),
                           engine::Vector2(pitch.x() * static_cast<double>(columns), 0.0));
  SvgPicture picture(sheet, kSheetWidth / sheet.sizes().x(), "toolpaths layer by layer");
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::size_t row = i / columns;
    const engine::Vector2 corner(pitch.x() * static_cast<double>(i % columns),
                                 -pitch.y() * static_cast<double>(row + 1));
    const engine::Vector2 offset = corner + engine::Vector2(0.0, 2.0 * caption) - frame.min();
    draw(picture, layers[i], offset);
    picture.text(corner + engine::Vector2(caption, caption / 2.0), caption,
                 "layer " + std::to_string(layers[i].toolpath.index) +
                     ", z = " + svg_number(layers[i].toolpath.z) + " mm");
  }
  return picture.finish();
}

}  // namespace lamina::tools
