#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/import/iges/tolerance_log.h"

namespace lamina::engine {

/// The lines of an IGES file by section: columns 1 to 72 of each, all of that length, views into the file's
/// bytes. Line n of a section is at index n - 1; the number in columns 74 to 80 is not looked at.
struct IgesRecords {
  std::vector<std::string_view> start;
  std::vector<std::string_view> global;
  std::vector<std::string_view> directory;
  std::vector<std::string_view> parameter;
  std::string_view terminate;  ///< empty where the section is missing
  std::size_t line_count = 0;
};

/// Columns of a line that carry content; column 73 is the letter of the section.
inline constexpr std::size_t kContentColumns = 72;

/// Splits the bytes of a file, which must outlive the result. Lines end in LF, CR LF or CR, or are 80 columns
/// each without any line end. Throws ImportError, naming `file`, for lines without a section letter and for
/// the binary and the compressed form.
IgesRecords split_records(std::string_view bytes, const std::string& file, ToleranceLog& log);

}  // namespace lamina::engine
