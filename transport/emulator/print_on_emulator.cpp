#include "transport/emulator/print_on_emulator.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

constexpr Duration kProgressInterval = std::chrono::milliseconds(100);

class Simulation {
 public:
  Simulation(LineSource source, const EmulatedPrintOptions& options)
      : options_(options),
        job_(std::move(source), options.job),
        emulator_(options.emulator),
        to_printer_(options.to_printer),
        to_host_(options.to_host) {}

  EmulatedPrint run() {
    EmulatedPrint print;
    job_.start(now_);
    bool cancelled = false;
    while (true) {
      exchange();
      report();
      if (job_.finished()) break;
      if (options_.steer) options_.steer(job_, now_);
      if (!cancelled && options_.cancelled && options_.cancelled()) {
        cancelled = true;
        job_.cancel(now_);
        continue;
      }
      const std::optional<Instant> next = next_event();
      if (!next || next->time_since_epoch() > options_.time_limit) {
        print.result.failure =
            fmt::format("the emulated print hung after {:.0f} s", to_seconds(now_.time_since_epoch()));
        break;
      }
      now_ = std::max(now_, *next);
    }
    let_printer_finish();
    print.result.progress = job_.progress();
    print.result.outcome = job_.finished() ? job_.progress().phase : JobPhase::kFailed;
    if (job_.finished()) print.result.failure = job_.failure();
    print.result.failure_kind = job_.failure_kind();
    print.result.cancelled_by = job_.cancelled_by();
    print.result.elapsed = now_.time_since_epoch();
    print.report = emulator_.report();
    print.beads = emulator_.beads();
    return print;
  }

 private:
  /// Lets everything that is due at `now_` happen.
  void exchange() {
    emulator_.advance(now_);
    const std::string for_printer = to_printer_.take_arrived(now_);
    if (!for_printer.empty()) {
      const std::size_t taken = emulator_.receive(for_printer, now_);
      to_printer_.put_back(std::string_view(for_printer).substr(taken), now_);
      printer_full_ = taken < for_printer.size();
    }
    to_host_.send(emulator_.take_output(), now_);
    const std::string for_host = to_host_.take_arrived(now_);
    if (!for_host.empty()) job_.receive(for_host, now_);
    job_.tick(now_);
    const std::string sent = job_.take_output();
    to_printer_.send(sent, now_);
    if (!sent.empty()) printer_full_ = false;
  }

  std::optional<Instant> next_event() const {
    std::optional<Instant> next = job_.deadline();
    const auto consider = [&next](std::optional<Instant> candidate) {
      if (candidate && (!next || *candidate < *next)) next = candidate;
    };
    consider(emulator_.next_event());
    consider(to_host_.next_arrival());
    // Bytes that the printer has no room for wait for something to happen there, not for time to pass.
    if (!printer_full_) consider(to_printer_.next_arrival());
    return next;
  }

  void report() {
    for (const Event& event : job_.take_events()) {
      if (options_.callbacks.on_event) options_.callbacks.on_event(event);
    }
    if (!options_.callbacks.on_progress || (now_ < progress_due_ && !job_.finished())) return;
    progress_due_ = now_ + kProgressInterval;
    options_.callbacks.on_progress(job_.progress());
  }

  /// A print that failed leaves moves in the planner; they are part of what was deposited.
  void let_printer_finish() {
    emulator_.receive(to_printer_.take_arrived(Instant::max()), now_);
    while (const std::optional<Instant> next = emulator_.machine().next_event()) {
      now_ = std::max(now_, *next);
      emulator_.advance(now_);
    }
  }

  const EmulatedPrintOptions& options_;
  PrintJob job_;
  Emulator emulator_;
  Wire to_printer_;
  Wire to_host_;
  Instant now_{};
  Instant progress_due_{};
  bool printer_full_ = false;
};

}  // namespace

EmulatedPrint print_on_emulator(LineSource source, const EmulatedPrintOptions& options) {
  return Simulation(std::move(source), options).run();
}

}  // namespace lamina::transport
