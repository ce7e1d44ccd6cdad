#pragma once

#include <charconv>
#include <string>
#include <vector>

namespace lamina::tests {

/// One entity of a hand-written IGES file. Entity i (from 0) gets directory line 2 i + 1.
struct IgesEntity {
  int type = 0;
  std::string parameters;  ///< without the type number and the record delimiter
  int form = 0;
  int transform = 0;  ///< directory line of a 124
  std::string status = "00000000";
};

/// What a hand-written IGES file has besides its entities.
struct IgesFrame {
  std::string global =
      ",,4Htest,8Htest.igs,6Hlamina,3H1.0,32,38,6,308,15,4Htest,1.,2,2HMM,1,0.01,"
      "15H20260101.000000,1.E-6,0.,2Hme,4Hnone,11,0,15H20260101.000000;";
  char record_delimiter = ';';
  std::string line_end = "\n";
  bool final_line_end = true;
  bool terminate = true;
  std::size_t data_columns = 64;  ///< 65 breaks the rules as real files do
};

/// `text` in lines of `columns`, with `tail` behind column 72 of each and the section's letter and line
/// number.
inline std::vector<std::string> section_lines(const std::string& text, std::size_t columns,
                                              const std::string& tail, char letter,
                                              std::size_t first_number) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size() || lines.empty(); at += columns) {
    std::string line = text.substr(at, columns);
    line.resize(72 - tail.size(), ' ');
    line += tail;
    std::string number = std::to_string(first_number + lines.size());
    line += letter + std::string(7 - number.size(), ' ') + number;
    lines.push_back(line);
  }
  return lines;
}

inline std::string right_aligned(const std::string& text) {
  return std::string(text.size() < 8 ? 8 - text.size() : 0, ' ') + text;
}

/// An IGES file in fixed format. Parameters are cut at column 64, but never inside a number.
inline std::string iges_text(const std::vector<IgesEntity>& entities, const IgesFrame& frame = {}) {
  std::vector<std::string> lines = section_lines("hand-written test model", 72, "", 'S', 1);
  const std::vector<std::string> global = section_lines(frame.global, 72, "", 'G', 1);
  std::vector<std::string> directory;
  std::vector<std::string> parameter;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const IgesEntity& entity = entities[i];
    const std::string text = std::to_string(entity.type) + "," + entity.parameters + frame.record_delimiter;
    // Pad so that a line ends with a delimiter.
    std::string padded;
    std::size_t column = 0;
    for (std::size_t at = 0; at < text.size();) {
      std::size_t end = text.find_first_of(std::string(",/") + frame.record_delimiter, at);
      end = end == std::string::npos ? text.size() : end + 1;
      const std::size_t length = end - at;
      if (column + length > frame.data_columns && length <= frame.data_columns) {
        padded += std::string(frame.data_columns - column, ' ');
        column = 0;
      }
      padded += text.substr(at, length);
      column = (column + length) % frame.data_columns;
      at = end;
    }
    const std::string number = std::to_string(2 * i + 1);
    const std::string back = std::string(7 - number.size(), ' ') + number;
    const auto entity_lines = section_lines(padded, frame.data_columns, back, 'P', parameter.size() + 1);
    const auto field = [](auto value) { return right_aligned(std::to_string(value)); };
    directory.push_back(field(entity.type) + field(parameter.size() + 1) + field(0) + field(0) + field(0) +
                        field(0) + field(entity.transform) + field(0) + entity.status);
    directory.push_back(field(entity.type) + field(0) + field(0) + field(entity_lines.size()) +
                        field(entity.form));
    parameter.insert(parameter.end(), entity_lines.begin(), entity_lines.end());
  }
  for (std::size_t i = 0; i < directory.size(); ++i) {
    directory[i].resize(72, ' ');
    directory[i] += "D" + right_aligned(std::to_string(i + 1)).substr(1);
  }
  const auto count = [](char letter, std::size_t value) {
    return letter + right_aligned(std::to_string(value)).substr(1);
  };
  std::string terminate =
      count('S', 1) + count('G', global.size()) + count('D', directory.size()) + count('P', parameter.size());
  terminate.resize(72, ' ');
  terminate += "T      1";

  lines.insert(lines.end(), global.begin(), global.end());
  lines.insert(lines.end(), directory.begin(), directory.end());
  lines.insert(lines.end(), parameter.begin(), parameter.end());
  if (frame.terminate) lines.push_back(terminate);
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += lines[i];
    if (i + 1 < lines.size() || frame.final_line_end) text += frame.line_end;
  }
  return text;
}

/// Numbers as IGES reals, with commas between.
inline std::string reals(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    char buffer[32];
    const auto [end, error] =
        std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific);
    text += (text.empty() ? "" : ",") + std::string(buffer, end);
  }
  return text;
}

}  // namespace lamina::tests
