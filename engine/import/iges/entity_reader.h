#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/geometry/vector.h"
#include "engine/import/iges/iges_file.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/import/iges/tolerance_log.h"
#include "engine/import/trim/trimmed_patch.h"
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

  /// What entity `index`, a surface or made of faces, adds to a model.
  std::vector<TrimmedPatch> faces(std::size_t index);

  /// The entity, by index, to which the next parameter of `parent` points. Throws ImportError where it leads
  /// back to an entity that is being read, or too deep.
  std::size_t child(ParameterRecord& parent, std::string_view name);

  /// The same where there may be none.
  std::optional<std::size_t> child_or_none(ParameterRecord& parent, std::string_view name);

  const DirectoryEntry& entry(std::size_t index) const { return file_.entries[index]; }

  /// Parameters of a child that is no curve or surface, such as a loop: `read` is given its record. The child
  /// must be of type `type`.
  template <typename Read>
  auto part(ParameterRecord& parent, std::size_t index, int type, const Read& read);

  /// The surface of a face: `cover` are points that an unbounded one must reach around.
  NurbsSurface surface_of_face(ParameterRecord& parent, std::size_t index, const std::vector<Vector3>& cover);

  /// The curve to which the next parameter of `parent` points, clamped. Throws ImportError where it points to
  /// something else or back to an entity that is being read.
  NurbsCurve curve(ParameterRecord& parent, std::string_view name);
  NurbsCurve curve(ParameterRecord& parent, std::size_t index);

  /// The same, a composite curve as its pieces, which need not meet.
  std::vector<NurbsCurve> pieces(ParameterRecord& parent, std::size_t index);

  /// The curve of edge `number` (from 1) of an edge list (504), in pieces.
  std::vector<NurbsCurve> edge(ParameterRecord& parent, std::size_t list, int number);

  /// A straight line's two points: an axis. The next parameter of `parent` points to it.
  struct Axis {
    Vector3 start;
    Vector3 end;
  };
  Axis axis(ParameterRecord& parent, std::string_view name);

  /// The point 116 or the direction 123, of length 1, to which the next parameter of `parent` points.
  Vector3 point(ParameterRecord& parent, std::string_view name);
  Vector3 direction(ParameterRecord& parent, std::string_view name);

  /// Whether entity `index` was read, by itself or for another one.
  bool was_read(std::size_t index) const { return was_read_[index]; }

  /// Points closer than this count as one: the file's resolution, file units, bounded by 1e-3 of `size`.
  double same_point_distance(double size) const;

  /// Accuracy of the trim loops of a face of that `size`, file units: the file's resolution within bounds.
  double trim_tolerance(double size) const;

  /// Judges the gap between parts of a curve or surface of a certain `size` that should meet: noted where
  /// they do not, ImportError where it is more than a hundredth of the size.
  void check_gap(ParameterRecord& record, std::string_view parts, double gap, double size) const;

  /// Counts `points` control points, or as much work, that are about to be made for the entity of `record`.
  /// Throws ImportError where the file makes more than its size can justify.
  void spend(const ParameterRecord& record, std::size_t points);

 private:
  /// Marks an entity as being read for as long as it lives.
  class Nesting {
   public:
    Nesting(EntityReader& reader, std::size_t index);
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;
    ~Nesting();

   private:
    EntityReader& reader_;
    std::size_t index_;
  };

  Eigen::Affine3d placement(std::size_t index);
  void place(TrimmedPatch& patch, std::size_t index);
  [[noreturn]] void fail_child(const ParameterRecord& parent, std::string_view name, std::size_t index,
                               std::string_view wanted) const;
  std::vector<Vector4> placed(std::vector<Vector4> points, std::size_t index);
  std::size_t checked_child(ParameterRecord& parent, std::string_view name, std::size_t pointer);

  const IgesFile& file_;
  ToleranceLog& log_;
  std::vector<bool> was_read_;
  std::vector<bool> is_open_;                        ///< being read: pointing to it would be a cycle
  std::map<std::size_t, Eigen::Affine3d> matrices_;  ///< 124 entities read so far, by index
  std::map<std::size_t, std::vector<std::size_t>> edge_lists_;  ///< curves of 504 entities read so far
  int depth_ = 0;
  std::size_t budget_;
};

template <typename Read>
auto EntityReader::part(ParameterRecord& parent, std::size_t index, int type, const Read& read) {
  if (file_.entries[index].type != type)
    fail_child(parent, "part", index, fmt::format("be of type {}", type));
  const Nesting nesting(*this, index);
  ParameterRecord record(file_, index, log_);
  auto result = read(record);
  spend(record, record.lines_read());
  return result;
}

}  // namespace lamina::engine
