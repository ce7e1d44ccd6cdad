#include "tools/cli/interrupt.h"

#include <algorithm>
#include <array>
#include <climits>
#include <csignal>
#include <string>
#include <string_view>

#include <unistd.h>

namespace lamina::tools {
namespace {

struct GuardedFile {
  std::array<char, PATH_MAX> path{};
  std::atomic<bool> used{false};
};

// A signal handler reaches nothing but globals.
std::atomic<bool> deferred{false};
std::atomic<bool> counted{false};
std::atomic<int> count{0};
std::atomic<bool> requested{false};
std::atomic<int> requested_by{0};
std::array<GuardedFile, 4> guarded_files;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

constexpr int kMostCounted = 3;
constexpr int kSignalBase = 128;
constexpr std::string_view kLastWords = "\ninterrupted\n";  // The first line end closes a progress bar.

void on_signal(int signal) {
  if (counted && count < kMostCounted) {
    count += signal == SIGINT ? 1 : 2;
    requested_by = signal;
    return;
  }
  if (deferred && !requested.exchange(true)) {
    requested_by = signal;
    return;
  }
  for (const GuardedFile& file : guarded_files) {
    if (file.used) unlink(file.path.data());
  }
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kLastWords.data(), kLastWords.size());
  _exit(kSignalBase + signal);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    // Whoever started the program under nohup means it.
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

const std::atomic<bool>& defer_interrupts() {
  deferred = true;
  return requested;
}

const std::atomic<int>& count_interrupts() {
  counted = true;
  return count;
}

Interrupted::Interrupted(const std::string& what_was_done)
    : std::runtime_error(what_was_done), signal(requested_by) {}

TemporaryFileGuard::TemporaryFileGuard(const std::filesystem::path& path) : slot_(guarded_files.size()) {
  const std::string name = path.string();
  if (name.size() >= PATH_MAX) return;
  for (std::size_t slot = 0; slot < guarded_files.size() && slot_ == guarded_files.size(); ++slot) {
    GuardedFile& file = guarded_files[slot];
    if (file.used) continue;
    std::copy(name.begin(), name.end(), file.path.begin());
    file.path[name.size()] = '\0';
    file.used = true;
    slot_ = slot;
  }
}

TemporaryFileGuard::~TemporaryFileGuard() {
  if (slot_ < guarded_files.size()) guarded_files[slot_].used = false;
}

}  // namespace lamina::tools
