#include "tools/preview/svg.h"

#include <cassert>
#include <charconv>
#include <cmath>

namespace lamina::tools {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

std::string svg_number(double value) {
  const double rounded = std::round(value * 1000.0) / 1000.0;
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, rounded == 0.0 ? 0.0 : rounded).ptr;
  return {buffer, end};
}

SvgPicture::SvgPicture(const engine::Box2& frame, double pixels_per_mm, std::string_view title)
    : frame_(frame) {
  const engine::Vector2 size = frame.sizes();
  svg_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + svg_number(size.x()) + ' ' +
         svg_number(size.y()) + "\" width=\"" + svg_number(size.x() * pixels_per_mm) + "\" height=\"" +
         svg_number(size.y() * pixels_per_mm) +
         "\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>" + escaped(title) +
         "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
}

void SvgPicture::begin_group(std::string_view attributes) {
  svg_ += "<g ";
  svg_ += attributes;
  svg_ += ">\n";
}

void SvgPicture::end_group() {
  svg_ += "</g>\n";
}

void SvgPicture::point(const engine::Vector2& point) {
  svg_ += svg_number(point.x() - frame_.min().x());
  svg_ += ' ';
  svg_ += svg_number(frame_.max().y() - point.y());
}

void SvgPicture::line(const engine::Polyline& points, bool closed) {
  svg_ += "<path d=\"";
  for (std::size_t i = 0; i < points.size(); ++i) {
    svg_ += i == 0 ? 'M' : 'L';
    point(points[i]);
  }
  svg_ += closed ? "Z\"/>\n" : "\"/>\n";
}

void SvgPicture::loops(const std::vector<engine::Loop>& loops) {
  svg_ += "<path fill-rule=\"evenodd\" d=\"";
  for (const engine::Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      svg_ += i == 0 ? 'M' : 'L';
      point(loop[i]);
    }
    svg_ += 'Z';
  }
  svg_ += "\"/>\n";
}

void SvgPicture::dot(const engine::Vector2& centre, double radius) {
  svg_ += "<circle cx=\"" + svg_number(centre.x() - frame_.min().x()) + "\" cy=\"" +
          svg_number(frame_.max().y() - centre.y()) + "\" r=\"" + svg_number(radius) + "\"/>\n";
}

void SvgPicture::text(const engine::Vector2& place, double size, std::string_view text) {
  svg_ += "<text x=\"" + svg_number(place.x() - frame_.min().x()) + "\" y=\"" +
          svg_number(frame_.max().y() - place.y()) + "\" font-size=\"" + svg_number(size) +
          "\" font-family=\"sans-serif\" stroke=\"none\" fill=\"#333\">" + escaped(text) + "</text>\n";
}

std::string SvgPicture::finish() {
  return std::move(svg_) + "</svg>\n";
}

}  // namespace lamina::tools
