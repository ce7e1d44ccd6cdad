#include "engine/import/read_model.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "engine/import/gzip.h"
#include "engine/import/iges/read_iges.h"
#include "engine/import/import_error.h"
#include "engine/import/obj/read_obj.h"
#include "engine/import/scan/read_pcd.h"
#include "engine/import/scan/read_ply.h"
#include "engine/import/scan/read_xyz.h"
#include "engine/import/step/read_step.h"
#include "engine/import/stl/read_stl.h"
#include "engine/import/threemf/read_3mf.h"

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

/// A format that can be read.
struct Format {
  std::string_view extensions;  ///< blank-separated, lower case
  bool (*is_content)(std::string_view bytes);
  ImportResult (*read)(std::string_view bytes, const std::string& file, std::size_t max_bytes);
};

/// In the order in which contents are asked: the ones that cannot be mistaken first.
constexpr auto kFormats = std::to_array<Format>({
    {".3mf", looks_like_zip, read_3mf},
    {".igs .iges", looks_like_iges,
     [](std::string_view bytes, const std::string& file, std::size_t) { return read_iges(bytes, file); }},
    {".step .stp", looks_like_step,
     [](std::string_view bytes, const std::string& file, std::size_t) { return read_step(bytes, file); }},
    {".brep .brp", looks_like_brep,
     [](std::string_view bytes, const std::string& file, std::size_t) { return read_brep(bytes, file); }},
    {".stl", looks_like_stl,
     [](std::string_view bytes, const std::string& file, std::size_t) { return read_stl(bytes, file); }},
    {".obj", looks_like_obj,
     [](std::string_view bytes, const std::string& file, std::size_t) { return read_obj(bytes, file); }},
    {".ply", looks_like_ply,
     [](std::string_view bytes, const std::string& file, std::size_t) { return read_ply(bytes, file); }},
    {".pcd", looks_like_pcd, read_pcd},
    {".xyz .pts .asc", looks_like_xyz,
     [](std::string_view bytes, const std::string& file, std::size_t) { return read_xyz(bytes, file); }},
});

const Format* find_format(std::string_view bytes, const std::string& extension) {
  for (const Format& format : kFormats) {
    if (format.is_content(bytes)) return &format;
  }
  if (extension.size() < 2) return nullptr;
  for (const Format& format : kFormats) {
    const std::string list = std::string(format.extensions) + " ";
    if (list.find(extension + " ") != std::string::npos) return &format;
  }
  return nullptr;
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
  const Format* format = find_format(bytes, lower_case(plain_name.extension().string()));
  if (format == nullptr) {
    throw ImportError({.file = file}, "holds no model format that lamina knows",
                      "IGES, STEP, STL, OBJ, 3MF, PLY, PCD and XYZ can be read, also with .gz");
  }
  ImportResult result = format->read(bytes, file, max_bytes);
  result.model.name = plain_name.stem().string();
  return result;
}

}  // namespace lamina::engine
