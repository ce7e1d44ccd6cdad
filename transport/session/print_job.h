#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "transport/protocol/protocol_engine.h"
#include "transport/session/execution_log.h"
#include "transport/session/host_prompt.h"
#include "transport/session/journal.h"
#include "transport/session/parking.h"
#include "transport/session/printer_facts.h"
#include "transport/session/source_reader.h"
#include "transport/session/starvation.h"
#include "transport/time.h"

namespace lamina::transport {

/// How many lines a source has ready.
enum class SourceLevel {
  kEmpty,  ///< the next call would have to wait
  kSome,
  kPlenty  ///< enough to print for a while, or all that is left
};

struct PrintJobOptions {
  EngineOptions engine;
  /// Between two temperature reports, by M155 where the firmware has it, by M105 otherwise. 0: never ask.
  Duration temperature_interval = std::chrono::seconds(2);
  ParkOptions park;
  /// Try to switch the heaters off when the print fails and the printer may still listen.
  bool heaters_off_on_failure = true;

  /// Asked before the source is; empty: a source that never makes anybody wait.
  std::function<SourceLevel()> source_level;
  /// With an empty source, from the last line sent until the nozzle is parked.
  Duration source_patience = std::chrono::milliseconds(300);

  /// Looks at the printer before the first line of the print goes out; a reason stops the print.
  std::function<std::optional<std::string>(const PrinterFacts&)> check;

  /// What is printed and where, for the journal: a name, bytes (-1: not a file), a port.
  std::string source;
  std::int64_t source_size = -1;
  std::string port;
  int baud = 0;  ///< 0: not known

  /// Goes on with the print that this record tells of. The source must give the same lines, from the start.
  std::optional<JournalRecord> resume;
  /// Also if the printer has restarted since; see recover_commands.
  bool resume_after_restart = false;
};

enum class JobPhase {
  kConnecting,
  kChecking,  ///< the printer tells what it is
  kPrinting,
  kPausing,  ///< on the way to the parking place
  kPaused,
  kReturning,  ///< back to the part
  kFinishing,  ///< every line was sent; the printer is to end its moves
  kCancelling,
  kCompleted,  ///< every line acknowledged, every move ended
  kCancelled,  ///< heaters off
  kFailed
};

/// Who wanted a pause or a cancel.
enum class Instigator {
  kUser,
  kPrinter,  ///< by a host action, or it has paused by itself
  kSource    ///< no lines were ready
};

enum class JobFailure {
  kNone,
  kConversation,   ///< see the engine's Ended event
  kMismatch,       ///< the check refused the printer
  kSourceChanged,  ///< not the file that was being printed
  kNotResumable,   ///< the printer is not as the journal says
  kLine,           ///< a line that the printer cannot take
  kColdExtrusion,
  kDisconnected  ///< the printer asked for it
};

struct JobProgress {
  JobPhase phase = JobPhase::kConnecting;
  std::int64_t source_lines = 0;    ///< lines taken from the source, comments included
  std::int64_t source_bytes = 0;    ///< their bytes, line ends included
  std::int64_t job_lines_sent = 0;  ///< lines of the print sent, each once
  std::int64_t job_lines_acknowledged = 0;
  std::int64_t layer = 0;               ///< begun so far, as the file marks them
  std::int64_t layer_count = 0;         ///< 0: the file does not say
  std::optional<double> time_fraction;  ///< of the printing time, as the file tells
  std::optional<double> seconds_left;
  std::optional<double> height;     ///< mm, of the line sent last
  TemperatureReport temperatures;   ///< the latest; empty before the first
  std::optional<int> planner_free;  ///< blocks, as the last ok told
  EngineStatistics wire;
  Starvation starved;                  ///< at most, see StarvationClock
  bool cautious = false;               ///< one line at a time just now
  std::int64_t parked_for_source = 0;  ///< how often the source was too slow
  Instigator paused_by = Instigator::kUser;
  bool waits_for_user = false;  ///< the printer does (M0, M600); `answer` lets it go on
  HostPrompt prompt;
};

/// Prints what a line source gives: greets the printer, asks what it can, feeds the lines, watches
/// temperatures, pauses, resumes, ends or cancels cleanly, and keeps the record by which another process
/// could go on. Like the engine without I/O, clock or thread; it has the same calls.
class PrintJob {
 public:
  explicit PrintJob(LineSource source, PrintJobOptions options = {});

  void start(Instant now);
  void receive(std::string_view bytes, Instant now);
  void tick(Instant now);
  std::string take_output();
  std::vector<Event> take_events();
  std::optional<Instant> deadline() const;

