#include "engine/import/iges/directory_entry.h"

#include <fmt/format.h>

#include "engine/import/iges/number.h"
#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

/// One line of the directory: fields of eight columns.
class DirectoryLine {
 public:
  DirectoryLine(std::string_view line, std::size_t number, const std::string& file)
      : line_(line), number_(number), file_(file) {}

  std::string_view text(std::size_t field) const { return line_.substr(8 * field, 8); }

  /// 0 where the field is blank.
  int integer(std::size_t field, std::string_view name) const {
    const std::string_view spelled = trimmed(text(field));
    if (spelled.empty()) return 0;
    const auto value = parse_integer(spelled);
    if (!value) fail(fmt::format("the {} is \"{}\", not an integer", name, spelled));
    return *value;
  }

  std::size_t pointer(std::size_t field, std::string_view name) const {
    const int value = integer(field, name);
    if (value < 0) fail(fmt::format("the {} is {}, and must not be negative", name, value));
    return static_cast<std::size_t>(value);
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw ImportError({.file = file_, .section = "directory", .line = number_}, problem,
                      "export the file again");
  }

 private:
  std::string_view line_;
  std::size_t number_;
  const std::string& file_;
};

/// Two digits of the status number; blanks are zeros.
int status_digits(std::string_view status, std::size_t first) {
  int value = 0;
  for (const char c : status.substr(first, 2)) value = 10 * value + (c >= '0' && c <= '9' ? c - '0' : 0);
  return value;
}

EntityUse use_of(int digits) {
  constexpr int kLast = static_cast<int>(EntityUse::kConstruction);
  return digits <= kLast ? static_cast<EntityUse>(digits) : EntityUse::kOther;
}

DirectoryEntry parse_entry(const DirectoryLine& first, const DirectoryLine& second, std::size_t number,
                           ToleranceLog& log) {
  DirectoryEntry entry;
  entry.type = first.integer(0, "entity type");
  if (entry.type < 0) first.fail(fmt::format("the entity type is {}, and must not be negative", entry.type));
  entry.parameter_line = first.pointer(1, "parameter pointer");
  entry.transform = first.pointer(6, "transformation pointer");
  const std::string_view status = first.text(8);
  if (trimmed(status).empty()) log.note(Tolerance::kBlankStatus, "directory", number);
  entry.is_blanked = status_digits(status, 0) == 1;
  const int subordinate = status_digits(status, 2);
  entry.is_physically_dependent = subordinate == 1 || subordinate == 3;
  entry.use = use_of(status_digits(status, 4));

  const int repeated = second.integer(0, "entity type");
  if (repeated != 0 && repeated != entry.type) {
    second.fail(fmt::format("the entity type is {}, but {} on the line before", repeated, entry.type));
  }
  entry.parameter_line_count = second.pointer(3, "parameter line count");
  entry.form = second.integer(4, "form number");
  return entry;
}

}  // namespace

std::vector<DirectoryEntry> parse_directory(const std::vector<std::string_view>& lines,
                                            const std::string& file, ToleranceLog& log) {
  if (lines.empty())
    throw ImportError({.file = file, .section = "directory"}, "the section is missing: no entities");
  std::vector<DirectoryEntry> entries;
  entries.reserve(lines.size() / 2);
  for (std::size_t i = 0; i < lines.size(); i += 2) {
    const DirectoryLine first(lines[i], i + 1, file);
    if (i + 1 == lines.size()) first.fail("the entry has one line, and must have two: the file is cut short");
    entries.push_back(parse_entry(first, DirectoryLine(lines[i + 1], i + 2, file), i + 1, log));
  }
  return entries;
}

}  // namespace lamina::engine
