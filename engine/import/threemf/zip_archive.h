#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace lamina::engine {

/// The files of a ZIP archive in memory. All throw ImportError, naming `file`, where the archive is damaged.
class ZipArchive {
 public:
  /// `bytes` and `file` must outlive the archive. All that is read may inflate to `max_bytes` together.
  ZipArchive(std::string_view bytes, const std::string& file, std::size_t max_bytes);
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;
  ~ZipArchive();

  /// Whether it holds a file of that name, upper and lower case alike.
  bool holds(const std::string& name) const;

  /// Inflates a file piece by piece into `sink`.
  void read(const std::string& name, const std::function<void(std::string_view)>& sink);

 private:
  struct Handle;

  const std::string& file_;
  std::size_t bytes_left_;
  std::unique_ptr<Handle> handle_;
};

}  // namespace lamina::engine
