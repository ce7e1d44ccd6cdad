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

EntityReader::Nesting::Nesting(EntityReader& reader, std::size_t index) : reader_(reader), index_(index) {
  reader_.was_read_[index_] = true;
  reader_.is_open_[index_] = true;
  ++reader_.depth_;
}

EntityReader::Nesting::~Nesting() {
  --reader_.depth_;
  reader_.is_open_[index_] = false;
}

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

void EntityReader::place(TrimmedPatch& patch, std::size_t index) {
  patch.nurbs.net.points = placed(std::move(patch.nurbs.net.points), index);
}

void EntityReader::fail_child(const ParameterRecord& parent, std::string_view name, std::size_t index,
                              std::string_view wanted) const {
  parent.fail(fmt::format("the {} is entity {} (directory line {}), and must {}", name,
                          file_.entries[index].type, lamina::engine::directory_line(index), wanted));
}

std::size_t EntityReader::checked_child(ParameterRecord& parent, std::string_view name, std::size_t pointer) {
  const std::size_t index = pointer / 2;
  if (is_open_[index]) {
    parent.fail(fmt::format("the {} points to directory line {}, which points back to it", name, pointer));
  }
  if (depth_ > kDeepestNesting)
    parent.fail(fmt::format("entities are nested deeper than {}", kDeepestNesting));
  return index;
}

std::size_t EntityReader::child(ParameterRecord& parent, std::string_view name) {
  return checked_child(parent, name, parent.pointer(name));
}

std::optional<std::size_t> EntityReader::child_or_none(ParameterRecord& parent, std::string_view name) {
  const std::size_t pointer = parent.pointer_or_none(name);
  if (pointer == 0) return std::nullopt;
  return checked_child(parent, name, pointer);
}

std::vector<TrimmedPatch> EntityReader::faces(std::size_t index) {
  const EntityType* type = find_entity_type(file_.entries[index].type);
  if (type == nullptr || !type->is_shape()) return {};
  if (type->read_faces == nullptr) return {{surface(index), {}}};
  const Nesting nesting(*this, index);
  ParameterRecord record(file_, index, log_);
  std::vector<TrimmedPatch> patches = type->read_faces(record, *this);
  spend(record, record.lines_read());
  for (TrimmedPatch& patch : patches) place(patch, index);
  return patches;
}

NurbsSurface EntityReader::surface_of_face(ParameterRecord& parent, std::size_t index,
                                           const std::vector<Vector3>& cover) {
  const EntityType* type = find_entity_type(file_.entries[index].type);
  if (type != nullptr && type->read_surface != nullptr) return surface(index);
  if (type == nullptr || type->read_unbounded == nullptr)
    fail_child(parent, "surface", index, "be a surface");
  const Nesting nesting(*this, index);
  ParameterRecord record(file_, index, log_);
  const Eigen::Affine3d back = placement(index).inverse();
  std::vector<Vector3> points;
  points.reserve(cover.size());
  for (const Vector3& point : cover) points.push_back(back * point);
  NurbsSurface surface = type->read_unbounded(record, *this, points);
  surface.net.points = placed(std::move(surface.net.points), index);
  return surface;
}

NurbsCurve EntityReader::curve(ParameterRecord& parent, std::string_view name) {
  const std::size_t index = child(parent, name);
  const EntityType* type = find_entity_type(file_.entries[index].type);
  if (type == nullptr || type->read_curve == nullptr) {
    parent.fail(fmt::format("the {} is entity {} (directory line {}), which cannot be read as a curve", name,
                            file_.entries[index].type, lamina::engine::directory_line(index)));
  }
  return curve(parent, index);
}

NurbsCurve EntityReader::curve(ParameterRecord& parent, std::size_t index) {
  const EntityType* type = find_entity_type(file_.entries[index].type);
  if (type == nullptr || type->read_curve == nullptr) fail_child(parent, "curve", index, "be a curve");
  const Nesting nesting(*this, index);
  ParameterRecord record(file_, index, log_);
  NurbsCurve curve = type->read_curve(record, *this);
  spend(record, curve.control_points.size() + record.lines_read());
  curve.control_points = placed(std::move(curve.control_points), index);
  return curve;
}

