#include "transport/session/runner.h"

#include <algorithm>
#include <array>
#include <string>

namespace lamina::transport {

namespace {

/// How long a cancel can go unnoticed, and the pace of progress calls when nothing happens.
constexpr Duration kLongestSleep = std::chrono::milliseconds(100);
/// For the last bytes of a print that has ended to leave.
constexpr Duration kLastBytes = std::chrono::seconds(2);
/// From the last byte read after a cancel until the printer counts as deaf.
constexpr Duration kCancelPatience = std::chrono::seconds(10);

class Clock {
 public:
  Instant now() const { return Instant{std::chrono::steady_clock::now() - start_}; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// One print over one port.
class Loop {
 public:
  Loop(Port& port, PrintJob& job, const PrintCallbacks& callbacks, const std::atomic<bool>& cancel)
      : port_(port), job_(job), callbacks_(callbacks), cancel_(cancel) {}

  PrintResult run() {
    PrintResult result;
    try {
      job_.start(clock_.now());
      exchange();
    } catch (const PortError& error) {
      result.failure = error.what();
    }
    result.elapsed = clock_.now().time_since_epoch();
    result.progress = job_.progress();
    if (result.failure.empty() || job_.finished()) {
      result.outcome = job_.progress().phase;
      result.failure = job_.failure();
    } else {
      result.progress.phase = JobPhase::kFailed;
    }
    return result;
  }

 private:
  void exchange() {
    std::optional<Instant> give_up;
    while (true) {
      const Instant now = clock_.now();
      if (cancel_ && !cancelled_) {
        cancelled_ = true;
        last_heard_ = now;
        job_.cancel(now);
      }
      read(now);
      job_.tick(now);
      write();
      report();
      if (job_.finished()) {
        if (!give_up) give_up = now + kLastBytes;
        if (unsent_.empty() || now >= *give_up) return;
      }
      if (cancelled_ && now >= last_heard_ + kCancelPatience) {
        throw PortError(PortProblem::kUnplugged, port_.name(),
                        "no answer to the cancel; switch the printer off");
      }
      port_.wait(std::clamp(time_to_sleep(now), Duration{}, kLongestSleep), !unsent_.empty());
    }
  }

  void read(Instant now) {
    std::array<char, 4096> bytes;
    while (const std::size_t count = port_.read(bytes)) {
      last_heard_ = now;
      job_.receive({bytes.data(), count}, now);
    }
  }

  void write() {
    unsent_ += job_.take_output();
    unsent_.erase(0, port_.write(unsent_));
  }

  void report() {
    for (const Event& event : job_.take_events()) {
      if (callbacks_.on_event) callbacks_.on_event(event);
    }
    if (callbacks_.on_progress) callbacks_.on_progress(job_.progress());
  }

  Duration time_to_sleep(Instant now) const {
    const std::optional<Instant> deadline = job_.deadline();
    return deadline ? *deadline - now : kLongestSleep;
  }

  Port& port_;
  PrintJob& job_;
  const PrintCallbacks& callbacks_;
  const std::atomic<bool>& cancel_;
  Clock clock_;
  std::string unsent_;
  bool cancelled_ = false;
  Instant last_heard_{};
};

}  // namespace

PrintResult run_print(Port& port, PrintJob& job, const PrintCallbacks& callbacks,
                      const std::atomic<bool>& cancel) {
  return Loop(port, job, callbacks, cancel).run();
}

}  // namespace lamina::transport
