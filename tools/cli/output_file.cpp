#include "tools/cli/output_file.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

std::string error_text() {
  return std::generic_category().message(errno);
}

/// The rights that a new file gets here; mkstemp gives it to its owner alone.
mode_t usual_rights() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

}  // namespace

OutputFile::OutputFile(const std::string& path, Overwrite overwrite) : path_(path) {
  if (path == "-") {
    file_ = stdout;
    return;
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored)) {
    throw Failure(ExitCode::kUsage, path + " is a folder", "name a file in it");
  }
  if (overwrite == Overwrite::kRefuse && std::filesystem::exists(path_, ignored)) {
    throw Failure(ExitCode::kUsage, path + " exists already",
                  "give --force to overwrite it, or -o for another name");
  }
  const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
  std::string name = (folder / path_.filename()).string() + ".XXXXXX";
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0)
    throw Failure(ExitCode::kUsage, "cannot write to " + folder.string() + ": " + error_text());
  temporary_ = name;
  guard_.emplace(temporary_);
  fchmod(descriptor, usual_rights());
  file_ = fdopen(descriptor, "w");
}

OutputFile::~OutputFile() {
  if (is_stdout()) return;
  if (file_ != nullptr) std::fclose(file_);
  unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail("cannot write");
}

void OutputFile::write_line(std::string_view line) {
  write(line);
  write("\n");
}

void OutputFile::finish() {
  if (std::fflush(file_) != 0) fail("cannot write");
  if (is_stdout()) return;
  const bool synced = fsync(fileno(file_)) == 0;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!synced || !closed) fail("cannot write");
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot put in its place");
}

void OutputFile::fail(const std::string& what) const {
  throw Failure(ExitCode::kInternal,
                what + " " + (is_stdout() ? "to stdout" : path_.string()) + ": " + error_text());
}

}  // namespace lamina::tools
