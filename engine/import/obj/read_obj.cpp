#include "engine/import/obj/read_obj.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/import/breach_log.h"
#include "engine/import/import_error.h"
#include "engine/import/mesh/coordinate.h"
#include "engine/import/mesh/text_cursor.h"
#include "engine/import/mesh/vertex_welder.h"

namespace lamina::engine {
namespace {

/// Statements without any bearing on the shape, or whose vertices faces point to.
constexpr std::array<std::string_view, 26> kPassedOver{
    "vt",     "vn",  "vp",    "g",        "o",        "s",    "mg",         "usemtl",    "mtllib",
    "l",      "p",   "bevel", "c_interp", "d_interp", "lod",  "shadow_obj", "trace_obj", "maplib",
    "usemap", "deg", "bmat",  "step",     "cstype",   "parm", "ctech",      "stech"};

/// Free-form elements and what belongs to them.
constexpr std::array<std::string_view, 9> kFreeForm{"curv", "curv2", "surf", "trim", "hole",
                                                    "scrv", "sp",    "end",  "con"};

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// Reads the statements of an OBJ file one after the other.
class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& file) : cursor_(text), file_(file) {}

  ImportResult read() {
    do {
      statement();
    } while (cursor_.next_line());
    check_late_indices();

    ImportResult result;
    TriangleMesh mesh;
    mesh.facets.reserve(facets_.size());
    for (const Facet& facet : facets_) {
      const bool usable = std::all_of(facet.begin(), facet.end(),
                                      [this](std::uint32_t v) { return vertices_[v] != kUnusable; });
      if (usable) {
        mesh.facets.push_back({vertices_[facet[0]], vertices_[facet[1]], vertices_[facet[2]]});
      } else {
        log_.note("triangle with a coordinate that is no number within 1e9, left out", "file", 0);
      }
    }
    if (mesh.facets.empty()) throw ImportError({.file = file_}, nothing());
    mesh.vertices = welder_.take_vertices();
    result.model.name = file_;
    result.model.meshes.push_back(std::move(mesh));
    result.report.format = "OBJ";
    result.report.tolerated = log_.list();
    result.report.line_count = cursor_.line() - 1;
    for (const auto& [name, count] : free_form_) {
      result.report.skipped.push_back({0, std::string(name), "free-form statement", count, 0});
    }
    return result;
  }

 private:
  using Facet = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t kUnusable = 0xffffffffU;

  [[noreturn]] void fail(const std::string& problem) const {
    throw ImportError({.file = file_, .section = "file", .line = cursor_.line()}, problem,
                      "export the file again");
  }

  std::string nothing() const {
    return free_form_.empty() ? "nothing to slice: the file holds no usable face"
                              : "nothing to slice: the file holds free-form surfaces only; export it as IGES";
  }

  /// The next word of the statement; a backslash at the end of a line carries it on.
  std::string_view word() {
    while (true) {
      if (std::exchange(goes_on_, false) && !cursor_.next_line()) return {};
      std::string_view found = cursor_.word();
      if (found.empty() || found.back() != '\\') return found;
      goes_on_ = true;
      found.remove_suffix(1);
      if (!found.empty()) return found;
    }
  }

  void statement() {
    const std::string_view keyword = word();
    if (keyword.empty() || keyword.front() == '#') return;
    if (keyword == "v") {
      vertex();
    } else if (keyword == "f" || keyword == "fo") {
      face();
    } else if (is_one_of(keyword, kFreeForm)) {
      ++free_form_[keyword];
    } else if (!is_one_of(keyword, kPassedOver)) {
      log_.note("statement that is not known, passed over", "file", cursor_.line(),
                fmt::format("\"{}\"", keyword.substr(0, 20)));
    }
    while (!word().empty()) {  // what is left of it, over all its lines
    }
  }

  void vertex() {
    Eigen::Vector3f point;
    for (float& coordinate : point) {
      const std::string_view text = word();
      const std::optional<float> value = parse_number<float>(text);
      if (!value) fail(fmt::format("the coordinate \"{}\" is not a number", text.substr(0, 40)));
      coordinate = *value;
    }
    vertices_.push_back(is_usable(point) ? welder_.index_of(point) : kUnusable);
  }

  /// The vertex of a corner "v", "v/t", "v//n" or "v/t/n", from 0.
  std::uint32_t corner(std::string_view text) {
    const std::string_view number = text.substr(0, text.find('/'));
    const std::optional<std::int64_t> index = parse_number<std::int64_t>(number);
    if (!index) fail(fmt::format("the corner \"{}\" does not begin with an index", text.substr(0, 40)));
    const auto known = static_cast<std::int64_t>(vertices_.size());
    const std::int64_t vertex = *index < 0 ? known + *index : *index - 1;
    if (vertex < 0 || vertex >= kUnusable) {
      fail(fmt::format("the index {} of a corner leads to no vertex; {} came before", *index, known));
    }
    if (vertex > largest_index_) {
      largest_index_ = vertex;
      largest_index_line_ = cursor_.line();
    }
    return static_cast<std::uint32_t>(vertex);
  }

  void face() {
    std::size_t count = 0;
    std::uint32_t first = 0;
    std::uint32_t previous = 0;
    for (std::string_view text = word(); !text.empty() && text.front() != '#'; text = word()) {
      const std::uint32_t next = corner(text);
      if (count == 0) first = next;
      if (++count >= 3) facets_.push_back({first, previous, next});
      previous = next;
    }
    if (count < 3) log_.note("face of fewer than three corners, left out", "file", cursor_.line());
  }

  /// Faces may stand before their vertices, as some writers have it.
  void check_late_indices() const {
    if (largest_index_ < static_cast<std::int64_t>(vertices_.size())) return;
    throw ImportError({.file = file_, .section = "file", .line = largest_index_line_},
                      fmt::format("the index {} of a corner leads to no vertex; the file has {}",
                                  largest_index_ + 1, vertices_.size()),
                      "the file is damaged or cut short");
  }

  TextCursor cursor_;
  const std::string& file_;
  BreachLog log_;
  VertexWelder welder_;
  std::vector<std::uint32_t> vertices_;  ///< of the file: index after welding, or kUnusable
  std::vector<Facet> facets_;            ///< indices into vertices_
  std::int64_t largest_index_ = -1;
  std::size_t largest_index_line_ = 0;
  std::map<std::string_view, std::size_t> free_form_;
  bool goes_on_ = false;  ///< the last word ended in a backslash: the statement goes on in the next line
};

}  // namespace

bool looks_like_obj(std::string_view bytes) {
  constexpr std::size_t kLongEnough = 4096;
  TextCursor cursor(bytes.substr(0, kLongEnough));
  bool found = false;
  do {
    const std::string_view keyword = cursor.word();
    if (keyword.empty() || keyword.front() == '#') continue;
    if (keyword == "v") {
      if (!parse_number<double>(cursor.word()) || !parse_number<double>(cursor.word())) return false;
      found = true;
    } else if (keyword != "f" && !is_one_of(keyword, kPassedOver) && !is_one_of(keyword, kFreeForm)) {
      // The last line of the piece may be cut anywhere.
      return found && bytes.size() > kLongEnough && cursor.word().empty();
    }
  } while (cursor.next_line());
  return found;
}

ImportResult read_obj(std::string_view bytes, const std::string& file) {
  return ObjReader(bytes, file).read();
}

}  // namespace lamina::engine
