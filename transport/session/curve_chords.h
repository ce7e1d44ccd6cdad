#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace lamina::transport {

using PlanePoint = std::array<double, 2>;  ///< mm

/// The circular way from `start` to `end` about the centre of G2 (clockwise) or G3.
struct ArcWay {
  PlanePoint start{};
  PlanePoint end{};
  PlanePoint center{};
  double sweep = 0;  ///< rad, positive counter-clockwise; a full circle where start and end are the same
};

/// By centre (`offset` = I, J). None where the radius is zero.
std::optional<ArcWay> arc_by_offset(const PlanePoint& start, const PlanePoint& end, const PlanePoint& offset,
                                    bool clockwise);

/// By radius (R; negative: the longer way round). None where no such circle exists.
std::optional<ArcWay> arc_of_radius(const PlanePoint& start, const PlanePoint& end, double radius,
                                    bool clockwise);

/// Ends of equal chords along the arc, the last one exactly `end`; no point of the arc is farther than
/// `tolerance` (mm) from its chord.
std::vector<PlanePoint> chords(const ArcWay& arc, double tolerance);

/// The same for a cubic Bezier curve (G5) of these four control points, cut at equal parameters. Between two
/// cuts the distance is at most h^2/8 max|B''|.
std::vector<PlanePoint> chords(const std::array<PlanePoint, 4>& bezier, double tolerance);

}  // namespace lamina::transport
