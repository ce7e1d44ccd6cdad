#pragma once

#include <filesystem>
#include <memory>

#include "tools/bench/filled_section.h"

namespace lamina::tools {

/// Whether OpenCASCADE was found when this was built.
bool has_opencascade();

/// A model file as OpenCASCADE reads it, in mm: IGES, STEP, .brep, STL.
class OpencascadeModel {
 public:
  /// Throws std::runtime_error where OpenCASCADE cannot read the file.
  explicit OpencascadeModel(const std::filesystem::path& file);
  ~OpencascadeModel();

  /// Whether there are surfaces, and not triangles only.
  bool has_faces() const;

  /// The curves in which the plane at height z cuts the faces, one by one, as chords within `tolerance` (mm),
  /// by solid: BRepAlgoAPI_Section with approximated curves.
  LinesBySolid section_lines(double z, double tolerance) const;

  /// Makes triangles of the faces with BRepMesh, the chords within `tolerance` (mm).
  void make_triangles(double tolerance);
  /// Those, or a mesh file's own, cut by the plane at height z.
  LinesBySolid triangle_lines(double z) const;

 private:
  struct Shape;
  std::unique_ptr<Shape> shape_;
};

}  // namespace lamina::tools
