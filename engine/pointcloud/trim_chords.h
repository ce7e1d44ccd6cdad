#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

enum class TrimPlace { kInside, kOutside, kCut };

/// A straight piece of a trim loop in the parameter plane.
struct TrimChord {
  static constexpr std::uint32_t kNoEdge = 0xffffffff;

  Vector2 a;
  Vector2 b;
  std::uint32_t edge = kNoEdge;  ///< kNoEdge: closes the gap between two curves
  std::uint32_t sample = 0;      ///< of the edge, at `a`
};

/// Where a line of straight sides in the parameter plane meets a trim curve.
struct TrimCrossing {
  std::size_t side = 0;  ///< of the line: from its point `side` to the next
  double along = 0.0;    ///< that side, 0 to 1
  std::uint32_t edge = 0;
  std::uint32_t sample = 0;  ///< of the edge: it is met between this one and the next
  double on_chord = 0.0;     ///< where between them, 0 to 1
};

/// Closed loops of chords, and which places lie inside them by parity. A tree of boxes over the chords, in
/// the order of the loops, so that what is asked about a place costs the logarithm of their number.
class TrimChords {
 public:
  TrimChords() = default;
  explicit TrimChords(std::vector<TrimChord> chords);

  bool contains(const Vector2& place) const;
  /// Of the box between two corners.
  TrimPlace place_of(const Vector2& low, const Vector2& high) const;
  /// In order along the line, which has two points at least.
  std::vector<TrimCrossing> crossings(const std::vector<Vector2>& line) const;

 private:
  struct Box {
    double low_u, low_v, high_u, high_v;

    void extend(const Box& other) {
      *this = {std::min(low_u, other.low_u), std::min(low_v, other.low_v), std::max(high_u, other.high_u),
               std::max(high_v, other.high_v)};
    }
    bool meets(const Box& other) const {
      return low_u <= other.high_u && other.low_u <= high_u && low_v <= other.high_v && other.low_v <= high_v;
    }
  };
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  static constexpr Box kNowhere{kFar, kFar, -kFar, -kFar};
  static Box box_of(const Vector2& a, const Vector2& b);

  /// Visits chords whose boxes meet the given one, in order, until a visit says that it is enough; whether
  /// one did.
  template <typename Visit>
  bool visit_in(const Box& box, Visit enough) const;

  std::vector<TrimChord> chords_;
  /// The boxes of groups of neighbouring chords, then those of pairs of groups and so on up to one box for
  /// all: a complete binary tree whose root is the first and whose children of k are 2k + 1 and 2k + 2.
  std::vector<Box> boxes_;
  std::size_t first_leaf_ = 0;
};

}  // namespace lamina::engine