  /// Sends a command in between, ahead of the waiting job lines and in order with other injected ones. Moves
  /// and changes of the position's meaning are taken only while parked, where `resume` makes up for them.
  /// Returns why it was not taken; nothing if it was.
  std::optional<std::string> inject(std::string_view command);

  /// Ends what is under way, parks the nozzle and waits for `resume`.
  void pause(Instant now);
  void resume(Instant now);

  /// Drops what was not sent, breaks off a wait for heaters, switches heaters off and parks. The phase
  /// becomes kCancelled when the printer has done so.
  void cancel(Instant now, Instigator by = Instigator::kUser);

  /// M112, past everything: the printer halts.
  void halt(Instant now);

  /// Answers a prompt by its button, or lets a printer go on that waits for its user.
  void answer(int button, Instant now);

  /// Leaves an object out from here on, by the name that the file gives it.
  void skip_object(const std::string& object);
  /// Those that the file has named so far, those that are left out, and the one at hand.
  const std::set<std::string>& objects() const { return reader_.filter().objects(); }
  const std::set<std::string>& skipped_objects() const { return reader_.filter().state().skipped; }
  const std::optional<std::string>& object() const { return reader_.filter().state().object; }

  bool finished() const;
  const JobProgress& progress() const { return progress_; }

  /// Why it failed, one line; empty otherwise.
  const std::string& failure() const { return failure_; }
  JobFailure failure_kind() const { return failure_kind_; }
  Instigator cancelled_by() const { return cancelled_by_; }

  /// What M115 told.
  const PrinterFacts& printer() const { return facts_; }

  /// To be written down before `take_output` is written to the port. `journal_revision` changes when it must
  /// be.
  const JournalRecord& journal() const { return log_.record(); }
  std::int64_t journal_revision() const { return revision_; }

  /// True once after a halt: what was taken and not written yet is to be thrown away.
  bool take_discard();

 private:
  void account_for_time(Instant now);
  void observe(Instant now);
  void observe(const Event& event, Instant now);
  void on_sent(const NumberedLine& line);
  void on_acknowledged(const LineAcknowledged& acknowledged, Instant now);
  void on_reply(const Reply& reply, Instant now);
  void on_host_action(const HostActionReply& action, Instant now);
  void on_unknown_command(const std::string& command);
  void on_ended(const Ended& ended);

  // --- start-up (print_job_start.cpp)
  bool prepare_resume();
  void on_connected();
  void on_rejoined(LineNumber next);
  void on_printer_known(Instant now);
  std::optional<std::string> rejoin_problem() const;
  void recover(const std::string& problem, Instant now);

  /// Submits what is due. False when there is nothing to submit now.
  bool supply(Instant now);
  bool ask_temperatures(Instant now);
  bool supply_job_line(Instant now);
  bool supply_parking(Instant now);
  bool supply_ending();
  void cool_down_parked(Instant now);
  void break_waits(Instant now);
  void park(Instant now, Instigator by);
  void go_back(Instant now);
  void submit_all(const std::vector<std::string>& commands);
  void set_phase(JobPhase phase);
  bool nozzle_is_hot() const;
  /// "line 120 of the file, 3.20 mm high, layer 17"
  std::string place() const;
  void fail(JobFailure kind, std::string why, bool may_listen);
  /// As a cancel, to end as a failure.
  void give_up(JobFailure kind, const std::string& why);

  PrintJobOptions options_;
  SourceReader reader_;
  ProtocolEngine engine_;
  ExecutionLog log_;
  StarvationClock starvation_;
  std::deque<SourceMark> supplied_;  ///< of job lines that the engine has not sent yet
  JobProgress progress_;
  PrinterFacts facts_;
  std::string failure_;
  JobFailure failure_kind_ = JobFailure::kNone;
  Instigator cancelled_by_ = Instigator::kUser;
  std::string last_words_;
  std::vector<Event> events_;
  /// What replies ask for; done when every event of the same bytes has been looked at.
  std::vector<std::function<void(Instant)>> deferred_;
  std::int64_t revision_ = 0;

  std::optional<LineNumber> rejoined_at_;  ///< the printer was found counting: the line it wants
  std::optional<MachineState> expected_;   ///< the state in which the printer should be found
  std::optional<PositionReply> found_;     ///< where it says that it is
  bool restarted_ = false;                 ///< resuming, and the printer has forgotten

  std::optional<Instant> poll_due_;
  std::optional<Instant> starved_since_;
  std::optional<Instant> look_again_;  ///< at an empty source
  Instant parked_since_{};
  Instant break_due_{};
  bool resume_wanted_ = false;  ///< while the nozzle is still on its way to the parking place
  bool ending_sent_ = false;
  bool discard_ = false;
};

}  // namespace lamina::transport
