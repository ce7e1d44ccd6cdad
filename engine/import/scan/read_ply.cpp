#include "engine/import/scan/read_ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "engine/import/byte_order.h"
#include "engine/import/import_error.h"
#include "engine/import/mesh/coordinate.h"
#include "engine/import/mesh/text_cursor.h"
#include "engine/import/mesh/vertex_welder.h"
#include "engine/import/scan/scan_builder.h"

namespace lamina::engine {
namespace {

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

enum class NumberType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::optional<NumberType> number_type(std::string_view name) {
  struct Name {
    std::string_view name;
    NumberType type;
  };
  static constexpr auto kNames = std::to_array<Name>({{"char", NumberType::kInt8},
                                                      {"int8", NumberType::kInt8},
                                                      {"uchar", NumberType::kUint8},
                                                      {"uint8", NumberType::kUint8},
                                                      {"short", NumberType::kInt16},
                                                      {"int16", NumberType::kInt16},
                                                      {"ushort", NumberType::kUint16},
                                                      {"uint16", NumberType::kUint16},
                                                      {"int", NumberType::kInt32},
                                                      {"int32", NumberType::kInt32},
                                                      {"uint", NumberType::kUint32},
                                                      {"uint32", NumberType::kUint32},
                                                      {"float", NumberType::kFloat32},
                                                      {"float32", NumberType::kFloat32},
                                                      {"double", NumberType::kFloat64},
                                                      {"float64", NumberType::kFloat64}});
  for (const Name& known : kNames) {
    if (known.name == name) return known.type;
  }
  return std::nullopt;
}

std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::kInt8:
    case NumberType::kUint8:
      return 1;
    case NumberType::kInt16:
    case NumberType::kUint16:
      return 2;
    case NumberType::kInt32:
    case NumberType::kUint32:
    case NumberType::kFloat32:
      return 4;
    case NumberType::kFloat64:
      return 8;
  }
  return 1;
}

struct Property {
  std::string_view name;
  NumberType type = NumberType::kFloat32;
  std::optional<NumberType> count;  ///< of a list: the type of its length
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;

  /// Least bytes that one of them takes.
  std::size_t least_bytes(Encoding encoding) const {
    std::size_t bytes = 0;
    for (const Property& property : properties)
      bytes += encoding == Encoding::kAscii ? 2 : size_of(property.count.value_or(property.type));
    return bytes;
  }
  std::optional<std::size_t> index_of(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == property) return i;
    }
    return std::nullopt;
  }
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
  std::string_view body;
  std::size_t lines = 0;
};

/// Hands out the numbers of the body, one after the other.
class Values {
 public:
  Values(const Header& header, const std::string& file)
      : encoding_(header.encoding),
        rest_(header.body),
        words_(header.body),
        header_lines_(header.lines),
        file_(file) {}

  double next(NumberType type) { return encoding_ == Encoding::kAscii ? next_word() : next_bytes(type); }

  std::size_t bytes_left() const {
    return encoding_ == Encoding::kAscii ? words_.rest().size() : rest_.size();
  }

 private:
  [[noreturn]] void end() const {
    throw ImportError({.file = file_}, "the file is cut short: the header announces more than there is",
                      "copy or export it again");
  }

  double next_word() {
    const std::string_view word = words_.word_across_lines();
    if (word.empty()) end();
    const auto value = parse_number<double>(word);
    if (!value) {
      throw ImportError({.file = file_, .section = "file", .line = header_lines_ + words_.line()},
                        fmt::format("\"{}\" is not a number", word.substr(0, 40)), "export the file again");
    }
    return *value;
  }

  template <typename Number>
  double take() {
    if (rest_.size() < sizeof(Number)) end();
    const std::endian order = encoding_ == Encoding::kBigEndian ? std::endian::big : std::endian::little;
    const Number value = load<Number>(rest_.data(), order);
    rest_.remove_prefix(sizeof(Number));
    return static_cast<double>(value);
  }

  double next_bytes(NumberType type) {
    switch (type) {
      case NumberType::kInt8:
        return take<std::int8_t>();
      case NumberType::kUint8:
        return take<std::uint8_t>();
      case NumberType::kInt16:
        return take<std::int16_t>();
      case NumberType::kUint16:
        return take<std::uint16_t>();
      case NumberType::kInt32:
        return take<std::int32_t>();
      case NumberType::kUint32:
        return take<std::uint32_t>();
      case NumberType::kFloat32:
        return take<float>();
      case NumberType::kFloat64:
        return take<double>();
    }
    return 0.0;
  }

