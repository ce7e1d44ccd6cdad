#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "tools/cli/interrupt.h"

namespace lamina::tools {

enum class Overwrite { kRefuse, kAllow };

/// A file that appears whole or not at all: it is written under a temporary name in the same folder and
/// renamed when it is finished. Without `finish`, nothing of it stays. "-" writes to stdout instead.
class OutputFile {
 public:
  /// Throws Failure when the file exists and may not be overwritten, or cannot be created.
  OutputFile(const std::string& path, Overwrite overwrite);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Throws Failure when the disk is full or stdout is closed.
  void write(std::string_view text);
  void write_line(std::string_view line);

  /// Puts the file in its place. Throws Failure as `write` does.
  void finish();

  bool is_stdout() const { return temporary_.empty(); }

 private:
  void fail(const std::string& what) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< Empty for stdout.
  std::optional<TemporaryFileGuard> guard_;
  std::FILE* file_ = nullptr;
};

}  // namespace lamina::tools
