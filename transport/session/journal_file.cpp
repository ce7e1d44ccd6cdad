#include "transport/session/journal_file.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace lamina::transport {

namespace {

/// "sequence length hash\n" in front of the record, in fixed width.
constexpr std::size_t kHeaderBytes = 20 + 1 + 8 + 1 + 16 + 1;

std::uint64_t hash_of(std::string_view sequence, std::string_view text) {
  constexpr std::uint64_t kPrime = 1099511628211U;
  std::uint64_t hash = SourcePosition::kEmptyHash;
  for (const std::string_view part : {sequence, text}) {
    for (const char c : part) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  }
  return hash;
}

struct Slot {
  std::uint64_t sequence = 0;
  std::string text;
};

/// None if nothing whole is there.
std::optional<Slot> read_slot(int descriptor, std::size_t index) {
  std::string bytes(JournalFile::kSlotBytes, '\0');
  const ssize_t count =
      ::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(index * JournalFile::kSlotBytes));
  if (count < static_cast<ssize_t>(kHeaderBytes)) return std::nullopt;
  bytes.resize(static_cast<std::size_t>(count));
  const auto number = [&bytes](std::size_t at, std::size_t size, int base) {
    std::uint64_t value = 0;
    std::from_chars(bytes.data() + at, bytes.data() + at + size, value, base);
    return value;
  };
  const std::uint64_t length = number(21, 8, 10);
  if (length > bytes.size() - kHeaderBytes) return std::nullopt;
  Slot slot{number(0, 20, 10), bytes.substr(kHeaderBytes, length)};
  const std::string_view sequence = std::string_view(bytes).substr(0, 20);
  if (number(30, 16, 16) != hash_of(sequence, slot.text)) return std::nullopt;
  return slot;
}

std::optional<Slot> newest_slot(int descriptor) {
  std::optional<Slot> newest;
  for (const std::size_t index : {0U, 1U}) {
    std::optional<Slot> slot = read_slot(descriptor, index);
    if (slot && (!newest || slot->sequence > newest->sequence)) newest = std::move(slot);
  }
  return newest;
}

JournalError failed(const std::filesystem::path& path, const char* what) {
  return JournalError(
      fmt::format("{}: the journal cannot be {}: {}; choose another place with --journal, or "
                  "print without one (--no-journal)",
                  path.string(), what, std::generic_category().message(errno)));
}

}  // namespace

JournalFile::JournalFile(const std::filesystem::path& path, JournalFileOptions options)
    : path_(path), options_(options) {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw failed(path_, "opened");
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor_);
    throw JournalError(path.string() + ": another lamina is writing this journal; wait until it has ended");
  }
  if (const auto newest = newest_slot(descriptor_)) sequence_ = newest->sequence;
  if (options_.sync != JournalSync::kNever) syncer_ = std::thread([this] { sync_when_due(); });
}

JournalFile::~JournalFile() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  if (syncer_.joinable()) syncer_.join();
  ::close(descriptor_);
}

std::optional<JournalRecord> JournalFile::read() const {
  const std::optional<Slot> newest = newest_slot(descriptor_);
  if (!newest) return std::nullopt;
  return decode(newest->text);
}

void JournalFile::write(const JournalRecord& record) {
  const std::string text = encode(record);
  if (text.size() > kSlotBytes - kHeaderBytes) {
    throw JournalError(fmt::format("{}: a record of {} bytes does not fit into the journal (most: {})",
                                   path_.string(), text.size(), kSlotBytes - kHeaderBytes));
  }
  ++sequence_;
  const std::string sequence = fmt::format("{:020}", sequence_);
  const std::string bytes =
      fmt::format("{} {:08} {:016x}\n{}", sequence, text.size(), hash_of(sequence, text), text);
  const auto at = static_cast<off_t>(sequence_ % 2 * kSlotBytes);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count =
        ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, at + static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw failed(path_, "written");
    done += static_cast<std::size_t>(count);
  }
  if (options_.sync == JournalSync::kNever) return;
  const bool new_layer = std::exchange(layer_, record.layer) != record.layer;
  const std::lock_guard lock(mutex_);
  dirty_ = true;
  if (options_.sync == JournalSync::kLayer && new_layer) {
    wanted_ = true;
    changed_.notify_all();
  }
}

void JournalFile::sync_when_due() {
  std::unique_lock lock(mutex_);
  while (!closing_) {
    if (options_.sync == JournalSync::kInterval) {
      changed_.wait_for(lock, options_.interval, [this] { return closing_; });
    } else {
      changed_.wait(lock, [this] { return closing_ || wanted_; });
    }
    if (!std::exchange(dirty_, false)) continue;
    wanted_ = false;
    lock.unlock();
    ::fdatasync(descriptor_);
    lock.lock();
  }
}

}  // namespace lamina::transport
