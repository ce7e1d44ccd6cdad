#include "engine/pointcloud/trim_chords.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "engine/geometry/cross_product.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kChordsInLeaf = 4;
constexpr std::size_t kSidesInRun = 16;
constexpr std::size_t kFewCrossings = 8;

/// Appends where the side of a line from `from` to `to` meets a chord. A chord counts as its points beyond
/// the line and one of its ends, so that a crossing at a vertex of the loop is found once.
void cross_chord(const Vector2& from, const Vector2& to, std::size_t side, const TrimChord& chord,
                 std::vector<TrimCrossing>& found) {
  const Vector2 line = to - from;
  const double side_a = cross(line, chord.a - from);
  const double side_b = cross(line, chord.b - from);
  if ((side_a > 0.0) == (side_b > 0.0)) return;
  const Vector2 way = chord.b - chord.a;
  const double determinant = cross(line, way);
  if (determinant == 0.0) return;
  const double along = cross(chord.a - from, way) / determinant;
  if (along >= 0.0 && along <= 1.0)
    found.push_back({side, along, chord.edge, chord.sample, side_a / (side_a - side_b)});
}

}  // namespace

TrimChords::Box TrimChords::box_of(const Vector2& a, const Vector2& b) {
  return {std::min(a.x(), b.x()), std::min(a.y(), b.y()), std::max(a.x(), b.x()), std::max(a.y(), b.y())};
}

TrimChords::TrimChords(std::vector<TrimChord> chords) : chords_(std::move(chords)) {
  const std::size_t leaves = std::bit_ceil((chords_.size() + kChordsInLeaf - 1) / kChordsInLeaf);
  first_leaf_ = leaves - 1;
  boxes_.assign(first_leaf_ + leaves, kNowhere);
  for (std::size_t c = 0; c < chords_.size(); ++c)
    boxes_[first_leaf_ + c / kChordsInLeaf].extend(box_of(chords_[c].a, chords_[c].b));
  for (std::size_t k = boxes_.size() - 1; k > 0; --k) boxes_[(k - 1) / 2].extend(boxes_[k]);
}

template <typename Visit>
bool TrimChords::visit_in(const Box& box, Visit enough) const {
  const auto descend = [&](auto&& self, std::size_t branch) -> bool {
    if (!boxes_[branch].meets(box)) return false;
    if (branch < first_leaf_) return self(self, 2 * branch + 1) || self(self, 2 * branch + 2);
    const std::size_t first = (branch - first_leaf_) * kChordsInLeaf;
    const std::size_t last = std::min(first + kChordsInLeaf, chords_.size());
    for (std::size_t c = first; c < last; ++c) {
      const Box around = box_of(chords_[c].a, chords_[c].b);
      if (around.meets(box) && enough(chords_[c], around)) return true;
    }
    return false;
  };
  return !boxes_.empty() && descend(descend, 0);
}

bool TrimChords::contains(const Vector2& place) const {
  if (boxes_.empty() || !boxes_.front().meets(box_of(place, place))) return false;
  // Chords that a ray along u crosses, to the nearer side.
  const bool to_low = place.x() - boxes_.front().low_u < boxes_.front().high_u - place.x();
  bool inside = false;
  visit_in({to_low ? -kFar : place.x(), place.y(), to_low ? place.x() : kFar, place.y()},
           [&](const TrimChord& chord, const Box&) {
             const Vector2& a = chord.a;
             const Vector2& b = chord.b;
             if ((a.y() > place.y()) == (b.y() > place.y())) return false;
             const double u = (b.x() - a.x()) * (place.y() - a.y()) / (b.y() - a.y()) + a.x();
             if (to_low ? u <= place.x() : u > place.x()) inside = !inside;
             return false;
           });
  return inside;
}

TrimPlace TrimChords::place_of(const Vector2& low, const Vector2& high) const {
  if (visit_in(box_of(low, high), [](const TrimChord&, const Box&) { return true; })) return TrimPlace::kCut;
  return contains(0.5 * (low + high)) ? TrimPlace::kInside : TrimPlace::kOutside;
}

std::vector<TrimCrossing> TrimChords::crossings(const std::vector<Vector2>& line) const {
  std::vector<TrimCrossing> found;
  found.reserve(kFewCrossings);
  std::array<Box, kSidesInRun> sides;
  for (std::size_t first = 0; first + 1 < line.size(); first += kSidesInRun) {
    const std::size_t count = std::min(kSidesInRun, line.size() - 1 - first);
    Box run = kNowhere;
    for (std::size_t k = 0; k < count; ++k) {
      sides[k] = box_of(line[first + k], line[first + k + 1]);
      run.extend(sides[k]);
    }
    visit_in(run, [&](const TrimChord& chord, const Box& box) {
      for (std::size_t k = 0; k < count; ++k) {
        if (sides[k].meets(box)) cross_chord(line[first + k], line[first + k + 1], first + k, chord, found);
      }
      return false;
    });
  }
  std::sort(found.begin(), found.end(), [](const TrimCrossing& a, const TrimCrossing& b) {
    return std::pair(a.side, a.along) < std::pair(b.side, b.along);
  });
  return found;
}

}  // namespace lamina::engine
