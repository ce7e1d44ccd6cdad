#include <optional>
#include <vector>

#include <fmt/format.h>

#include "engine/import/import_error.h"
#include "engine/import/mesh/coordinate.h"
#include "engine/import/mesh/text_cursor.h"
#include "engine/import/mesh/vertex_welder.h"
#include "engine/import/stl/stl_forms.h"

namespace lamina::engine {
namespace {

constexpr char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool is_word(std::string_view word, std::string_view lower_case) {
  if (word.size() != lower_case.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (lower(word[i]) != lower_case[i]) return false;
  }
  return true;
}

/// Reads the words of a text STL one after the other.
class TextStlReader {
 public:
  TextStlReader(std::string_view text, const std::string& file, BreachLog& log)
      : cursor_(text), file_(file), log_(log) {}

  TriangleMesh read() {
    bool is_open = false;
    for (std::string_view word = cursor_.word_across_lines(); !word.empty();
         word = cursor_.word_across_lines()) {
      if (is_word(word, "facet")) {
        facet();
      } else if (is_word(word, "solid") || is_word(word, "endsolid")) {
        is_open = is_word(word, "solid");
        cursor_.next_line();  // its name
      } else {
        fail(fmt::format("\"{}\" stands where a facet or endsolid should", word.substr(0, 40)));
      }
    }
    if (is_open) log_.note("endsolid missing", "file", cursor_.line());
    mesh_.vertices = welder_.take_vertices();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw ImportError({.file = file_, .section = "file", .line = cursor_.line()}, problem,
                      "export the file again");
  }

  std::string_view next() {
    const std::string_view word = cursor_.word_across_lines();
    if (word.empty()) fail("the file is cut short inside a facet");
    return word;
  }

  void expect(std::string_view lower_case) {
    const std::string_view word = next();
    if (!is_word(word, lower_case)) {
      fail(fmt::format("\"{}\" stands where \"{}\" should", word.substr(0, 40), lower_case));
    }
  }

  float number() {
    const std::string_view word = next();
    const std::optional<float> value = parse_number<float>(word);
    if (!value) fail(fmt::format("\"{}\" is not a number", word.substr(0, 40)));
    return *value;
  }

  void facet() {
    // Some writers leave the normal out, others write what is no number: it is not used.
    std::string_view word = next();
    while (!is_word(word, "outer")) word = next();
    expect("loop");
    corners_.clear();
    bool is_finite = true;
    for (word = next(); is_word(word, "vertex"); word = next()) {
      const float x = number();
      const float y = number();
      const float z = number();
      corners_.emplace_back(x, y, z);
      is_finite = is_finite && is_usable(corners_.back());
    }
    if (!is_word(word, "endloop"))
      fail(fmt::format("\"{}\" stands where a vertex or endloop should", word.substr(0, 40)));
    expect("endfacet");
    if (corners_.size() < 3) fail(fmt::format("the facet has {} corners, and must have 3", corners_.size()));
    if (corners_.size() > 3)
      log_.note("facet of more than three corners, cut into triangles", "file", cursor_.line());
    if (!is_finite) {
      log_.note("facet with a coordinate that is no number within 1e9, left out", "file", cursor_.line());
      return;
    }
    const std::uint32_t first = welder_.index_of(corners_[0]);
    std::uint32_t previous = welder_.index_of(corners_[1]);
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      const std::uint32_t corner = welder_.index_of(corners_[i]);
      mesh_.facets.push_back({first, previous, corner});
      previous = corner;
    }
  }

  TextCursor cursor_;
  const std::string& file_;
  BreachLog& log_;
  VertexWelder welder_;
  TriangleMesh mesh_;
  std::vector<Eigen::Vector3f> corners_;  ///< of the present facet
};

}  // namespace

TriangleMesh read_text_stl(std::string_view bytes, const std::string& file, BreachLog& log) {
  return TextStlReader(bytes, file, log).read();
}

}  // namespace lamina::engine
