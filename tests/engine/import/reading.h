#pragma once

#include <string>
#include <vector>

#include "engine/import/iges/read_iges.h"
#include "engine/import/import_error.h"
#include "engine/nurbs/curve.h"
#include "tests/engine/import/iges_writer.h"

namespace lamina::tests {

/// The file's only surface.
inline engine::NurbsSurface only_surface(const std::vector<IgesEntity>& entities,
                                         const IgesFrame& frame = {}) {
  return engine::read_iges(iges_text(entities, frame), "part.igs").model.surfaces.at(0).nurbs;
}

/// The curve of entity `index` as the reader makes it: the rail v = 0 of a cone over it, which is appended as
/// a ruled surface between the curve and a point. Its domain is mapped to [0, 1].
inline engine::NurbsCurve read_curve(std::vector<IgesEntity> entities, std::size_t index,
                                     const IgesFrame& frame = {}) {
  entities.push_back({116, "3.,4.,500.,0", 0, 0, "00010000"});
  const std::string rails = std::to_string(2 * index + 1) + "," + std::to_string(2 * entities.size() - 1);
  entities.push_back({118, rails + ",0,0", 1, 0, "00000000"});
  const engine::NurbsSurface cone = only_surface(entities, frame);
  engine::NurbsCurve curve{cone.degree_u, cone.knots_u, {}};
  for (std::size_t i = 0; i < cone.net.count_u; ++i) curve.control_points.push_back(cone.net.at(i, 0));
  return curve;
}

/// What reading says; empty where it does not fail.
inline std::string error_of(const std::string& text) {
  try {
    engine::read_iges(text, "part.igs");
  } catch (const engine::ImportError& error) {
    return error.what();
  }
  return {};
}

/// The report's list of tolerated breaches as one text.
inline std::string tolerated(const engine::ImportReport& report) {
  std::string text;
  for (const auto& breach : report.tolerated) {
    text += breach.what + " @" + breach.section + " " + std::to_string(breach.line) + " x" +
            std::to_string(breach.count) + "\n";
  }
  return text;
}

}  // namespace lamina::tests
