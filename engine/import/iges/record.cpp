#include "engine/import/iges/record.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kRecordColumns = 80;

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r") == std::string_view::npos;
}

/// Hands out the lines of a file one by one, without their line ends.
class LineSplitter {
 public:
  explicit LineSplitter(std::string_view bytes) : rest_(bytes) {
    if (bytes.find('\n') != std::string_view::npos) {
      line_end_ = '\n';
    } else if (bytes.find('\r') != std::string_view::npos) {
      line_end_ = '\r';
    }
  }

  bool at_end() const { return rest_.empty(); }

  std::string_view next() {
    if (line_end_ == '\0') return take(std::min(kRecordColumns, rest_.size()), 0);
    const std::size_t length = rest_.find(line_end_);
    if (length == std::string_view::npos) return take(rest_.size(), 0);
    return take(length, 1);
  }

 private:
  std::string_view take(std::size_t length, std::size_t skipped) {
    const std::string_view line = rest_.substr(0, length);
    rest_.remove_prefix(length + skipped);
    return line;
  }

  std::string_view rest_;
  char line_end_ = '\0';
};

void check_counts(const IgesRecords& records, ToleranceLog& log) {
  const std::pair<char, std::size_t> sections[] = {{'S', records.start.size()},
                                                   {'G', records.global.size()},
                                                   {'D', records.directory.size()},
                                                   {'P', records.parameter.size()}};
  std::size_t column = 0;
  for (const auto& [letter, count] : sections) {
    const std::string expected = fmt::format("{}{:7}", letter, count);
    std::string stated(records.terminate.substr(column, expected.size()));
    column += expected.size();
    // Leading zeros count as blanks.
    for (std::size_t i = 1; i + 1 < stated.size() && (stated[i] == '0' || stated[i] == ' '); ++i)
      stated[i] = ' ';
    if (stated != expected) {
      log.note(Tolerance::kTerminateCounts, "terminate", 1, fmt::format("\"{}\", found {}", stated, count));
    }
  }
}

}  // namespace

IgesRecords split_records(std::string_view bytes, const std::string& file, ToleranceLog& log) {
  IgesRecords records;
  LineSplitter lines(bytes);
  const auto fail = [&](const std::string& problem, const std::string& hint) {
    throw ImportError({.file = file, .section = "file", .line = records.line_count}, problem, hint);
  };
  while (!lines.at_end()) {
    const std::string_view line = lines.next();
    ++records.line_count;
    if (is_blank(line)) {
      log.note(Tolerance::kBlankLine, "file", records.line_count);
      continue;
    }
    if (!records.terminate.empty()) {
      log.note(Tolerance::kTextAfterTerminate, "file", records.line_count);
      break;
    }
    if (line.size() <= kContentColumns) {
      if (lines.at_end() && records.line_count > 1) {
        log.note(Tolerance::kShortLastLine, "file", records.line_count);
        break;
      }
      fail(fmt::format("the line has {} columns, and its section letter must be in column 73", line.size()),
           "export the file again in the fixed format of IGES");
    }
    const std::string_view content = line.substr(0, kContentColumns);
    switch (line[kContentColumns]) {
      case 'S':
        records.start.push_back(content);
        break;
      case 'G':
        records.global.push_back(content);
        break;
      case 'D':
        records.directory.push_back(content);
        break;
      case 'P':
        records.parameter.push_back(content);
        break;
      case 'T':
        records.terminate = content;
        break;
      case 'B':
        fail("the file is in the binary form of IGES", "export it in the fixed ASCII format");
        break;
      case 'C':
        fail("the file is in the compressed form of IGES", "export it in the fixed ASCII format");
        break;
      default:
        fail("column 73 must hold the letter of a section, one of S, G, D, P, T",
             "export the file again in the fixed format of IGES");
    }
  }
  if (records.terminate.empty()) {
    log.note(Tolerance::kMissingTerminate, "file", records.line_count);
  } else {
    check_counts(records, log);
  }
  return records;
}

}  // namespace lamina::engine
