#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/import/import_report.h"
#include "engine/model.h"

namespace lamina::engine {

/// Name of an object in a 3MF package: identifiers count only inside their part (file of the archive).
struct ObjectName {
  std::string part;
  std::uint32_t id = 0;

  auto operator<=>(const ObjectName&) const = default;
};

/// An object placed inside another one, or on the build plate.
struct ObjectUse {
  ObjectName object;
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();  ///< translation in units of the part
  std::size_t line = 0;                                     ///< of the XML text
};

/// A mesh, or other objects in its place; mm.
struct PackageObject {
  TriangleMesh mesh;
  std::vector<ObjectUse> components;
  bool is_support = false;  ///< a support structure, or otherwise no part of the model
};

/// One model part of a 3MF package as it stands in the file.
struct ModelPart {
  FileUnit unit;
  std::map<std::uint32_t, PackageObject> objects;
  std::vector<ObjectUse> build;
};

}  // namespace lamina::engine
