#pragma once

#include <cstddef>
#include <map>
#include <string_view>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/import/iges/iges_file.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/import/iges/tolerance_log.h"
#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// Reads the entities of one file, file units. Entities that refer to others get these through here, already
/// placed by their own transformations. Keeps the recursion shallow, and the work within a multiple of the
/// file's size.
class EntityReader {
 public:
  /// Both must outlive the reader.
  EntityReader(const IgesFile& file, ToleranceLog& log);

  /// The surface that entity `index` describes; its type must be one that the entity table can read as a
  /// surface.
  NurbsSurface surface(std::size_t index);

  /// The curve to which the next parameter of `parent` points, clamped. Throws ImportError where it points to
  /// something else or back to an entity that is being read.
  NurbsCurve curve(ParameterRecord& parent, std::string_view name);

  /// A straight line's two points: an axis. The next parameter of `parent` points to it.
  struct Axis {
    Vector3 start;
    Vector3 end;
  };
  Axis axis(ParameterRecord& parent, std::string_view name);

  /// Whether entity `index` was read, by itself or for another one.
  bool was_read(std::size_t index) const { return was_read_[index]; }

  /// Points closer than this count as one: the file's resolution, file units, bounded by 1e-3 of `size`.
  double same_point_distance(double size) const;

  /// Judges the gap between parts of a curve or surface of a certain `size` that should meet: noted where
  /// they do not, ImportError where it is more than a hundredth of the size.
  void check_gap(ParameterRecord& record, std::string_view parts, double gap, double size) const;

  /// Counts `points` control points, or as much work, that are about to be made for the entity of `record`.
  /// Throws ImportError where the file makes more than its size can justify.
  void spend(const ParameterRecord& record, std::size_t points);

 private:
  class Nesting;

  Eigen::Affine3d placement(std::size_t index);
  std::vector<Vector4> placed(std::vector<Vector4> points, std::size_t index);
  std::size_t begin_child(ParameterRecord& parent, std::string_view name);

  const IgesFile& file_;
  ToleranceLog& log_;
  std::vector<bool> was_read_;
  std::vector<bool> is_open_;                        ///< being read: pointing to it would be a cycle
  std::map<std::size_t, Eigen::Affine3d> matrices_;  ///< 124 entities read so far, by index
  int depth_ = 0;
  std::size_t budget_;
};

}  // namespace lamina::engine
