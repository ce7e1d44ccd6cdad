#include "engine/import/iges/read_iges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_table.h"
#include "engine/import/iges/iges_file.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/import/iges/units.h"
#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

/// Coordinates beyond this (a thousand kilometres) are no model.
constexpr double kLargestCoordinate = 1e9;

/// What other entities say about entities.
struct References {
  std::vector<bool> is_owned;    ///< the base of a trimmed surface, a part of a solid or a subfigure
  std::vector<bool> is_grouped;  ///< named by a group (402)
};

/// Entities that belong to another one must not be sliced on their own, whatever their status says.
References find_references(const IgesFile& file, EntityReader& reader, ToleranceLog& log) {
  constexpr int kGroupType = 402;
  constexpr std::array<int, 4> kGroupForms{1, 7, 14, 15};
  constexpr OwnedParameters kGroupMembers{.first = 2, .counted_by = 1};
  References references{std::vector<bool>(file.entries.size(), false),
                        std::vector<bool>(file.entries.size(), false)};
  for (std::size_t i = 0; i < file.entries.size(); ++i) {
    const DirectoryEntry& entry = file.entries[i];
    const bool is_group = entry.type == kGroupType &&
                          std::find(kGroupForms.begin(), kGroupForms.end(), entry.form) != kGroupForms.end();
    const EntityType* type = find_entity_type(entry.type);
    if (type == nullptr || (type->owned.first == 0 && !is_group)) continue;
    const OwnedParameters& owned = is_group ? kGroupMembers : type->owned;
    std::vector<bool>& named = is_group ? references.is_grouped : references.is_owned;
    ParameterRecord record(file, i, log);
    std::size_t position = 1;  // of the next parameter
    const auto skip_to = [&](std::size_t wanted) {
      record.skip(wanted - position);
      position = wanted + 1;
    };
    if (owned.alone != 0) {
      skip_to(owned.alone);
      named[record.pointer("part") / 2] = true;
    }
    std::size_t count = 1;
    if (owned.counted_by != 0) {
      skip_to(owned.counted_by);
      count = record.count(0, "number of parts");
    }
    for (std::size_t k = 0; k < count; ++k) {
      skip_to(owned.first + k * owned.stride);
      const std::size_t pointer = record.pointer_or_none("part");
      if (pointer != 0) named[pointer / 2] = true;
    }
    reader.spend(record, record.lines_read());
  }
  return references;
}

/// Why an entity that can be read as a surface is none of the model by itself; empty where it is.
std::string_view reason_to_skip(const DirectoryEntry& entry, bool is_owned, bool is_grouped, bool is_face) {
  if (is_owned) return "part of another entity that is left out";
  // Groups call their members dependent; so do some writers with faces that nothing owns.
  if (entry.is_physically_dependent && !is_grouped && !is_face)
    return "part of another entity that is left out";
  if (entry.is_blanked) return "blanked";
  if (entry.use != EntityUse::kGeometry) return "not of geometry use (entity use flag)";
  return {};
}

/// Why an entity that is no surface, and that no surface was made of, is left out.
std::string_view reason_to_skip_other(const DirectoryEntry& entry, const EntityType* type) {
  constexpr int kTransformType = 124;
  constexpr int kDirectionType = 123;
  constexpr int kExternalType = 416;
  if (entry.type == kTransformType || entry.type == kDirectionType) return "not used by a surface";
  if (entry.type == kExternalType) return "in another file, which is not read";
  if (type != nullptr && type->read_unbounded != nullptr) return "has no bounds";
  if (type == nullptr || type->read_curve == nullptr) return "no shape";
  return "not used by a surface";
}

/// Collects counts by type and reason; sorted, so that the report does not depend on anything but the file.
class Tally {
 public:
  void add(int type, std::string_view reason, std::size_t line) {
    auto& entry = counts_[{type, std::string(reason)}];
    if (entry.first++ == 0) entry.second = line;
  }

  std::vector<SkippedEntities> skipped() const {
    std::vector<SkippedEntities> list;
    for (const auto& [key, entry] : counts_) {
      list.push_back({key.first, std::string(entity_name(key.first)), key.second, entry.first, entry.second});
    }
    return list;
  }

  std::vector<EntityCount> counts() const {
    std::vector<EntityCount> list;
    for (const auto& [key, entry] : counts_) {
      list.push_back({key.first, std::string(entity_name(key.first)), entry.first});
    }
    return list;
  }

 private:
  std::map<std::pair<int, std::string>, std::pair<std::size_t, std::size_t>> counts_;
};

