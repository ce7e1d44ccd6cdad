#include "tools/preview/layer_svg.h"

#include <algorithm>

#include "tools/preview/svg.h"

namespace lamina::tools {
namespace {

constexpr double kPictureWidth = 1000.0;  ///< pixels along the longer side of the frame

}  // namespace

std::string layer_svg(const engine::Layer& layer, const engine::Box2& frame) {
  const double longer_side = frame.sizes().maxCoeff();
  const double stroke = longer_side / 500.0;
  const double tolerance = longer_side / 5000.0;
  SvgPicture picture(frame, kPictureWidth / longer_side,
                     "layer " + std::to_string(layer.index) + ", z = " + svg_number(layer.plane.z) + " mm");
  const auto stroke_of = [&](const char* colour, bool touch) {
    return std::string("stroke=\"") + colour + "\" stroke-width=\"" + svg_number(stroke) + '"' +
           (touch ? " stroke-dasharray=\"" + svg_number(3.0 * stroke) + '"' : std::string());
  };

  std::vector<engine::Loop> solid;
  for (const engine::ClosedContour& contour : layer.closed) {
    if (!contour.touch) solid.push_back(engine::flatten(contour.curve, tolerance));
  }
  picture.begin_group("class=\"solid\" fill=\"#dde6ee\" stroke=\"none\"");
  picture.loops(solid);
  picture.end_group();

  picture.begin_group("class=\"planar\" fill=\"#c8a27a\" " + stroke_of("#7a4a1e", false));
  for (const engine::PlanarContour& contour : layer.planar) {
    std::vector<engine::Loop> loops{engine::flatten(contour.outer, tolerance)};
    for (const engine::PieceCurve& inner : contour.inner) loops.push_back(engine::flatten(inner, tolerance));
    picture.loops(loops);
  }
  picture.end_group();

  for (const engine::ClosedContour& contour : layer.closed) {
    picture.begin_group("class=\"closed\" " + stroke_of("#111", contour.touch));
    picture.line(engine::flatten(contour.curve, tolerance), true);
    picture.end_group();
  }
  for (const engine::OpenContour& contour : layer.open) {
    picture.begin_group("class=\"open\" " + stroke_of("#d2222d", contour.touch));
    picture.line(engine::flatten(contour.curve, tolerance), false);
    picture.end_group();
  }
  picture.begin_group("class=\"point\" fill=\"#1f5fd0\"");
  for (const engine::TouchPoint& point : layer.points) picture.dot(point.position, 1.5 * stroke);
  picture.end_group();

  picture.text(frame.min() + engine::Vector2(2.0 * stroke, 2.0 * stroke), longer_side / 40.0,
               "z = " + svg_number(layer.plane.z) + " mm");
  return picture.finish();
}

}  // namespace lamina::tools
