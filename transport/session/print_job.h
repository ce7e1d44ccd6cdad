#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transport/protocol/protocol_engine.h"
#include "transport/time.h"

namespace lamina::transport {

/// Gives the lines of a print one by one, as they stand in a G-code file; none: the print is over. It is
/// called when the wire can take another line, so slicing may go on behind it.
using LineSource = std::function<std::optional<std::string>()>;

struct PrintJobOptions {
  EngineOptions engine;
  /// Between two temperature reports, by M155 where the firmware has it, by M105 otherwise. 0: never ask.
  Duration temperature_interval = std::chrono::seconds(2);
  /// What a cancelled print ends with, in this order.
  std::vector<std::string> cancel_commands{"M104 S0", "M140 S0", "M107", "M84"};
  /// Try to switch the heaters off when the print fails and the printer may still listen.
  bool heaters_off_on_failure = true;
};

enum class JobPhase {
  kConnecting,
  kPrinting,
  kFinishing,  ///< every line was sent; the printer is to end its moves
  kCancelling,
  kCompleted,  ///< every line acknowledged, every move ended
  kCancelled,  ///< heaters off
  kFailed
};

struct JobProgress {
  JobPhase phase = JobPhase::kConnecting;
  std::int64_t source_lines = 0;    ///< lines taken from the source, comments included
  std::int64_t source_bytes = 0;    ///< their bytes, line ends included
  std::int64_t job_lines_sent = 0;  ///< lines of the print sent, each once
  std::int64_t job_lines_acknowledged = 0;
  TemperatureReport temperatures;  ///< the latest; empty before the first
  EngineStatistics wire;
  bool cautious = false;  ///< one line at a time just now
};

/// Prints what a line source gives: greets the printer, asks what it can, feeds the lines, watches
/// temperatures, ends or cancels cleanly. Like the engine without I/O, clock or thread; it has the same
/// calls.
class PrintJob {
 public:
  explicit PrintJob(LineSource source, PrintJobOptions options = {});

  void start(Instant now);
  void receive(std::string_view bytes, Instant now);
  void tick(Instant now);
  std::string take_output();
  std::vector<Event> take_events();
  std::optional<Instant> deadline() const;

  /// Sends a command in between, ahead of the waiting job lines and in order with other injected ones.
  /// Ignored once the job is ending.
  void inject(std::string_view command);

  /// Drops what was not sent, breaks off a wait for heaters, switches heaters off. The phase becomes
  /// kCancelled when the printer has done so.
  void cancel(Instant now);

  bool finished() const;
  const JobProgress& progress() const { return progress_; }

  /// Why it failed, one line; empty otherwise.
  const std::string& failure() const { return failure_; }

  /// What M115 told: capability -> present.
  const std::map<std::string, bool>& capabilities() const { return capabilities_; }
  const FirmwareReply& firmware() const { return firmware_; }

 private:
  void observe(Instant now);
  void observe(const Event& event, Instant now);
  void on_connected();
  void on_acknowledged(const NumberedLine& line, Instant now);
  void on_reply(const Reply& reply);
  void on_ended(const Ended& ended);
  /// Submits what is due. False when there is nothing to submit now.
  bool supply(Instant now);
  bool ask_temperatures(Instant now);
  bool supply_job_line();
  bool supply_ending();
  std::optional<std::string> next_command();
  void fail(std::string why, bool may_listen);

  LineSource source_;
  PrintJobOptions options_;
  ProtocolEngine engine_;
  JobProgress progress_;
  std::string failure_;
  std::string last_words_;
  std::vector<Event> events_;
  std::map<std::string, bool> capabilities_;
  FirmwareReply firmware_;
  std::optional<Instant> poll_due_;
  bool ending_sent_ = false;
};

}  // namespace lamina::transport
