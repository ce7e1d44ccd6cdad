#include "transport/trace/trace_file.h"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace lamina::transport {

namespace {

constexpr mode_t kReadableByAll = 0644;

std::system_error file_error(const std::string& path) {
  return {errno, std::generic_category(), path};
}

}  // namespace

TraceFile::TraceFile(const std::string& path, const TraceHeader& header) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll);
  if (descriptor_ < 0) throw file_error(path);
  text_ = to_text(header);
  write_text();
}

TraceFile::~TraceFile() {
  ::close(descriptor_);
}

void TraceFile::write(const TraceEntry& entry) {
  if (!failure_.empty()) return;
  append_text(text_, entry);
  write_text();
}

void TraceFile::write_text() {
  std::size_t written = 0;
  while (written < text_.size()) {
    const ssize_t count = ::write(descriptor_, text_.data() + written, text_.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      failure_ = std::string(file_error(path_).what()) + "; the trace ends there";
      break;
    }
    written += static_cast<std::size_t>(count);
  }
  text_.clear();
}

Trace read_trace(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw file_error(path);
  std::ostringstream text;
  text << file.rdbuf();
  return parse_trace(text.str());
}

}  // namespace lamina::transport
