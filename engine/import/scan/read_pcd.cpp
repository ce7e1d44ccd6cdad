#include "engine/import/scan/read_pcd.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/import/byte_order.h"
#include "engine/import/import_error.h"
#include "engine/import/mesh/text_cursor.h"
#include "engine/import/scan/lzf.h"
#include "engine/import/scan/scan_builder.h"

namespace lamina::engine {
namespace {

/// What a point has of one kind.
struct Field {
  std::string_view name;
  std::size_t size = 4;  ///< bytes of a number
  char type = 'F';       ///< F: floating point, I: signed, U: unsigned
  std::size_t count = 1;

  std::size_t bytes() const { return size * count; }
};

struct Header {
  std::vector<Field> fields;
  std::size_t points = 0;
  std::string_view encoding;
  std::string_view body;
  std::size_t lines = 0;

  std::size_t row_bytes() const {
    std::size_t bytes = 0;
    for (const Field& field : fields) bytes += field.bytes();
    return bytes;
  }
};

/// The coordinates that a point is made of.
constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "normal_x", "normal_y", "normal_z"};

class PcdReader {
 public:
  PcdReader(std::string_view bytes, const std::string& file, std::size_t max_bytes)
      : file_(file), max_bytes_(max_bytes), header_(parse_header(bytes)) {
    for (std::size_t k = 0; k < kNames.size(); ++k) {
      for (std::size_t f = 0; f < header_.fields.size(); ++f) {
        if (header_.fields[f].name == kNames[k]) field_of_[k] = f;
      }
    }
    if (!field_of_[0] || !field_of_[1] || !field_of_[2]) fail(0, "the points have no x, y and z");
  }

  ImportResult read() {
    if (header_.encoding == "ascii") {
      read_ascii();
    } else if (header_.encoding == "binary") {
      check_room(header_.body.size() / header_.row_bytes());
      read_binary(header_.body, true);
    } else if (header_.encoding == "binary_compressed") {
      const std::string data = inflated();
      read_binary(data, false);
    } else {
      fail(header_.lines, fmt::format("the encoding \"{}\" is not known", header_.encoding.substr(0, 40)));
    }
    ImportResult result = scan_.finish("PCD", field_of_[3] && field_of_[4] && field_of_[5]);
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
    std::optional<std::size_t> points;
    std::size_t width = 0;
    std::size_t height = 1;
    while (header.encoding.empty()) {
      const std::size_t line = cursor.line();
      const auto count = [&](std::string_view word) {
        const auto value = parse_number<std::uint32_t>(word);
        if (!value) fail(line, fmt::format("\"{}\" is not a count", word.substr(0, 40)));
        return std::size_t{*value};
      };
      const std::string_view keyword = cursor.word();
      const auto for_each_field = [&](auto&& set) {
        for (Field& field : header.fields) set(field, cursor.word());
      };
      if (keyword == "FIELDS" || keyword == "COLUMNS") {
        for (auto name = cursor.word(); !name.empty(); name = cursor.word()) header.fields.push_back({name});
      } else if (keyword == "SIZE") {
        for_each_field([&](Field& field, std::string_view word) { field.size = count(word); });
      } else if (keyword == "TYPE") {
        for_each_field(
            [&](Field& field, std::string_view word) { field.type = word.empty() ? '?' : word[0]; });
      } else if (keyword == "COUNT") {
        for_each_field([&](Field& field, std::string_view word) { field.count = count(word); });
      } else if (keyword == "WIDTH") {
        width = count(cursor.word());
      } else if (keyword == "HEIGHT") {
        height = count(cursor.word());
      } else if (keyword == "POINTS") {
        points = count(cursor.word());
      } else if (keyword == "DATA") {
        header.encoding = cursor.word();
        if (header.encoding.empty()) fail(line, "the header does not name an encoding");
      } else if (!keyword.empty() && keyword[0] != '#' && keyword != "VERSION" && keyword != "VIEWPOINT") {
        fail(line, fmt::format("\"{}\" is no statement of a PCD header", keyword.substr(0, 40)));
      }
      header.lines = line;
      if (!cursor.next_line() && header.encoding.empty()) fail(line, "the header has no end");
    }
    header.body = cursor.rest();
    header.points = points.value_or(width * height);
    for (const Field& field : header.fields) {
      const bool is_known = (field.type == 'F' && (field.size == 4 || field.size == 8)) ||
                            ((field.type == 'I' || field.type == 'U') &&
                             (field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8));
      if (!is_known)
        fail(0, fmt::format("the field \"{}\" is of type {} and size {}", field.name.substr(0, 40),
                            field.type, field.size));
      if (field.bytes() == 0 || field.count > bytes.size())
        fail(0, fmt::format("the field \"{}\" has {} numbers", field.name.substr(0, 40), field.count));
    }
    if (header.fields.empty()) fail(0, "the header names no fields");
    return header;
  }

  /// Counts in headers are not believed.
  void check_room(std::size_t room) const {
    if (header_.points <= room) return;
    throw ImportError(
        {.file = file_},
        fmt::format("the header announces {} points, and there is room for {}", header_.points, room),
        "the file is damaged or cut short");
  }

