#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "transport/emulator/emulator.h"
#include "transport/session/print_job.h"

namespace lamina::tests {

/// An emulated printer that outlives its hosts, joined to one job after the other by a perfect wire in
/// simulated time.
class SessionRig {
 public:
  explicit SessionRig(transport::EmulatorOptions options = recording())
      : emulator_(std::move(options), transport::Instant{}) {
    emulator_.take_output();
  }

  /// Beads are kept, and heating takes seconds.
  static transport::EmulatorOptions recording() {
    transport::EmulatorOptions options;
    options.record = transport::RecordDetail::kBeads;
    options.thermal.hotend = {200, 160, 8};
    options.thermal.bed = {200, 400, 4};
    options.thermal.residency = std::chrono::seconds(1);
    return options;
  }

  /// Runs the job until it has finished, nothing can happen any more, or `stop` says so, which is asked at
  /// every step. Returns false where it was stopped.
  bool run(
      transport::PrintJob& job, const std::function<bool()>& stop = [] { return false; }) {
    job.start(now_);
    return go_on(job, stop);
  }

  /// The same for a job that was started.
  bool go_on(
      transport::PrintJob& job, const std::function<bool()>& stop = [] { return false; }) {
    constexpr int kMostSteps = 10'000'000;
    for (int step = 0; step < kMostSteps; ++step) {
      if (!exchange(job, stop)) return false;
      if (job.finished() && on_wire_.empty()) break;
      const std::optional<transport::Instant> next = next_event(job);
      if (!next) break;
      now_ = std::max(now_, *next);
    }
    let_printer_finish();
    return true;
  }

  /// The host is gone: `bytes` of what it had sent last still arrive; the printer ends what it has.
  void lose_host(std::size_t bytes) {
    on_wire_.resize(std::min(bytes, on_wire_.size()));
    while (!on_wire_.empty()) {
      on_wire_.erase(0, emulator_.receive(on_wire_, now_));
      const std::optional<transport::Instant> next = emulator_.next_event();
      if (!next) break;
      now_ = std::max(now_, *next);
      emulator_.advance(now_);
    }
    emulator_.take_output();
  }

  void let_printer_finish() {
    while (const std::optional<transport::Instant> next = emulator_.machine().next_event()) {
      now_ = std::max(now_, *next);
      emulator_.advance(now_);
    }
  }

  transport::Emulator& printer() { return emulator_; }
  transport::Instant now() const { return now_; }
  void wait(transport::Duration span) {
    now_ += span;
    emulator_.advance(now_);
  }
  /// Bytes that the host has sent and the printer has not taken.
  std::size_t on_wire() const { return on_wire_.size(); }
  /// Everything that the hosts sent.
  const std::string& sent() const { return sent_; }

 private:
  /// Asks whether to stop when the job has said something and the printer has not heard it yet.
  bool exchange(transport::PrintJob& job, const std::function<bool()>& stop) {
    emulator_.advance(now_);
    for (int round = 0; round < 100; ++round) {
      on_wire_.erase(0, emulator_.receive(on_wire_, now_));
      const std::string said = emulator_.take_output();
      if (!said.empty()) job.receive(said, now_);
      job.tick(now_);
      const std::string more = job.take_output();
      sent_ += more;
      on_wire_ += more;
      job.take_events();
      if (stop()) return false;
      if (said.empty() && more.empty()) break;
    }
    return true;
  }

  std::optional<transport::Instant> next_event(const transport::PrintJob& job) const {
    std::optional<transport::Instant> next = job.deadline();
    const auto printer = emulator_.next_event();
    if (printer && (!next || *printer < *next)) next = printer;
    return next;
  }

  transport::Emulator emulator_;
  transport::Instant now_{};
  std::string on_wire_;
  std::string sent_;
};

}  // namespace lamina::tests
