#include "tools/cli/print_source.h"

#include <algorithm>
#include <array>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <utility>

#include "gcode/marlin/gcode_reader.h"
#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

/// Lines looked at before the print begins: enough for any header, thumbnails included.
constexpr std::size_t kMostLinesAhead = 20'000;
constexpr std::size_t kCommandsAhead = 200;
/// At the end of a file, where slicers of one family keep their settings.
constexpr std::streamoff kTailBytes = 64 * 1024;

bool is_command(const std::string& line) {
  const std::size_t at = line.find_first_not_of(" \t\r");
  return at != std::string::npos && line[at] != ';';
}

/// A file or a pipe, read once, line by line; only the end of a file is looked at in advance.
class FileSource : public PrintSource {
 public:
  FileSource(const std::string& path, const gcode::MachineLimits& limits) : path_(path), reader_(limits) {
    if (path != "-") {
      std::error_code ignored;
      if (std::filesystem::is_directory(path, ignored))
        throw Failure(ExitCode::kInput, "cannot read " + path);
      file_.open(path, std::ios::binary);
      if (!file_) throw Failure(ExitCode::kInput, "cannot read " + path);
      const std::uintmax_t size = std::filesystem::file_size(path, ignored);
      if (!ignored) size_ = static_cast<std::int64_t>(size);
      if (size_) read_tail();
    }
    read_head();
  }

  std::size_t layer_count() const override {
    return static_cast<std::size_t>(std::max(0, header_.layers.value_or(0)));
  }

  double fraction() const override {
    if (!size_) return 0.0;
    return static_cast<double>(bytes_) / static_cast<double>(std::max<std::int64_t>(*size_, 1));
  }

  double planned_filament() const override { return reader_.summary().filament_length; }

  std::vector<std::string> warnings() const override {
    const gcode::GcodeSummary summary = reader_.summary();
    if (summary.unreadable_lines == 0) return {};
    return {std::to_string(summary.unreadable_lines) + " lines are no G-code; " + summary.unreadable.front()};
  }

  transport::PrintHeader header() const override { return header_; }
  std::int64_t size() const override { return size_.value_or(-1); }

 private:
  std::optional<std::string> next_line() override {
    std::optional<std::string> line;
    if (!ahead_.empty()) {
      line = std::move(ahead_.front());
      ahead_.pop_front();
    } else {
      line = read_line();
    }
    if (!line) return std::nullopt;
    bytes_ += static_cast<std::int64_t>(line->size()) + 1;
    reader_.read(*line);
    return line;
  }

  std::optional<std::string> read_line() {
    std::istream& from = path_ == "-" ? std::cin : file_;
    std::string line;
    if (std::getline(from, line)) return line;
    if (from.bad()) throw Failure(ExitCode::kInput, "cannot read on in " + path_);
    return std::nullopt;
  }

  void read_head() {
    std::size_t commands = 0;
    while (commands < kCommandsAhead && ahead_.size() < kMostLinesAhead) {
      std::optional<std::string> line = read_line();
      if (!line) break;
      header_.read(*line);
      commands += is_command(*line) ? 1 : 0;
      ahead_.push_back(*std::move(line));
    }
    const bool whole = ahead_.size() < kMostLinesAhead;
    if (commands == 0 && whole) throw Failure(ExitCode::kInput, path_ + " holds no G-code");
  }

  void read_tail() {
    file_.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(*size_) - kTailBytes));
    std::string line;
    std::getline(file_, line);  // the rest of one
    while (std::getline(file_, line)) {
      if (line.starts_with(';')) header_.read(line);
    }
    file_.clear();
    file_.seekg(0);
  }

  std::string path_;
  std::ifstream file_;
  std::optional<std::int64_t> size_;
  gcode::GcodeReader reader_;
  transport::PrintHeader header_;
  std::deque<std::string> ahead_;
  std::int64_t bytes_ = 0;
};

class ModelSource : public PrintSource {
 public:
  explicit ModelSource(std::unique_ptr<ModelGcode> gcode)
      : gcode_(std::move(gcode)),
        layer_count_(gcode_->layer_count()),
        lines_([this] { return gcode_->next(); }) {}

  std::size_t layer_count() const override { return layer_count_; }

  double fraction() const override {
    return static_cast<double>(layer()) / static_cast<double>(std::max<std::size_t>(layer_count_, 1));
  }

  double planned_filament() const override { return gcode_->totals().filament_length; }

  std::vector<std::string> warnings() const override {
    return print_warnings(gcode_->flaws(), gcode_->totals());
  }

  transport::SourceLevel level() override { return lines_.level(); }

 private:
  std::optional<std::string> next_line() override { return lines_.next(); }

  std::unique_ptr<ModelGcode> gcode_;
  std::size_t layer_count_;
  LinesAhead lines_;  ///< Last: its thread uses gcode_.
};

}  // namespace

std::optional<std::string> PrintSource::next() {
  std::optional<std::string> line = next_line();
  if (line && line->starts_with(";LAYER_CHANGE")) ++layer_;
  return line;
}

std::unique_ptr<PrintSource> make_file_source(const std::string& path, const gcode::MachineLimits& limits) {
  return std::make_unique<FileSource>(path, limits);
}

std::unique_ptr<PrintSource> make_model_source(std::unique_ptr<ModelGcode> gcode) {
  return std::make_unique<ModelSource>(std::move(gcode));
}

bool is_gcode_name(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (path == "-") return true;
  constexpr std::array<const char*, 4> kExtensions{".gcode", ".gco", ".g", ".nc"};
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

}  // namespace lamina::tools
