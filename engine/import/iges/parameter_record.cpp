#include "engine/import/iges/parameter_record.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "engine/import/iges/number.h"
#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

/// Columns of a parameter line that hold data; column 65 is blank, 66 to 72 point back to the directory.
constexpr std::size_t kDataColumns = 64;
constexpr std::size_t kBackPointerColumn = 65;

/// Reals without a point are common (0, 1, 25): any character of this set makes one formally right.
constexpr std::string_view kRealMarks = ".EeDd";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

ParameterRecord::ParameterRecord(const IgesFile& file, std::size_t entry_index, ToleranceLog& log)
    : file_(file),
      log_(log),
      entry_index_(entry_index),
      entry_(file.entries[entry_index]),
      parameter_delimiter_(file.global.parameter_delimiter),
      record_delimiter_(file.global.record_delimiter),
      line_(entry_.parameter_line) {
  const std::size_t available = file_.records.parameter.size();
  if (line_ == 0 || line_ > available) {
    line_ = 0;
    fail(fmt::format("its parameters should start on line {} of the parameter section, which has {} lines",
                     entry_.parameter_line, available));
  }
  end_line_ = std::min(available, line_ + std::max<std::size_t>(entry_.parameter_line_count, 1) - 1);
  const std::string_view first_line = file_.records.parameter[line_ - 1];
  if (!belongs_to_entity(first_line)) {
    note(Tolerance::kBackPointer, fmt::format("\"{}\"", first_line.substr(kBackPointerColumn)));
  }
  --line_;
  next_line();
  const std::string_view text = next_value();
  if (parse_integer(text) != entry_.type) {
    fail(fmt::format("its parameters start with \"{}\", and must start with {}", text.substr(0, 20),
                     entry_.type));
  }
}

bool ParameterRecord::belongs_to_entity(std::string_view line) const {
  const auto pointer = parse_integer(trimmed(line.substr(kBackPointerColumn)));
  return pointer && static_cast<std::size_t>(*pointer) == directory_line();
}

bool ParameterRecord::next_line() {
  const auto& lines = file_.records.parameter;
  if (line_ >= end_line_) {
    // The count in the directory may be too small: the lines say themselves whose they are.
    if (line_ >= lines.size() || !belongs_to_entity(lines[line_])) return false;
    note(Tolerance::kParameterLineCount);
    ++end_line_;
  }
  const std::string_view line = lines[line_++];
  std::size_t columns = kDataColumns;
  if (line[kDataColumns] != ' ') {
    note(Tolerance::kDataInColumn65);
    ++columns;
  }
  at_ = line.data();
  end_ = at_ + columns;
  return true;
}

bool ParameterRecord::skip_blanks() {
  while (true) {
    while (at_ != end_ && *at_ == ' ') ++at_;
    if (at_ != end_) return true;
    if (!next_line()) return false;
  }
}

std::string_view ParameterRecord::next_value() {
  value_line_ = line_;
  if (ended_) return {};
  if (!skip_blanks()) {
    note(Tolerance::kMissingEnd);
    ended_ = true;
    return {};
  }
  value_line_ = line_;
  const char* begin = at_;
  while (at_ != end_ && *at_ != parameter_delimiter_ && *at_ != record_delimiter_) ++at_;
  if (at_ == end_) {
    at_ = begin;
    return continued_value();
  }
  ended_ = *at_ == record_delimiter_;
  return trimmed({begin, static_cast<std::size_t>(at_++ - begin)});
}

std::string_view ParameterRecord::continued_value() {
  continued_text_.clear();
  std::size_t pieces = 0;
  while (true) {
    const char* begin = at_;
    while (at_ != end_ && *at_ != parameter_delimiter_ && *at_ != record_delimiter_) ++at_;
    const std::string_view piece = trimmed({begin, static_cast<std::size_t>(at_ - begin)});
    if (!piece.empty() && ++pieces > 1) note(Tolerance::kSplitNumber);
    continued_text_ += piece;
    if (at_ != end_) {
      ended_ = *at_++ == record_delimiter_;
      return continued_text_;
    }
    if (!next_line()) {
      note(Tolerance::kMissingEnd);
      ended_ = true;
      return continued_text_;
    }
  }
}

double ParameterRecord::real_from(std::string_view text, std::string_view name) const {
  if (text.find_first_of(kRealMarks) == std::string_view::npos) {
    log_.note(Tolerance::kRealWithoutPoint, "parameter", value_line_);
  }
  const auto value = parse_real(text);
  if (!value) fail(fmt::format("the {} is \"{}\", not a finite real number", name, text.substr(0, 40)));
  return *value;
}

