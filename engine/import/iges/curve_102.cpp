#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/join.h"
#include "engine/nurbs/reverse.h"

namespace lamina::engine {
namespace {

Vector3 start_of(const NurbsCurve& curve) {
  return cartesian(curve.control_points.front());
}
Vector3 end_of(const NurbsCurve& curve) {
  return cartesian(curve.control_points.back());
}

bool is_point(const NurbsCurve& curve) {
  return std::all_of(curve.control_points.begin(), curve.control_points.end(),
                     [&](const Vector4& point) { return cartesian(point) == start_of(curve); });
}

double size_of(const std::vector<NurbsCurve>& pieces) {
  Box3 box;
  for (const NurbsCurve& piece : pieces) {
    for (const Vector4& point : piece.control_points) box.extend(cartesian(point));
  }
  return box.diagonal().norm();
}

}  // namespace

/// IGES 5.3, section 4.4: curves one after the other. Its parameter is the sum of theirs. Points among the
/// pieces only mark places and are passed over.
NurbsCurve read_composite_curve_102(ParameterRecord& record, EntityReader& reader) {
  const std::size_t count = record.count(1, "number of pieces");
  std::vector<NurbsCurve> pieces;
  for (std::size_t i = 0; i < count; ++i) {
    NurbsCurve piece = reader.curve(record, fmt::format("piece {}", i + 1));
    if (!is_point(piece)) pieces.push_back(std::move(piece));
  }
  if (pieces.empty()) record.fail("none of the pieces has any length");

  const double size = size_of(pieces);
  const double same_point = reader.same_point_distance(size);
  const auto gap = [&](const NurbsCurve& before, const NurbsCurve& after) {
    return (start_of(after) - end_of(before)).norm();
  };
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    double distance = gap(pieces[i - 1], pieces[i]);
    if (distance > same_point) {
      NurbsCurve backwards = reversed(pieces[i]);
      if (i == 1 && gap(reversed(pieces[0]), pieces[1]) <= same_point) {
        record.note(Tolerance::kReversedPiece, "1");
        pieces[0] = reversed(pieces[0]);
      } else if (gap(pieces[i - 1], backwards) <= same_point) {
        record.note(Tolerance::kReversedPiece, fmt::format("{}", i + 1));
        pieces[i] = std::move(backwards);
      }
      distance = gap(pieces[i - 1], pieces[i]);
    }
    reader.check_gap(record, fmt::format("pieces {} and {}", i, i + 1), distance, size);
  }
  int degree = 1;
  std::size_t points = 0;
  for (const NurbsCurve& piece : pieces) {
    degree = std::max(degree, piece.degree);
    points += piece.control_points.size();
  }
  reader.spend(record, points * static_cast<std::size_t>(degree));
  return joined(pieces);
}

}  // namespace lamina::engine
