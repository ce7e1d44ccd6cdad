#include "tools/cli/print_source.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

class FileSource : public PrintSource {
 public:
  FileSource(const std::string& path, const gcode::MachineLimits& limits) : file_(path) {
    if (!file_ || std::filesystem::is_directory(path)) throw Failure(ExitCode::kInput, "cannot read " + path);
    summary_ = gcode::summarize(file_, limits);
    if (summary_.commands == 0) throw Failure(ExitCode::kInput, path + " holds no G-code");
    file_.clear();
    file_.seekg(0);
  }

  std::size_t layer_count() const override { return std::max(summary_.layers, summary_.announced_layers); }

  double fraction() const override {
    return static_cast<double>(lines_) / static_cast<double>(std::max<std::size_t>(summary_.lines, 1));
  }

  double planned_filament() const override { return summary_.filament_length; }

  std::vector<std::string> warnings() const override {
    if (summary_.unreadable_lines == 0) return {};
    return {std::to_string(summary_.unreadable_lines) + " lines are no G-code; " +
            summary_.unreadable.front()};
  }

 private:
  std::optional<std::string> next_line() override {
    std::string line;
    if (!std::getline(file_, line)) return std::nullopt;
    ++lines_;
    return line;
  }

  std::ifstream file_;
  gcode::GcodeSummary summary_;
  std::size_t lines_ = 0;
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
  constexpr std::array<const char*, 4> kExtensions{".gcode", ".gco", ".g", ".nc"};
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

}  // namespace lamina::tools
