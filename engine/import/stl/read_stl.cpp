#include "engine/import/stl/read_stl.h"

#include <algorithm>

#include "engine/import/import_error.h"
#include "engine/import/mesh/text_cursor.h"
#include "engine/import/stl/stl_forms.h"

namespace lamina::engine {
namespace {

bool has_binary_size(std::string_view bytes) {
  return bytes.size() >= kBinaryStlHeader &&
         bytes.size() == kBinaryStlHeader + std::size_t{binary_stl_count(bytes)} * kBinaryStlFacet;
}

/// Whether the beginning reads like text STL: solid, a name, and then a facet or the end.
bool has_text_beginning(std::string_view bytes) {
  constexpr std::size_t kLongEnough = 4096;
  const std::string_view head = bytes.substr(0, kLongEnough);
  const bool has_control = std::any_of(head.begin(), head.end(), [](char c) {
    return static_cast<unsigned char>(c) < 32 && c != '\t' && c != '\n' && c != '\r';
  });
  if (has_control) return false;
  TextCursor cursor(head);
  std::string_view word = cursor.word_across_lines();
  if (word != "solid" && word != "SOLID" && word != "Solid") return false;
  while (cursor.next_line()) {
    word = cursor.word_across_lines();
    if (word.substr(0, 5) == "facet" || word.substr(0, 5) == "FACET" || word.substr(0, 5) == "Facet")
      return true;
    if (word == "endsolid" || word == "ENDSOLID") return true;
  }
  return false;
}

}  // namespace

bool looks_like_stl(std::string_view bytes) {
  return (has_binary_size(bytes) && bytes.size() > kBinaryStlHeader) || has_text_beginning(bytes);
}

ImportResult read_stl(std::string_view bytes, const std::string& file) {
  const bool is_text = !has_binary_size(bytes) && has_text_beginning(bytes);
  if (!is_text && bytes.size() < kBinaryStlHeader) {
    throw ImportError({.file = file}, "is no STL file: too short for one, and not of its text form",
                      "export it again");
  }
  BreachLog log;
  ImportResult result;
  result.model.name = file;
  TriangleMesh mesh = is_text ? read_text_stl(bytes, file, log) : read_binary_stl(bytes, file, log);
  if (mesh.facets.empty()) {
    throw ImportError({.file = file}, "nothing to slice: the file holds no usable facet");
  }
  result.model.meshes.push_back(std::move(mesh));
  result.report.format = is_text ? "STL (text)" : "STL (binary)";
  result.report.tolerated = log.list();
  return result;
}

}  // namespace lamina::engine