std::vector<NurbsCurve> EntityReader::pieces(ParameterRecord& parent, std::size_t index) {
  constexpr int kCompositeType = 102;
  if (file_.entries[index].type != kCompositeType) return {curve(parent, index)};
  return part(parent, index, kCompositeType, [&](ParameterRecord& record) {
    std::vector<NurbsCurve> all;
    const std::size_t count = record.count(1, "number of pieces");
    for (std::size_t i = 0; i < count; ++i) {
      for (NurbsCurve& piece : pieces(record, child(record, "piece"))) {
        piece.control_points = placed(std::move(piece.control_points), index);
        all.push_back(std::move(piece));
      }
    }
    return all;
  });
}

std::vector<NurbsCurve> EntityReader::edge(ParameterRecord& parent, std::size_t list, int number) {
  constexpr int kEdgeList = 504;
  auto known = edge_lists_.find(list);
  if (known == edge_lists_.end()) {
    std::vector<std::size_t> curves = part(parent, list, kEdgeList, [&](ParameterRecord& record) {
      std::vector<std::size_t> found;
      const std::size_t count = record.count(1, "number of edges");
      for (std::size_t i = 0; i < count; ++i) {
        found.push_back(child(record, "curve of an edge"));
        record.skip(4);  // the vertices at both ends
      }
      return found;
    });
    known = edge_lists_.emplace(list, std::move(curves)).first;
  }
  if (number < 1 || static_cast<std::size_t>(number) > known->second.size()) {
    parent.fail(
        fmt::format("the number of an edge is {}, and its list has {}", number, known->second.size()));
  }
  return pieces(parent, known->second[static_cast<std::size_t>(number) - 1]);
}

EntityReader::Axis EntityReader::axis(ParameterRecord& parent, std::string_view name) {
  constexpr int kLineType = 110;
  const std::size_t index = child(parent, name);
  if (file_.entries[index].type != kLineType) fail_child(parent, name, index, "be a line 110");
  return part(parent, index, kLineType, [&](ParameterRecord& record) {
    const Vector3 start = record.vector("start point");
    const Vector3 end = record.vector("end point");
    const std::vector<Vector4> points = placed({homogeneous(start), homogeneous(end)}, index);
    return Axis{cartesian(points[0]), cartesian(points[1])};
  });
}

Vector3 EntityReader::point(ParameterRecord& parent, std::string_view name) {
  constexpr int kPointType = 116;
  const std::size_t index = child(parent, name);
  if (file_.entries[index].type != kPointType) fail_child(parent, name, index, "be a point 116");
  return part(parent, index, kPointType,
              [&](ParameterRecord& record) { return Vector3(placement(index) * record.vector("point")); });
}

Vector3 EntityReader::direction(ParameterRecord& parent, std::string_view name) {
  constexpr int kDirectionType = 123;
  const std::size_t index = child(parent, name);
  if (file_.entries[index].type != kDirectionType) fail_child(parent, name, index, "be a direction 123");
  return part(parent, index, kDirectionType, [&](ParameterRecord& record) {
    const Vector3 direction = placement(index).linear() * record.vector("direction");
    if (!(direction.norm() > 0.0)) record.fail("the direction has no length");
    return Vector3(direction.normalized());
  });
}

double EntityReader::same_point_distance(double size) const {
  constexpr double kRounding = 1e-9;
  constexpr double kLargest = 1e-3;
  return std::clamp(file_.global.resolution, kRounding * size, kLargest * size);
}

double EntityReader::trim_tolerance(double size) const {
  constexpr double kFinest = 1e-7;
  constexpr double kCoarsest = 1e-5;
  return std::clamp(file_.global.resolution, kFinest * size, kCoarsest * size);
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