/// Surface in mm. Throws unless every control point is finite, within bounds and of positive weight.
NurbsSurface in_millimetres(NurbsSurface surface, double factor, const IgesFile& file, std::size_t index) {
  for (Vector4& point : surface.net.points) {
    point.head<3>() *= factor;
    const double largest = point.head<3>().cwiseAbs().maxCoeff();
    if (point.allFinite() && point.w() > 0.0 && largest <= kLargestCoordinate * point.w()) continue;
    throw ImportError({.file = file.name,
                       .section = "directory",
                       .line = directory_line(index),
                       .entity_type = file.entries[index].type,
                       .directory_line = directory_line(index)},
                      fmt::format("a coordinate is {:.6g} mm, and must be within {:.0e}", largest / point.w(),
                                  kLargestCoordinate),
                      "check the unit of the file");
  }
  return surface;
}

std::string list_of(const std::vector<EntityCount>& entities) {
  std::string text;
  for (const EntityCount& entity : entities) {
    text += fmt::format("{}{} x {} {}", text.empty() ? "" : ", ", entity.count, entity.type, entity.name);
  }
  return text;
}

IgesFile parse_file(std::string_view bytes, const std::string& name, ToleranceLog& log) {
  IgesFile file;
  file.name = name;
  file.records = split_records(bytes, name, log);
  file.global = parse_global_section(file.records.global, name, log);
  file.entries = parse_directory(file.records.directory, name, log);
  return file;
}

void check_anything_made(const ImportResult& result, const IgesFile& file) {
  if (!result.model.surfaces.empty()) return;
  std::string left_out;
  for (const SkippedEntities& skipped : result.report.skipped) {
    const EntityType* type = find_entity_type(skipped.type);
    if (type == nullptr || !type->is_shape()) continue;
    left_out += fmt::format("; {} x {} left out: {}", skipped.count, skipped.type, skipped.reason);
  }
  throw ImportError(
      {.file = file.name},
      fmt::format("nothing to slice: the file holds {}{}", list_of(result.report.entities), left_out),
      "export surfaces, trimmed surfaces or solids");
}

}  // namespace

bool looks_like_iges(std::string_view bytes) {
  if (bytes.size() < kContentColumns + 1) return false;
  const std::string_view first_line = bytes.substr(0, 80);
  const bool has_letter =
      std::string_view("SGBC").find(first_line[kContentColumns]) != std::string_view::npos;
  return has_letter &&
         first_line.substr(0, kContentColumns).find_first_of("\r\n") == std::string_view::npos &&
         first_line.substr(kContentColumns + 1).find_first_not_of(" 0123456789\r\n") ==
             std::string_view::npos;
}

ImportResult read_iges(std::string_view bytes, const std::string& name) {
  ToleranceLog log;
  const IgesFile file = parse_file(bytes, name, log);

  ImportResult result;
  ImportReport& report = result.report;
  report.format = "IGES";
  report.unit = file_unit(file.global, name, log);
  report.model_scale = file.global.model_scale;
  const double factor = report.unit.millimetres / file.global.model_scale;
  report.resolution = file.global.resolution * factor;
  report.max_coordinate = file.global.max_coordinate * factor;
  report.product = file.global.product;
  report.system = file.global.system;
  report.preprocessor = file.global.preprocessor;
  report.author = file.global.author;
  report.organization = file.global.organization;
  report.line_count = file.records.line_count;

  result.model.name = name;
  Tally entities;
  Tally made;
  Tally skipped;
  EntityReader reader(file, log);
  const References references = find_references(file, reader, log);
  std::uint32_t solid_count = 0;
  for (std::size_t i = 0; i < file.entries.size(); ++i) {
    const DirectoryEntry& entry = file.entries[i];
    entities.add(entry.type, {}, directory_line(i));
    const EntityType* type = find_entity_type(entry.type);
    if (type == nullptr || !type->is_shape()) continue;
    const bool is_face = type->read_faces != nullptr;
    if (!reason_to_skip(entry, references.is_owned[i], references.is_grouped[i], is_face).empty()) continue;
    constexpr int kSolid = 186;
    const std::uint32_t solid = entry.type == kSolid ? ++solid_count : 0;
    for (TrimmedPatch& patch : reader.faces(i)) {
      result.model.surfaces.push_back({in_millimetres(std::move(patch.nurbs), factor, file, i),
                                       std::move(patch.trim), entry.type, static_cast<int>(directory_line(i)),
                                       solid});
      made.add(entry.type, {}, directory_line(i));
    }
  }
  for (std::size_t i = 0; i < file.entries.size(); ++i) {
    if (reader.was_read(i)) continue;
    const DirectoryEntry& entry = file.entries[i];
    const EntityType* type = find_entity_type(entry.type);
    const std::string_view reason =
        type != nullptr && type->is_shape()
            ? reason_to_skip(entry, references.is_owned[i], references.is_grouped[i],
                             type->read_faces != nullptr)
            : reason_to_skip_other(entry, type);
    skipped.add(entry.type, reason, directory_line(i));
  }
  report.entities = entities.counts();
  report.surfaces = made.counts();
  report.skipped = skipped.skipped();
  report.tolerated = log.list();
  check_anything_made(result, file);
  return result;
}

}  // namespace lamina::engine
