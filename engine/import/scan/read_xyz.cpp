#include "engine/import/scan/read_xyz.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <fmt/format.h>

#include "engine/import/import_error.h"
#include "engine/import/mesh/text_cursor.h"
#include "engine/import/scan/scan_builder.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kMostColumns = 6;
/// Columns 4 to 6 are a normal where they are this long on the first lines, all but for rounding.
constexpr double kUnitLength = 0.05;

/// The numbers at the beginning of a line.
struct Row {
  std::array<float, kMostColumns> values{};
  std::size_t count = 0;
  bool is_comment = false;
  std::string_view bad_word;  ///< that is no number, before the third one
};

Row parse_row(std::string_view line) {
  constexpr std::string_view kSeparators = " \t\r,;";
  Row row;
  while (row.count < kMostColumns) {
    const std::size_t first = line.find_first_not_of(kSeparators);
    if (first == std::string_view::npos) break;
    line.remove_prefix(first);
    const std::string_view word = line.substr(0, line.find_first_of(kSeparators));
    line.remove_prefix(word.size());
    if (word.starts_with('#') || word.starts_with("//")) {
      row.is_comment = row.count == 0;
      break;
    }
    const auto value = parse_number<float>(word);
    if (!value) {
      if (row.count < 3) row.bad_word = word;
      break;
    }
    row.values[row.count++] = *value;
  }
  return row;
}

/// Hands out lines with their numbers.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return line;
  }

  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

bool is_point(const Row& row) {
  return row.bad_word.empty() && row.count >= 3;
}

bool has_unit_normal(const Row& row) {
  if (row.count < 6) return false;
  const double length = std::hypot(row.values[3], row.values[4], row.values[5]);
  return std::abs(length - 1.0) <= kUnitLength;
}

/// Whether the first points have unit vectors behind them.
bool has_normals(std::string_view text) {
  constexpr int kLooked = 100;
  Lines lines(text);
  int points = 0;
  int with_normal = 0;
  while (const auto line = lines.next()) {
    const Row row = parse_row(*line);
    if (!is_point(row)) continue;
    with_normal += has_unit_normal(row) ? 1 : 0;
    if (++points == kLooked) break;
  }
  return points > 0 && 10 * with_normal >= 9 * points;
}

}  // namespace

bool looks_like_xyz(std::string_view bytes) {
  constexpr std::size_t kLongEnough = 4096;
  Lines lines(bytes.substr(0, kLongEnough));
  int points = 0;
  while (const auto line = lines.next()) {
    const Row row = parse_row(*line);
    const bool is_cut = bytes.size() > kLongEnough && lines.number() > 1 && points > 0;
    if (is_point(row)) {
      if (++points == 8) return true;
    } else if (!row.bad_word.empty() || (row.count > 0 && points > 0)) {
      return is_cut && points > 1;
    }
  }
  return points > 1;
}

ImportResult read_xyz(std::string_view bytes, const std::string& file) {
  BreachLog log;
  ScanBuilder scan(file, log);
  const bool with_normals = has_normals(bytes);
  Lines lines(bytes);
  bool is_first = true;
  while (const auto line = lines.next()) {
    const Row row = parse_row(*line);
    if (row.is_comment || (row.count == 0 && row.bad_word.empty())) continue;
    // Some writers begin with the number of points.
    const bool is_count = is_first && row.count == 1 && row.bad_word.empty();
    is_first = false;
    if (is_count) continue;
    if (!is_point(row)) {
      throw ImportError({.file = file, .section = "file", .line = lines.number()},
                        row.bad_word.empty()
                            ? fmt::format("the line has {} numbers, and a point has three", row.count)
                            : fmt::format("\"{}\" is not a number", row.bad_word.substr(0, 40)),
                        "a point is a line of x y z or x y z nx ny nz");
    }
    const auto& v = row.values;
    scan.add({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
  }
  ImportResult result = scan.finish("XYZ", with_normals);
  result.report.line_count = lines.number();
  return result;
}

}  // namespace lamina::engine
