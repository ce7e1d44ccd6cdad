#include "engine/import/iges/entity_reader.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "engine/import/iges/entity_table.h"
#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

constexpr int kTransformType = 124;
constexpr int kDeepestNesting = 32;
constexpr std::size_t kSmallestBudget = 65536;

}  // namespace

/// Marks an entity as being read for as long as it lives.
class EntityReader::Nesting {
 public:
  Nesting(EntityReader& reader, std::size_t index) : reader_(reader), index_(index) {
    reader_.was_read_[index_] = true;
    reader_.is_open_[index_] = true;
    ++reader_.depth_;
  }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;
  ~Nesting() {
    --reader_.depth_;
    reader_.is_open_[index_] = false;
  }

 private:
  EntityReader& reader_;
  std::size_t index_;
};

EntityReader::EntityReader(const IgesFile& file, ToleranceLog& log)
    : file_(file),
      log_(log),
      was_read_(file.entries.size(), false),
      is_open_(file.entries.size(), false),
      // A control point takes 8 bytes of file at least ("1,0,0,0,"), a revolved one is made nine times.
      budget_(kSmallestBudget + file.records.line_count * 80) {}

NurbsSurface EntityReader::surface(std::size_t index) {
  const EntityType* type = find_entity_type(file_.entries[index].type);
  const Nesting nesting(*this, index);
  ParameterRecord record(file_, index, log_);
  NurbsSurface surface = type->read_surface(record, *this);
  spend(record, surface.net.points.size() + record.lines_read());
  surface.net.points = placed(std::move(surface.net.points), index);
  return surface;
}

/// The 124 that an entry names comes first, then the 124 which that one names, and so on (IGES 5.3,
/// section 4.21).
Eigen::Affine3d EntityReader::placement(std::size_t index) {
  const auto fail = [this](std::size_t at, const std::string& problem) {
    throw ImportError({.file = file_.name,
                       .section = "directory",
                       .line = lamina::engine::directory_line(at),
                       .entity_type = file_.entries[at].type,
                       .directory_line = lamina::engine::directory_line(at)},
                      problem);
  };
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
  std::size_t link = index;
  for (int length = 0; file_.entries[link].transform != 0; ++length) {
    const std::size_t pointer = file_.entries[link].transform;
    if (pointer % 2 == 0 || pointer > 2 * file_.entries.size() ||
        file_.entries[pointer / 2].type != kTransformType) {
      fail(link, fmt::format("its transformation pointer {} leads to no entity 124", pointer));
    }
    if (length == kDeepestNesting) {
      fail(index,
           fmt::format("its chain of transformations has more than {} links or closes on itself", length));
    }
    link = pointer / 2;
    if (!was_read_[link]) {
      ParameterRecord record(file_, link, log_);
      matrices_.emplace(link, read_transformation_matrix_124(record));
      was_read_[link] = true;
    }
    placement = matrices_.at(link) * placement;
  }
  return placement;
}

std::vector<Vector4> EntityReader::placed(std::vector<Vector4> points, std::size_t index) {
  if (file_.entries[index].transform == 0) return points;
  const Eigen::Affine3d moved = placement(index);
  for (Vector4& point : points) point = moved.matrix() * point;
  return points;
}

std::size_t EntityReader::begin_child(ParameterRecord& parent, std::string_view name) {
  const std::size_t pointer = parent.pointer(name);
  const std::size_t index = pointer / 2;
  if (is_open_[index]) {
    parent.fail(fmt::format("the {} points to directory line {}, which points back to it", name, pointer));
  }
  if (depth_ > kDeepestNesting)
    parent.fail(fmt::format("entities are nested deeper than {}", kDeepestNesting));
  return index;
}

NurbsCurve EntityReader::curve(ParameterRecord& parent, std::string_view name) {
  const std::size_t index = begin_child(parent, name);
  const EntityType* type = find_entity_type(file_.entries[index].type);
  if (type == nullptr || type->read_curve == nullptr) {
    parent.fail(fmt::format("the {} is entity {} (directory line {}), which cannot be read as a curve", name,
                            file_.entries[index].type, lamina::engine::directory_line(index)));
  }
  const Nesting nesting(*this, index);
  ParameterRecord record(file_, index, log_);
  NurbsCurve curve = type->read_curve(record, *this);
  spend(record, curve.control_points.size() + record.lines_read());
  curve.control_points = placed(std::move(curve.control_points), index);
  return curve;
}

EntityReader::Axis EntityReader::axis(ParameterRecord& parent, std::string_view name) {
  constexpr int kLineType = 110;
  const std::size_t index = begin_child(parent, name);
  if (file_.entries[index].type != kLineType) {
    parent.fail(fmt::format("the {} is entity {} (directory line {}), and must be a line 110", name,
                            file_.entries[index].type, lamina::engine::directory_line(index)));
  }
  const Nesting nesting(*this, index);
  ParameterRecord record(file_, index, log_);
  const Vector3 start = record.vector("start point");
  const Vector3 end = record.vector("end point");
  const std::vector<Vector4> points = placed({homogeneous(start), homogeneous(end)}, index);
  return {cartesian(points[0]), cartesian(points[1])};
}

double EntityReader::same_point_distance(double size) const {
  constexpr double kRounding = 1e-9;
  constexpr double kLargest = 1e-3;
  return std::clamp(file_.global.resolution, kRounding * size, kLargest * size);
}

void EntityReader::check_gap(ParameterRecord& record, std::string_view parts, double gap, double size) const {
  constexpr double kLargest = 0.01;
  if (!(gap <= kLargest * size)) record.fail(fmt::format("{} do not meet: the gap is {:.6g}", parts, gap));
  if (gap > same_point_distance(size)) record.note(Tolerance::kJointGap, fmt::format("{:.6g}", gap));
}

void EntityReader::spend(const ParameterRecord& record, std::size_t points) {
  if (points > budget_) {
    record.fail("the entities up to here unfold to more control points than a file of this size can mean",
                "entities refer to each other too often");
  }
  budget_ -= points;
}

}  // namespace lamina::engine
