#include "tools/bench/child_run.h"

#include <cstdio>
#include <exception>
#include <stdexcept>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lamina::tools {
namespace {

constexpr double kKilobytesInMegabyte = 1024.0;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// In the child; never returns.
[[noreturn]] void work_and_exit(const std::function<std::vector<double>()>& work, int to_parent) {
  int code = 1;
  try {
    const std::vector<double> values = work();
    const std::size_t size = values.size() * sizeof(double);
    if (write(to_parent, values.data(), size) == static_cast<ssize_t>(size)) code = 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
  _exit(code);
}

}  // namespace

ChildRun run_in_child(const std::function<std::vector<double>()>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot open a pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    close(ends[0]);
    work_and_exit(work, ends[1]);
  }
  close(ends[1]);
  ChildRun run;
  double value = 0.0;
  while (read(ends[0], &value, sizeof value) == static_cast<ssize_t>(sizeof value))
    run.values.push_back(value);
  close(ends[0]);
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("the measured process failed");
  run.peak_megabytes = static_cast<double>(usage.ru_maxrss) / kKilobytesInMegabyte;
  run.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return run;
}

}  // namespace lamina::tools
