#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gcode/motion/machine_limits.h"
#include "tools/cli/lines_ahead.h"
#include "tools/cli/pipeline.h"
#include "transport/session/print_header.h"
#include "transport/session/print_job.h"

namespace lamina::tools {

/// What is printed: the lines one by one, and how far along they are. All calls come from one thread.
class PrintSource {
 public:
  PrintSource() = default;
  PrintSource(const PrintSource&) = delete;
  PrintSource& operator=(const PrintSource&) = delete;
  virtual ~PrintSource() = default;

  /// The next line as it stands in a G-code file; nothing after the last.
  std::optional<std::string> next();

  /// Layers begun so far, and in all (0 where nobody knows).
  std::size_t layer() const { return layer_; }
  virtual std::size_t layer_count() const = 0;

  /// Share of the print that has been handed out.
  virtual double fraction() const = 0;

  /// Filament that the print draws off the spool, mm. Known when the last line has been given.
  virtual double planned_filament() const = 0;

  /// How many lines are there without waiting.
  virtual transport::SourceLevel level() { return transport::SourceLevel::kPlenty; }

  /// What a file says of the printer that it is for.
  virtual transport::PrintHeader header() const { return {}; }

  /// Bytes of a file; -1 otherwise.
  virtual std::int64_t size() const { return -1; }

  /// What to tell the user at the end, one sentence each.
  virtual std::vector<std::string> warnings() const = 0;

 protected:
  virtual std::optional<std::string> next_line() = 0;

 private:
  std::size_t layer_ = 0;
};

/// A G-code file, or "-" for standard input. It is read once, as it is printed. Throws Failure when it cannot
/// be read or holds nothing to print.
std::unique_ptr<PrintSource> make_file_source(const std::string& path, const gcode::MachineLimits& limits);

/// A model, sliced while it is printed.
std::unique_ptr<PrintSource> make_model_source(std::unique_ptr<ModelGcode> gcode);

/// Whether a path is named like a G-code file, or is standard input.
bool is_gcode_name(const std::string& path);

}  // namespace lamina::tools
