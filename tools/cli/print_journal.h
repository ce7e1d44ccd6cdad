#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "tools/cli/command_line.h"
#include "transport/session/journal_file.h"

namespace lamina::tools {

/// Where the journal of a print is kept and how.
struct JournalArguments {
  std::string path;
  bool none = false;
  std::string sync;
  bool resume = false;
  bool after_restart = false;

  void declare(OptionSet& options);

  /// Throws Failure for arguments that exclude each other or make no sense.
  void check(bool emulated) const;
};

/// The journal of one print, and what an earlier one left in it.
struct PrintJournal {
  std::unique_ptr<transport::JournalFile> file;  ///< Null: none is kept.
  std::optional<transport::JournalRecord> left;  ///< To go on with.
  std::string forgotten;  ///< An unfinished print that can no longer be resumed; empty: none.
};

/// Opens the journal for a print of `source` (its name, `size` bytes) on `port`. Throws Failure where there
/// is nothing to resume, or something else was being printed.
PrintJournal open_journal(const JournalArguments& arguments, const std::string& source, std::int64_t size,
                          const std::string& port);

}  // namespace lamina::tools
