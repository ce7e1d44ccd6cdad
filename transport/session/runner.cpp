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
  explicit Clock(double scale) : scale_(scale) {}

  Instant now() const {
    const Duration real = std::chrono::steady_clock::now() - start_;
    return Instant{scale_ == 1 ? real : from_seconds(to_seconds(real) * scale_)};
  }

  /// How long a span of the job's time takes.
  Duration real(Duration span) const { return scale_ == 1 ? span : from_seconds(to_seconds(span) / scale_); }

 private:
  double scale_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Everything that has arrived at `port`, in pieces.
template <typename Take>
void read_all(Port& port, const Take& take) {
  std::array<char, 4096> bytes;
  while (const std::size_t count = port.read(bytes)) take(std::string_view(bytes.data(), count));
}

/// One print over one port.
class Loop {
 public:
  Loop(Port& port, PrintJob& job, const RunOptions& options, const std::atomic<bool>& cancel)
      : port_(port), job_(job), options_(options), cancel_(cancel), clock_(options.time_scale) {}

  PrintResult run() {
    PrintResult result;
    try {
      job_.start(clock_.now());
      exchange();
    } catch (const PortError& error) {
      result.failure = error.what();
    } catch (const JournalError& error) {
      result.failure = error.what();
    }
    result.elapsed = clock_.now().time_since_epoch();
    result.progress = job_.progress();
    if (result.failure.empty() || job_.finished()) {
      result.outcome = job_.progress().phase;
      result.failure = job_.failure();
      result.failure_kind = job_.failure_kind();
      result.cancelled_by = job_.cancelled_by();
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
      if (options_.steer) options_.steer(job_, now);
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
      port_.wait(std::clamp(clock_.real(time_to_sleep(now)), Duration{}, kLongestSleep), !unsent_.empty());
    }
  }

  void read(Instant now) {
    read_all(port_, [&](std::string_view bytes) {
      last_heard_ = now;
      job_.receive(bytes, now);
    });
  }

  void write() {
    const std::string output = job_.take_output();
    keep_journal();
    if (job_.take_discard()) {
      unsent_.clear();
      port_.discard();
    }
    unsent_ += output;
    unsent_.erase(0, port_.write(unsent_));
  }

  /// Before the lines that it names go out.
  void keep_journal() {
    if (options_.journal == nullptr || job_.journal_revision() == written_) return;
    written_ = job_.journal_revision();
    if (job_.progress().phase != JobPhase::kFailed) options_.journal->write(job_.journal());
  }

  void report() {
    const PrintCallbacks& callbacks = options_.callbacks;
    for (const Event& event : job_.take_events()) {
      if (callbacks.on_event) callbacks.on_event(event);
    }
    if (callbacks.on_progress) callbacks.on_progress(job_.progress());
  }

  Duration time_to_sleep(Instant now) const {
    const std::optional<Instant> deadline = job_.deadline();
    return deadline ? *deadline - now : kLongestSleep;
  }

  Port& port_;
  PrintJob& job_;
  const RunOptions& options_;
  const std::atomic<bool>& cancel_;
  Clock clock_;
  std::string unsent_;
  std::int64_t written_ = 0;
  bool cancelled_ = false;
  Instant last_heard_{};
};

}  // namespace

PrintResult run_print(Port& port, PrintJob& job, const RunOptions& options, const std::atomic<bool>& cancel) {
  return Loop(port, job, options, cancel).run();
}

void run_commands(Port& port, CommandSession& session,
                  const std::function<void(const CommandAnswer&)>& on_answer, const std::atomic<bool>& cancel,
                  double time_scale) {
  const Clock clock(time_scale);
  std::string unsent;
  session.start(clock.now());
  while (true) {
    const Instant now = clock.now();
    if (cancel) session.stop();
    read_all(port, [&](std::string_view bytes) { session.receive(bytes, now); });
    session.tick(now);
    for (const CommandAnswer& answer : session.take_answers()) on_answer(answer);
    unsent += session.take_output();
    unsent.erase(0, port.write(unsent));
    if (session.finished() && unsent.empty()) return;
    const Duration sleep = session.deadline() ? clock.real(*session.deadline() - now) : kLongestSleep;
    port.wait(std::clamp(sleep, Duration{}, kLongestSleep), !unsent.empty());
  }
}

}  // namespace lamina::transport