  Encoding encoding_;
  std::string_view rest_;
  TextCursor words_;
  std::size_t header_lines_;
  const std::string& file_;
};

/// Length of a list; lists do not end before they begin, nor beyond the file.
std::size_t list_length(Values& values, const Property& property, const std::string& file) {
  const double length = values.next(*property.count);
  if (length >= 0.0 && length <= static_cast<double>(values.bytes_left()) && length == std::floor(length))
    return static_cast<std::size_t>(length);
  throw ImportError({.file = file}, fmt::format("a list \"{}\" has {:g} entries", property.name, length),
                    "the file is damaged");
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file) : file_(file), header_(parse_header(bytes)) {}

  ImportResult read() {
    Values values(header_, file_);
    for (const Element& element : header_.elements) {
      check_room(element, values);
      if (element.name == "vertex") {
        read_vertices(element, values);
      } else if (element.name == "face") {
        read_faces(element, values);
      } else {
        pass_over(element, values);
      }
    }
    if (has_faces_) return mesh();
    ScanBuilder scan(file_, log_);
    for (std::size_t i = 0; i < points_.size(); ++i) scan.add(points_[i], normals_[i]);
    ImportResult result = scan.finish("PLY", has_normals_);
    result.report.line_count = header_.lines;
    return result;
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& problem) const {
    throw ImportError({.file = file_, .section = "header", .line = line}, problem, "export the file again");
  }

  Header parse_header(std::string_view bytes) const {
    Header header;
    TextCursor cursor(bytes);
    cursor.next_line();  // ply
    bool has_format = false;
    while (true) {
      const std::size_t line = cursor.line();
      const std::string_view keyword = cursor.word();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        header.encoding = encoding_of(cursor.word(), line);
        has_format = true;
      } else if (keyword == "element") {
        header.elements.push_back(parse_element(cursor, line));
      } else if (keyword == "property") {
        if (header.elements.empty()) fail(line, "a property comes before the first element");
        header.elements.back().properties.push_back(parse_property(cursor, line));
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        fail(line, fmt::format("\"{}\" is no statement of a PLY header", keyword.substr(0, 40)));
      }
      if (!cursor.next_line()) fail(line, "the header has no end");
    }
    header.lines = cursor.line();
    header.body = cursor.next_line() ? cursor.rest() : std::string_view{};
    if (!has_format) fail(header.lines, "the header does not name a format");
    return header;
  }

  Encoding encoding_of(std::string_view name, std::size_t line) const {
    if (name == "ascii") return Encoding::kAscii;
    if (name == "binary_little_endian") return Encoding::kLittleEndian;
    if (name == "binary_big_endian") return Encoding::kBigEndian;
    fail(line, fmt::format("the format \"{}\" is none of PLY", name.substr(0, 40)));
  }

  Element parse_element(TextCursor& cursor, std::size_t line) const {
    Element element;
    element.name = cursor.word();
    const std::string_view word = cursor.word();
    const auto count = parse_number<std::uint64_t>(word);
    if (!count) fail(line, fmt::format("the element count \"{}\" is not a number", word.substr(0, 40)));
    element.count = *count;
    return element;
  }

  Property parse_property(TextCursor& cursor, std::size_t line) const {
    const auto type = [&] {
      const std::string_view name = cursor.word();
      const auto found = number_type(name);
      if (!found) fail(line, fmt::format("the type \"{}\" is not known", name.substr(0, 40)));
      return *found;
    };
    Property property;
    TextCursor ahead = cursor;
    if (ahead.word() == "list") {
      cursor = ahead;
      property.count = type();
    }
    property.type = type();
    property.name = cursor.word();
    return property;
  }

  /// Counts in headers are not believed.
  void check_room(const Element& element, const Values& values) const {
    if (element.count == 0) return;
    const std::size_t least = element.least_bytes(header_.encoding);
    if (least > 0 && element.count <= values.bytes_left() / least + 1) return;
    throw ImportError({.file = file_},
                      fmt::format("the header announces {} times \"{}\", and there is no room for them",
                                  element.count, element.name.substr(0, 40)),
                      "the file is damaged or cut short");
  }

  static void pass_over(const Property& property, Values& values, const std::string& file) {
    const std::size_t length = property.count ? list_length(values, property, file) : 1;
    for (std::size_t k = 0; k < length; ++k) values.next(property.type);
  }

  void pass_over(const Element& element, Values& values) {
    if (element.count > 0)
      log_.note("elements that are neither vertices nor faces, passed over", "header", 0,
                fmt::format("{} times \"{}\"", element.count, element.name.substr(0, 40)));
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) pass_over(property, values, file_);
    }
  }

  void read_vertices(const Element& element, Values& values) {
    constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "nx", "ny", "nz"};
    constexpr std::size_t kNone = kNames.size();
    std::vector<std::size_t> meaning;
    for (const Property& property : element.properties) {
      const auto known = std::find(kNames.begin(), kNames.end(), property.name);
      meaning.push_back(property.count ? kNone : static_cast<std::size_t>(known - kNames.begin()));
    }
    const auto has = [&](std::size_t wanted) {
      return std::find(meaning.begin(), meaning.end(), wanted) != meaning.end();
    };
    if (!has(0) || !has(1) || !has(2)) fail(0, "the vertices have no x, y and z");
    has_normals_ = has(3) && has(4) && has(5);
    for (std::size_t i = 0; i < element.count; ++i) {
      std::array<float, kNames.size()> found{};
      for (std::size_t p = 0; p < meaning.size(); ++p) {
        if (meaning[p] == kNone) {
          pass_over(element.properties[p], values, file_);
        } else {
          found[meaning[p]] = static_cast<float>(values.next(element.properties[p].type));
        }
      }
      points_.emplace_back(found[0], found[1], found[2]);
      normals_.emplace_back(found[3], found[4], found[5]);
    }
  }

  void read_faces(const Element& element, Values& values) {
    auto corners = element.index_of("vertex_indices");
    if (!corners) corners = element.index_of("vertex_index");
    if (element.count > 0 && (!corners || !element.properties[*corners].count))
      fail(0, "the faces have no list of vertices");
    for (std::size_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (p != *corners) {
          pass_over(element.properties[p], values, file_);
        } else {
          read_face(element.properties[p], values, i + 1);
        }
      }
    }
    has_faces_ = has_faces_ || element.count > 0;
  }

  void read_face(const Property& property, Values& values, std::size_t number) {
    const std::size_t count = list_length(values, property, file_);
    std::uint32_t first = 0;
    std::uint32_t previous = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double index = values.next(property.type);
      if (!(index >= 0.0 && index < std::numeric_limits<std::uint32_t>::max())) {
        throw ImportError({.file = file_, .section = "face", .line = number},
                          fmt::format("the index {:g} of a corner leads to no vertex", index),
                          "the file is damaged");
      }
      const auto corner = static_cast<std::uint32_t>(index);
      if (k == 0) first = corner;
      if (k >= 2) facets_.push_back({first, previous, corner});
      previous = corner;
    }
    if (count < 3) log_.note("face of fewer than three corners, left out", "face", number);
  }

  /// Faces may stand before their vertices.
  ImportResult mesh() {
    VertexWelder welder;
    constexpr std::uint32_t kUnusable = 0xffffffffU;
    std::vector<std::uint32_t> welded;
    welded.reserve(points_.size());
    for (const Eigen::Vector3f& point : points_)
      welded.push_back(is_usable(point) ? welder.index_of(point) : kUnusable);
    TriangleMesh mesh;
    mesh.facets.reserve(facets_.size());
    for (const auto& facet : facets_) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (facet[k] >= welded.size()) {
          throw ImportError({.file = file_},
                            fmt::format("the index {} of a corner leads to no vertex; the file has {}",
                                        facet[k], welded.size()),
                            "the file is damaged");
        }
        corners[k] = welded[facet[k]];
      }
      if (std::find(corners.begin(), corners.end(), kUnusable) == corners.end()) {
        mesh.facets.push_back(corners);
      } else {
        log_.note("triangle with a coordinate that is no number within 1e9, left out", "face", 0);
      }
    }
    if (mesh.facets.empty())
      throw ImportError({.file = file_}, "nothing to slice: the file holds no usable face");
    mesh.vertices = welder.take_vertices();
    ImportResult result;
    result.model.name = file_;
    result.model.meshes.push_back(std::move(mesh));
    result.report.format = "PLY";
    result.report.tolerated = log_.list();
    result.report.line_count = header_.lines;
    return result;
  }

  const std::string& file_;
  Header header_;
  BreachLog log_;
  std::vector<Eigen::Vector3f> points_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<std::array<std::uint32_t, 3>> facets_;
  bool has_normals_ = false;
  bool has_faces_ = false;
};

}  // namespace

bool looks_like_ply(std::string_view bytes) {
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
}

ImportResult read_ply(std::string_view bytes, const std::string& file) {
  return PlyReader(bytes, file).read();
}

}  // namespace lamina::engine
