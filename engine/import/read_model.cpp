#include "engine/import/read_model.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "engine/import/gzip.h"
#include "engine/import/iges/read_iges.h"
#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::string read_bytes(const std::filesystem::path& path) {
  const ImportPlace place{.file = path.filename().string()};
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw ImportError(place, fmt::format("no such file: {}", path.string()));
  }
  if (std::filesystem::is_directory(path, ignored)) throw ImportError(place, "is a folder, not a model file");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes;
  const auto size = std::filesystem::file_size(path, ignored);
  if (!ignored) bytes.resize(size);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream)
    throw ImportError(place, fmt::format("cannot be read: {}", path.string()), "check its permissions");
  return bytes;
}

/// What the content looks like, whatever the name says; empty where that is unknown.
std::string_view format_by_content(std::string_view bytes) {
  if (looks_like_iges(bytes)) return "IGES";
  if (bytes.substr(0, 12) == "ISO-10303-21") return "STEP";
  if (bytes.substr(0, 2) == "PK") return "3MF";
  if (bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 5) == "ply\r\n") return "PLY";
  if (bytes.substr(0, 6) == "solid ") return "STL";
  return {};
}

}  // namespace

ImportResult read_model(const std::filesystem::path& path, std::size_t max_bytes) {
  const std::string file = path.filename().string();
  std::filesystem::path plain_name = path.filename();
  std::string bytes = read_bytes(path);
  if (is_gzip(bytes)) {
    bytes = inflate_gzip(bytes, file, max_bytes);
    if (lower_case(plain_name.extension().string()) == ".gz") plain_name = plain_name.stem();
  }
  if (bytes.empty()) throw ImportError({.file = file}, "is empty");
  const std::string_view found = format_by_content(bytes);
  const std::string extension = lower_case(plain_name.extension().string());
  const bool named_iges = extension == ".igs" || extension == ".iges";
  if (found != "IGES" && (!named_iges || !found.empty())) {
    const std::string_view guess = found.empty() ? "no model format that lamina knows" : found;
    throw ImportError({.file = file},
                      fmt::format("holds {}; only IGES (.igs, .iges, also with .gz) can be read", guess),
                      "export the model as IGES with untrimmed surfaces");
  }
  ImportResult result = read_iges(bytes, file);
  result.model.name = plain_name.stem().string();
  return result;
}

}  // namespace lamina::engine
