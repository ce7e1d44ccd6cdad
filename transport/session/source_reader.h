#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "transport/session/command_filter.h"
#include "transport/session/progress_estimate.h"

namespace lamina::transport {

/// Gives the lines of a print one by one, as they stand in a G-code file; none: the print is over. It is
/// called when the wire can take another line, so slicing may go on behind it.
using LineSource = std::function<std::optional<std::string>()>;

/// A place between two lines of a source. The hash of everything before it tells one source from another, be
/// it a file, a pipe or a slicer that makes its lines anew.
struct SourcePosition {
  std::int64_t lines = 0;
  std::int64_t bytes = 0;  ///< line ends included
  std::uint64_t hash = kEmptyHash;

  static constexpr std::uint64_t kEmptyHash = 14695981039346656037U;

  bool operator==(const SourcePosition&) const = default;
};

/// Where a command comes from: it is the `part`-th (from 0) of those that a source line became.
struct SourceMark {
  std::int64_t line = 0;  ///< of the source, from 1
  int part = 0;
  bool last = true;                                 ///< of that line
  SourcePosition after;                             ///< behind that line
  std::shared_ptr<const FilterState> filter_after;  ///< behind that line
};

struct SourceCommand {
  std::string command;  ///< stripped, ready for the wire
  SourceMark mark;
};

/// The source is not the one that was being printed.
class SourceChanged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Turns source lines into commands for the wire: stripped, filtered, counted.
class SourceReader {
 public:
  explicit SourceReader(LineSource source);

  /// The next command; none at the end.
  std::optional<SourceCommand> next();

  /// Passes over everything up to `position`, where the filter had `state`, and over the first `parts`
  /// commands of the line that follows. Only before the first `next`. Throws SourceChanged if what is passed
  /// over is not what the hash says.
  void skip_to(const SourcePosition& position, FilterState state, int parts);

  /// Nothing more comes.
  void end();

  const SourcePosition& position() const { return position_; }
  CommandFilter& filter() { return filter_; }
  const CommandFilter& filter() const { return filter_; }
  const ProgressEstimate& progress() const { return progress_; }

 private:
  std::optional<std::string> take_line();

  LineSource source_;
  SourcePosition position_;
  CommandFilter filter_;
  ProgressEstimate progress_;
  std::deque<SourceCommand> ready_;  ///< of the line read last
};

}  // namespace lamina::transport
