#include "engine/import/threemf/zip_archive.h"

#include <array>

#include <fmt/format.h>
#include <zip.h>

#include "engine/import/import_error.h"

namespace lamina::engine {

struct ZipArchive::Handle {
  zip_t* archive = nullptr;
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (archive != nullptr) zip_discard(archive);
  }
};

ZipArchive::ZipArchive(std::string_view bytes, const std::string& file, std::size_t max_bytes)
    : file_(file), bytes_left_(max_bytes), handle_(std::make_unique<Handle>()) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) {
    handle_->archive = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (handle_->archive == nullptr) zip_source_free(source);
  }
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (handle_->archive == nullptr) {
    throw ImportError({.file = file}, fmt::format("the ZIP archive cannot be opened: {}", reason),
                      "copy or export it again");
  }
}

ZipArchive::~ZipArchive() = default;

bool ZipArchive::holds(const std::string& name) const {
  return zip_name_locate(handle_->archive, name.c_str(), ZIP_FL_NOCASE) >= 0;
}

void ZipArchive::read(const std::string& name, const std::function<void(std::string_view)>& sink) {
  const auto fail = [&](const std::string& problem) {
    throw ImportError({.file = file_}, fmt::format("{} inside the archive {}", name, problem),
                      "copy or export it again");
  };
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> entry(
      zip_fopen(handle_->archive, name.c_str(), ZIP_FL_NOCASE), &zip_fclose);
  if (!entry) fail(fmt::format("cannot be opened: {}", zip_strerror(handle_->archive)));
  std::array<char, 1 << 16> block{};
  while (true) {
    const zip_int64_t taken = zip_fread(entry.get(), block.data(), block.size());
    if (taken < 0) fail(fmt::format("is damaged: {}", zip_file_strerror(entry.get())));
    if (taken == 0) return;
    const auto count = static_cast<std::size_t>(taken);
    if (count > bytes_left_) fail("inflates to more bytes than a model can mean");
    bytes_left_ -= count;
    sink({block.data(), count});
  }
}

}  // namespace lamina::engine