  void add(const std::array<float, kNames.size()>& v) { scan_.add({v[0], v[1], v[2]}, {v[3], v[4], v[5]}); }

  void read_ascii() {
    TextCursor cursor(header_.body);
    for (std::size_t i = 0; i < header_.points; ++i) {
      std::array<float, kNames.size()> found{};
      for (std::size_t f = 0; f < header_.fields.size(); ++f) {
        for (std::size_t c = 0; c < header_.fields[f].count; ++c) {
          const std::string_view word = cursor.word_across_lines();
          if (word.empty()) check_room(i);
          if (c > 0) continue;
          for (std::size_t k = 0; k < kNames.size(); ++k) {
            if (field_of_[k] != f) continue;
            const auto value = parse_number<float>(word);
            if (!value) {
              throw ImportError({.file = file_, .section = "file", .line = header_.lines + cursor.line()},
                                fmt::format("\"{}\" is not a number", word.substr(0, 40)),
                                "export the file again");
            }
            found[k] = *value;
          }
        }
      }
      add(found);
    }
  }

  static float number(const char* bytes, const Field& field) {
    constexpr std::endian kOrder = std::endian::little;
    if (field.type == 'F')
      return field.size == 4 ? load<float>(bytes, kOrder) : static_cast<float>(load<double>(bytes, kOrder));
    switch (field.size) {
      case 1:
        return field.type == 'I' ? load<std::int8_t>(bytes, kOrder) : load<std::uint8_t>(bytes, kOrder);
      case 2:
        return field.type == 'I' ? load<std::int16_t>(bytes, kOrder) : load<std::uint16_t>(bytes, kOrder);
      case 4:
        return field.type == 'I' ? static_cast<float>(load<std::int32_t>(bytes, kOrder))
                                 : static_cast<float>(load<std::uint32_t>(bytes, kOrder));
      default:
        return field.type == 'I' ? static_cast<float>(load<std::int64_t>(bytes, kOrder))
                                 : static_cast<float>(load<std::uint64_t>(bytes, kOrder));
    }
  }

  /// Point after point, or, as compressed files have it, field after field.
  void read_binary(std::string_view data, bool point_after_point) {
    struct Way {
      const Field* field = nullptr;
      std::size_t first = 0;
      std::size_t stride = 0;
    };
    std::array<Way, kNames.size()> ways;
    for (std::size_t k = 0; k < kNames.size(); ++k) {
      if (!field_of_[k]) continue;
      const Field& field = header_.fields[*field_of_[k]];
      std::size_t before = 0;
      for (std::size_t f = 0; f < *field_of_[k]; ++f) before += header_.fields[f].bytes();
      ways[k] = {&field, point_after_point ? before : before * header_.points,
                 point_after_point ? header_.row_bytes() : field.bytes()};
    }
    for (std::size_t i = 0; i < header_.points; ++i) {
      std::array<float, kNames.size()> found{};
      for (std::size_t k = 0; k < kNames.size(); ++k) {
        if (ways[k].field != nullptr)
          found[k] = number(data.data() + ways[k].first + i * ways[k].stride, *ways[k].field);
      }
      add(found);
    }
  }

  std::string inflated() const {
    constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
    if (header_.body.size() < kSizes) check_room(0);
    const std::size_t packed = load<std::uint32_t>(header_.body.data(), std::endian::little);
    const std::size_t size =
        load<std::uint32_t>(header_.body.data() + sizeof(std::uint32_t), std::endian::little);
    const std::string_view body = header_.body.substr(kSizes);
    if (packed > body.size()) {
      throw ImportError(
          {.file = file_},
          fmt::format("the file announces {} compressed bytes, and there are {}", packed, body.size()),
          "the file is damaged or cut short");
    }
    check_room(size / header_.row_bytes());
    if (size > max_bytes_ || size > packed * kMostLzfBytes) {
      throw ImportError({.file = file_},
                        fmt::format("{} compressed bytes should inflate to {}", packed, size),
                        "the file is damaged");
    }
    auto data = inflate_lzf(body.substr(0, packed), size);
    if (!data)
      throw ImportError({.file = file_}, "its compressed bytes do not inflate", "the file is damaged");
    return std::move(*data);
  }

  const std::string& file_;
  std::size_t max_bytes_;
  Header header_;
  std::array<std::optional<std::size_t>, kNames.size()> field_of_;
  BreachLog log_;
  ScanBuilder scan_{file_, log_};
};

}  // namespace

bool looks_like_pcd(std::string_view bytes) {
  constexpr std::size_t kLongEnough = 1024;
  TextCursor cursor(bytes.substr(0, kLongEnough));
  do {
    const std::string_view keyword = cursor.word();
    if (keyword == "VERSION" || keyword == "FIELDS" || keyword == "COLUMNS") return true;
    if (!keyword.empty() && keyword[0] != '#') return false;
  } while (cursor.next_line());
  return false;
}

ImportResult read_pcd(std::string_view bytes, const std::string& file, std::size_t max_bytes) {
  return PcdReader(bytes, file, max_bytes).read();
}

}  // namespace lamina::engine
