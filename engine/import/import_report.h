#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lamina::engine {

/// The unit of length that a file states.
struct FileUnit {
  int flag = 0;              ///< IGES units flag, 1 to 11; 0 where there is none
  std::string name;          ///< as written in the file, such as "MM"
  double millimetres = 1.0;  ///< length of one unit, mm
};

/// Number of entities of one type.
struct EntityCount {
  int type = 0;
  std::string name;  ///< such as "rational B-spline surface"
  std::size_t count = 0;
};

/// Entities of one type that are not in the model, for one reason.
struct SkippedEntities {
  int type = 0;
  std::string name;
  std::string reason;
  std::size_t count = 0;
  std::size_t first_directory_line = 0;
};

/// A breach of the format that was read all the same.
struct ToleratedBreach {
  std::string what;
  std::string section;   ///< of the first time
  std::size_t line = 0;  ///< of the first time, in that section; 0 where it is about the file
  std::size_t count = 0;
};

/// What was found in a model file and what became of it. Every entity is either counted as used, by leading
/// to a surface of the model, or listed under `skipped`.
struct ImportReport {
  std::string format;  ///< such as "IGES"
  FileUnit unit;
  double model_scale = 1.0;     ///< model size / real size; lengths were divided by it
  double resolution = 0.0;      ///< smallest distance that the file tells apart, mm; 0 where it does not say
  double max_coordinate = 0.0;  ///< as the file states it, mm; 0 where it does not say
  std::string product;
  std::string system;
  std::string preprocessor;
  std::string author;
  std::string organization;
  std::vector<EntityCount> entities;       ///< every entity of the file, by type
  std::vector<EntityCount> surfaces;       ///< surfaces of the model, by type
  std::vector<SkippedEntities> skipped;    ///< by type, then reason
  std::vector<ToleratedBreach> tolerated;  ///< one entry per kind
  std::size_t line_count = 0;
};

}  // namespace lamina::engine
