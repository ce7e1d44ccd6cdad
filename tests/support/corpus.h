#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace lamina::tests {

/// The shared model corpus. It is used in place and never copied into the project, so it may be missing: a
/// test that needs it asks `corpus_present()` first and skips with a WARN.
inline std::filesystem::path corpus_folder() {
  const char* override_path = std::getenv("LAMINA_CORPUS");
  return override_path != nullptr ? override_path : LAMINA_CORPUS_DIR;
}

inline bool corpus_present() {
  return std::filesystem::exists(corpus_folder() / "MANIFEST.md");
}

inline std::string corpus_file(const std::string& name) {
  return (corpus_folder() / name).string();
}

/// Files that the project owns: tests/data.
inline std::string data_file(const std::string& name) {
  return (std::filesystem::path(LAMINA_SOURCE_DIR) / "tests/data" / name).string();
}

}  // namespace lamina::tests
