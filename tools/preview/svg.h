#pragma once

#include <string>
#include <string_view>

#include "engine/geometry/polygon.h"

namespace lamina::tools {

/// Writes one SVG picture: a frame in mm, x to the right and y up as on the bed, one drawing call after
/// another. Deterministic; coordinates to a micrometre.
class SvgPicture {
 public:
  /// `frame` in mm; `pixels_per_mm` sets the size at which viewers first show it. `title` is what a screen
  /// reader says.
  SvgPicture(const engine::Box2& frame, double pixels_per_mm, std::string_view title);

  /// Everything up to the matching `end_group` gets these attributes, such as `class="outer" stroke="#f00"`.
  void begin_group(std::string_view attributes);
  void end_group();

  /// An open chain, or a closed one.
  void line(const engine::Polyline& points, bool closed);

  /// One path of several loops, filled by the even-odd rule.
  void loops(const std::vector<engine::Loop>& loops);

  void dot(const engine::Vector2& centre, double radius);

  /// Text with its baseline's start at `place`; `size` in mm.
  void text(const engine::Vector2& place, double size, std::string_view text);

  /// The finished document. Nothing may be drawn afterwards.
  std::string finish();

 private:
  void point(const engine::Vector2& point);

  engine::Box2 frame_;
  std::string svg_;
};

/// A number to a micrometre without trailing zeros, independent of the locale.
std::string svg_number(double value);

}  // namespace lamina::tools
