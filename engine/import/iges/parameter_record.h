#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/geometry/vector.h"
#include "engine/import/iges/iges_file.h"
#include "engine/import/iges/tolerance_log.h"

namespace lamina::engine {

/// Reads the parameters of one entity one after the other, straight from the lines of the file. Each function
/// takes the next parameter, `name` is what messages call it; what is missing or of the wrong kind throws
/// ImportError with file, entity and line.
class ParameterRecord {
 public:
  /// Starts behind the entity type number, which must be that of the directory entry. `file` and `log` must
  /// outlive the record.
  ParameterRecord(const IgesFile& file, std::size_t entry_index, ToleranceLog& log);

  const DirectoryEntry& entry() const { return entry_; }
  std::size_t directory_line() const { return lamina::engine::directory_line(entry_index_); }

  double real(std::string_view name);
  double real_or(double standard, std::string_view name);
  Vector3 vector(std::string_view name);
  Vector2 planar_vector(std::string_view name);
  int integer(std::string_view name);
  int integer_or(int standard, std::string_view name);

  /// An integer of at least `lowest` that says how many of something follow, one parameter each at least.
  std::size_t count(int lowest, std::string_view name);

  /// Throws unless the file has room for `count` further parameters, so that counts can be trusted with
  /// memory.
  void require(std::size_t count, std::string_view name) const;

  /// Directory line of another entity of the file.
  std::size_t pointer(std::string_view name);

  /// The same where there may be none: 0 then.
  std::size_t pointer_or_none(std::string_view name);

  /// Passes over `count` parameters, strings too.
  void skip(std::size_t count);

  /// Whether the record holds no further parameter.
  bool at_end();

  /// Lines taken so far.
  std::size_t lines_read() const { return line_ - entry_.parameter_line + 1; }

  /// Notes a tolerated breach at the present line.
  void note(Tolerance kind, std::string_view detail = {});

  /// Throws ImportError for the present line.
  [[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) const;

 private:
  bool next_line();
  bool belongs_to_entity(std::string_view line) const;
  bool skip_blanks();
  std::string_view next_value();
  std::string_view continued_value();
  bool skip_string();
  double real_from(std::string_view text, std::string_view name) const;
  int integer_from(std::string_view text, std::string_view name);
  std::size_t bytes_left() const;

  const IgesFile& file_;
  ToleranceLog& log_;
  std::size_t entry_index_;
  const DirectoryEntry& entry_;
  char parameter_delimiter_;
  char record_delimiter_;
  std::size_t line_ = 0;        ///< of the parameter section, from 1
  std::size_t end_line_ = 0;    ///< last line that may belong to the entity
  const char* at_ = nullptr;    ///< next character of the present line
  const char* end_ = nullptr;   ///< end of its data
  bool ended_ = false;          ///< the record delimiter was met
  std::size_t value_line_ = 0;  ///< where the last value started
  std::string continued_text_;  ///< a value that runs over a line end
};

}  // namespace lamina::engine
