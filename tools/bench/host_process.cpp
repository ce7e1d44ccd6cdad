#include "tools/bench/host_process.h"

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lamina::tools {

HostProcess::HostProcess(const std::vector<std::string>& command, const std::filesystem::path& messages) {
  std::vector<char*> pointers;
  for (const std::string& word : command) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error("cannot start another process");
  if (process_ > 0) return;
  const int log = ::open(messages.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::execv(pointers.front(), pointers.data());
  ::_exit(127);
}

std::optional<int> HostProcess::wait(double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto span = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  const Clock::time_point end = Clock::now() + span;
  while (true) {
    int status = 0;
    rusage used{};
    if (::wait4(process_, &status, WNOHANG, &used) == process_) {
      process_ = -1;
      constexpr long kKibibyte = 1024;
      peak_memory_ = used.ru_maxrss * kKibibyte;
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    if (Clock::now() >= end) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
}

void HostProcess::kill() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

}  // namespace lamina::tools
