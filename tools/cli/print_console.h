#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "transport/session/print_job.h"

namespace lamina::tools {

/// Acts on one line typed during a print; what it has to say about it, a line or more (empty: nothing). A
/// line that is no word of the console and looks like G-code goes to the printer.
std::string perform(std::string_view line, transport::PrintJob& job, transport::Instant now);

/// Where commands from the side come from: standard input, where it is a terminal and not the print itself,
/// and a named pipe. And Ctrl-C: with somebody at the terminal the first pauses and asks, the second cancels,
/// the third halts the printer; without, it begins with the second.
class PrintConsole {
 public:
  /// `pipe` may be empty. Throws Failure where it is no pipe.
  PrintConsole(bool input_is_print, const std::string& pipe, std::function<void(const std::string&)> say);
  PrintConsole(const PrintConsole&) = delete;
  PrintConsole& operator=(const PrintConsole&) = delete;
  ~PrintConsole();

  /// Reads what has been typed and acts on it. Never waits.
  void steer(transport::PrintJob& job, transport::Instant now);

  /// Ctrl-C came, however it was answered.
  bool interrupted() const { return interrupts_seen_ > 0; }

 private:
  struct Input {
    int descriptor = -1;
    std::string partial;
  };

  void take_lines(Input& input, transport::PrintJob& job, transport::Instant now);
  void heed_interrupts(transport::PrintJob& job, transport::Instant now);
  void tell_changes(const transport::PrintJob& job);

  std::function<void(const std::string&)> say_;
  Input terminal_;
  Input pipe_;
  int interrupts_seen_ = 0;
  bool told_waiting_ = false;
  bool told_paused_ = false;
};

}  // namespace lamina::tools
