#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "transport/session/journal.h"
#include "transport/time.h"

namespace lamina::transport {

/// When what was written is forced onto the disk. A host that is killed loses nothing either way: the system
/// holds what was written. It is for the host that loses its power.
enum class JournalSync {
  kNever,
  kInterval,  ///< every so often, if there was anything
  kLayer      ///< when a layer begins
};

struct JournalFileOptions {
  JournalSync sync = JournalSync::kInterval;
  Duration interval = std::chrono::seconds(1);
};

/// The journal on disk: two slots of fixed size, written in turn, each with its sequence number and a hash
/// over its content. A write that was torn leaves the other slot, which is one step older. The disk is waited
/// for in a thread of its own, so that the wire never does.
class JournalFile {
 public:
  /// Bytes of a slot; a record that would be longer is refused.
  static constexpr std::size_t kSlotBytes = std::size_t{64} * 1024;

  /// Opens or makes the file, for this process alone. Throws JournalError.
  explicit JournalFile(const std::filesystem::path& path, JournalFileOptions options = {});
  JournalFile(const JournalFile&) = delete;
  JournalFile& operator=(const JournalFile&) = delete;
  ~JournalFile();

  /// The newest record that is whole; none in a new file. Throws JournalError.
  std::optional<JournalRecord> read() const;

  /// Writes `record` over the older slot. Throws JournalError.
  void write(const JournalRecord& record);

  const std::filesystem::path& path() const { return path_; }

 private:
  void sync_when_due();

  std::filesystem::path path_;
  JournalFileOptions options_;
  int descriptor_ = -1;
  std::uint64_t sequence_ = 0;
  std::int64_t layer_ = -1;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool dirty_ = false;   ///< guarded by mutex_, as are the next two
  bool wanted_ = false;  ///< now, not at the end of the interval
  bool closing_ = false;
  std::thread syncer_;
};

}  // namespace lamina::transport
