#include "transport/protocol/line_assembler.h"

#include <utility>

namespace lamina::transport {

std::optional<std::string> LineAssembler::push(char byte) {
  if (byte == '\n' || byte == '\r') {
    std::string line = std::exchange(line_, {});
    clear();
    if (line.empty()) return std::nullopt;
    line.erase(0, line.find_first_not_of(' '));
    // The firmware's strings end at the first NUL.
    line.resize(std::string(line.c_str()).size());
    return line;
  }
  if (in_comment_) return std::nullopt;
  if (!escaped_) {
    if (byte == ';') {
      in_comment_ = true;
      return std::nullopt;
    }
    if (byte == '\\') {
      escaped_ = true;
      return std::nullopt;
    }
    if (byte == '\b') {
      if (!line_.empty()) line_.pop_back();
      return std::nullopt;
    }
  }
  escaped_ = false;
  if (line_.size() < max_bytes_) line_ += byte;
  return std::nullopt;
}

void LineAssembler::clear() {
  line_.clear();
  in_comment_ = false;
  escaped_ = false;
}

}  // namespace lamina::transport
