#include "engine/import/iges/parameter_map.h"

#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {
namespace {

constexpr int kArc = 100;
constexpr int kComposite = 102;
constexpr int kConic = 104;
constexpr int kSpline = 126;
constexpr int kRevolution = 120;
constexpr int kTabulated = 122;

/// Whether a curve's parameter is an angle on pieces of it, so that weights like those of an arc mean one.
bool has_angles(EntityReader& reader, ParameterRecord& parent, std::size_t index) {
  const int type = reader.entry(index).type;
  if (type == kArc || type == kConic) return true;
  if (type != kComposite) return false;
  return reader.part(parent, index, kComposite, [&](ParameterRecord& record) {
    bool found = false;
    const std::size_t count = record.count(1, "number of pieces");
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t piece = reader.child(record, "piece");
      if (reader.entry(piece).type == kSpline) return false;
      found = found || has_angles(reader, record, piece);
    }
    return found;
  });
}

}  // namespace

ParameterMap parameter_map(EntityReader& reader, ParameterRecord& parent, std::size_t index,
                           const NurbsSurface& surface) {
  const int type = reader.entry(index).type;
  if (type != kRevolution && type != kTabulated) return {};
  return reader.part(parent, index, type, [&](ParameterRecord& record) {
    ParameterMap map;
    if (type == kRevolution) {
      record.skip(1);  // axis
      map.v = angle_map_v(surface);
    }
    if (has_angles(reader, record, reader.child(record, "curve"))) map.u = angle_map_u(surface);
    return map;
  });
}

}  // namespace lamina::engine