int ParameterRecord::integer_from(std::string_view text, std::string_view name) {
  if (const auto value = parse_integer(text)) return *value;
  const auto real = parse_real(text);
  constexpr double kLimit = std::numeric_limits<int>::max();
  if (!real || *real < -kLimit || *real > kLimit || *real != static_cast<double>(static_cast<int>(*real))) {
    fail(fmt::format("the {} is \"{}\", not an integer", name, text.substr(0, 40)));
  }
  note(Tolerance::kIntegerWithPoint);
  return static_cast<int>(*real);
}

double ParameterRecord::real(std::string_view name) {
  const std::string_view text = next_value();
  if (text.empty()) fail(fmt::format("the {} is missing", name));
  return real_from(text, name);
}

double ParameterRecord::real_or(double standard, std::string_view name) {
  const std::string_view text = next_value();
  return text.empty() ? standard : real_from(text, name);
}

Vector3 ParameterRecord::vector(std::string_view name) {
  const double x = real(name);
  const double y = real(name);
  const double z = real(name);
  return {x, y, z};
}

Vector2 ParameterRecord::planar_vector(std::string_view name) {
  const double x = real(name);
  const double y = real(name);
  return {x, y};
}

int ParameterRecord::integer(std::string_view name) {
  const std::string_view text = next_value();
  if (text.empty()) fail(fmt::format("the {} is missing", name));
  return integer_from(text, name);
}

int ParameterRecord::integer_or(int standard, std::string_view name) {
  const std::string_view text = next_value();
  return text.empty() ? standard : integer_from(text, name);
}

std::size_t ParameterRecord::count(int lowest, std::string_view name) {
  const int value = integer(name);
  if (value < lowest) fail(fmt::format("the {} is {}, and must be at least {}", name, value, lowest));
  require(static_cast<std::size_t>(value), name);
  return static_cast<std::size_t>(value);
}

void ParameterRecord::require(std::size_t count, std::string_view name) const {
  // Every parameter takes a delimiter at least.
  if (count > bytes_left()) {
    fail(fmt::format("the {} stands for {} further values, more than the file has room for", name, count),
         "the file is damaged or cut short");
  }
}

std::size_t ParameterRecord::pointer(std::string_view name) {
  const std::size_t value = pointer_or_none(name);
  if (value == 0) fail(fmt::format("the {} is missing", name));
  return value;
}

std::size_t ParameterRecord::pointer_or_none(std::string_view name) {
  const int value = integer_or(0, name);
  if (value == 0) return 0;
  const std::size_t last = 2 * file_.entries.size();
  if (value <= 0 || value % 2 == 0 || static_cast<std::size_t>(value) > last) {
    fail(fmt::format("the {} is {}, and must be an odd directory line from 1 to {}", name, value, last));
  }
  return static_cast<std::size_t>(value);
}

bool ParameterRecord::skip_string() {
  if (!skip_blanks()) return false;
  const char* after_count = std::find_if_not(at_, end_, is_digit);
  if (after_count == at_ || after_count == end_ || *after_count != 'H') return false;
  const auto length = parse_integer({at_, static_cast<std::size_t>(after_count - at_)});
  if (!length) return false;
  at_ = after_count + 1;
  for (auto left = static_cast<std::size_t>(*length); left > 0;) {
    if (at_ == end_ && !next_line()) return false;
    const std::size_t taken = std::min(left, static_cast<std::size_t>(end_ - at_));
    at_ += taken;
    left -= taken;
  }
  return true;
}

void ParameterRecord::skip(std::size_t count) {
  for (std::size_t i = 0; i < count && !ended_; ++i) {
    skip_string();
    next_value();
  }
}

bool ParameterRecord::at_end() {
  return ended_ || !skip_blanks();
}

std::size_t ParameterRecord::bytes_left() const {
  const std::size_t further_lines = file_.records.parameter.size() - line_;
  return ended_ ? 0 : static_cast<std::size_t>(end_ - at_) + further_lines * (kDataColumns + 1);
}

void ParameterRecord::note(Tolerance kind, std::string_view detail) {
  log_.note(kind, "parameter", line_, detail);
}

void ParameterRecord::fail(const std::string& problem, const std::string& hint) const {
  throw ImportError({.file = file_.name,
                     .section = "parameter",
                     .line = value_line_ != 0 ? value_line_ : line_,
                     .entity_type = entry_.type,
                     .directory_line = directory_line()},
                    problem, hint);
}

}  // namespace lamina::engine
