#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace lamina::tools {

/// Makes SIGINT, SIGTERM and SIGHUP remove the guarded temporary files and end the program at once, with 128
/// + the signal's number.
void catch_interrupts();

/// From here on the first signal only raises a flag, for a verb that has to end in an orderly way; the second
/// one ends the program.
const std::atomic<bool>& defer_interrupts();

/// From here on Ctrl-C is only counted, up to the third; the fourth ends the program. SIGTERM and SIGHUP
/// count as two: nobody is there to be asked.
const std::atomic<int>& count_interrupts();

/// The deferred signal ended the work.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(const std::string& what_was_done);

  int signal;
};

/// While it lives, a signal that ends the program removes a temporary file. A few at a time are guarded, more
/// are not.
class TemporaryFileGuard {
 public:
  explicit TemporaryFileGuard(const std::filesystem::path& path);
  TemporaryFileGuard(const TemporaryFileGuard&) = delete;
  TemporaryFileGuard& operator=(const TemporaryFileGuard&) = delete;
  ~TemporaryFileGuard();

 private:
  std::size_t slot_;
};

}  // namespace lamina::tools
