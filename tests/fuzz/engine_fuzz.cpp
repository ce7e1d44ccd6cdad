#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_targets.h"
#include "transport/protocol/protocol_engine.h"

namespace lamina::fuzz {

using namespace transport;

namespace {

constexpr std::array kCommands{"G1 X10.5 Y-0.250 E0.03",
                               "G1 X1",
                               "G1 X10.5 E1",
                               "G28",
                               "M109 S200",
                               "M105",
                               "M114",
                               "M400",
                               "M110 N5",
                               "M117 hello",
                               "G4 P100",
                               "M0",
                               "G92 E0"};

constexpr std::array kWords{"ok\n",
                            "ok T:20.0 /0.0 @:0\n",
                            "echo:busy: processing\n",
                            "wait\n",
                            "start\n",
                            "Error:checksum mismatch, Last Line: 1\nResend: 2\nok\n",
                            "echo:Unknown command: \"1 X8\"\nok\n",
                            "Cap:MEATPACK:1\n",
                            "[MP] PV01 ON NSP\n",
                            "[MP] PV01 ON ESP\n",
                            " T:20.0 /200.0 @:127 W:?\n",
                            "Error:Printer halted. kill() called!\n",
                            "Resend: 1\n",
                            "//action:pause\n",
                            "okok\n",
                            "Error:Line Number is not Last Line Number+1, Last Line: 0\n",
                            "echo:busy: paused for user\n",
                            "Error:No Checksum with line number, Last Line: 1\nResend: 2\nok\n",
                            "X:1.00 Y:0.00 Z:0.00 E:0.00 Count X:0 Y:0 Z:0\nok\n",
                            "X:10.50 Y:-0.25 Z:0.00 E:0.00 Count X:0 Y:0 Z:0\nok\n"};

/// Where the engine may be when the script begins: each of its states, and what makes a difference within
/// one.
enum class Situation {
  kIdle,
  kWaitingForStart,
  kWaitingToRejoin,
  kGreeting,
  kSettling,
  kNothingToDo,
  kLinesOnTheirWay,
  kEndHeld,         ///< a line's end is held back
  kHeldLineBroken,  ///< it was when an error came: what has left of it has to be erased
  kBlocked,         ///< a heating line runs
  kPaused,          ///< M0 has been taken and waits for the user
  kUrgent,          ///< a line without a number is on its way
  kWritingFile,
  kNegotiating,  ///< the printer is asked to unpack
  kPacked,
  kPlainForGood,  ///< was packed
  kDraining,      ///< to go back
  kOlderLinesRun,
  kPlaceAsked,  ///< where the printer is
  kRanWithoutNumber,
  kProbing,
  kQuestionAsked,
  kRejoinProbing,
  kRejoined,
  kCautious,  ///< one line at a time for good
  kEnded
};
constexpr unsigned kSituations = static_cast<unsigned>(Situation::kEnded) + 1;

constexpr const char* kRefusedLine1 = "Error:checksum mismatch, Last Line: 0\nResend: 1\nok\n";

/// Reads the script and acts it out.
class Script {
 public:
  explicit Script(std::string_view input)
      : input_(input),
        options_(options(next())),
        situation_(static_cast<Situation>(next() % kSituations)),
        engine_(suited(options_, situation_)) {}

  void run() {
    start();
    while (!input_.empty()) {
      step();
      look();
    }
    // Left alone with a silent printer, it comes to an end or has nothing to wait for.
    for (int i = 0; i < 1000; ++i) {
      const auto deadline = engine_.deadline();
      if (!deadline) break;
      require(*deadline > now_, "a deadline in the past");
      now_ = *deadline;
      engine_.tick(now_);
      look();
    }
    require(!engine_.deadline() || engine_.state() == EngineState::kEnded, "waits for ever");
  }

 private:
  static EngineOptions options(unsigned char how) {
    EngineOptions options;
    options.window.lines = 1 + how % 4U;
    options.window.hold_ends = (how & 4U) != 0;
    options.meatpack = (how & 8U) != 0;
    options.meatpack_after = 0;
    options.form.blanks = (how & 16U) != 0;
    options.cautious_lines = (how & 32U) != 0 ? 3 : 200;
    options.history_lines = (how & 64U) != 0 ? 4 : 256;
    options.baud = (how & 128U) != 0 ? 0 : 115200;
    return options;
  }

  /// `options`, but for what the situation needs.
  static EngineOptions suited(EngineOptions options, Situation situation) {
    switch (situation) {
      case Situation::kEndHeld:
      case Situation::kHeldLineBroken:
        options.window = {3, 127, true};
        break;
      case Situation::kLinesOnTheirWay:
      case Situation::kOlderLinesRun:
        options.window = {3, 127, false};
        break;
      case Situation::kNegotiating:
      case Situation::kPacked:
      case Situation::kPlainForGood:
        options.window.lines = std::max<std::size_t>(options.window.lines, 2);
        options.meatpack = true;
        break;
      case Situation::kPlaceAsked:
      case Situation::kRanWithoutNumber:
        options.window.lines = 1;
        break;
      case Situation::kCautious:
        options.noisy_resends = 1;
        break;
      default:
        break;
    }
    return options;
  }

  unsigned char next() {
    if (input_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(input_.front());
    input_.remove_prefix(1);
    return byte;
  }

  void hear(const std::string& reply) { engine_.receive(reply, now_); }

  void submit(std::string command) {
    engine_.submit(std::move(command), LineOrigin::kJob);
    engine_.tick(now_);
  }

  /// A line that has run.
  void run_line(std::string command) {
    submit(std::move(command));
    hear("ok\n");
  }

  void settle() {
    engine_.connect(now_);
    wait(std::chrono::seconds(3));
    hear("ok\n");
    wait(std::chrono::seconds(1));
  }

  void is_in(EngineState state) { require(engine_.state() == state, "not where the script is to begin"); }

  /// Takes the engine there.
  void start() {
    switch (situation_) {
      case Situation::kIdle:
        return is_in(EngineState::kIdle);
      case Situation::kWaitingForStart:
        engine_.connect(now_);
        return is_in(EngineState::kWaitingForStart);
      case Situation::kGreeting:
        engine_.connect(now_);
        wait(std::chrono::seconds(3));
        return is_in(EngineState::kGreeting);
      case Situation::kSettling:
        engine_.connect(now_);
        wait(std::chrono::seconds(3));
        hear("ok\n");
        return is_in(EngineState::kSettling);
      case Situation::kWaitingToRejoin:
      case Situation::kRejoinProbing:
      case Situation::kRejoined:
        return rejoin();
      case Situation::kEnded:
        engine_.connect(now_);
        engine_.close("at the start");
        return is_in(EngineState::kEnded);
      default:
        settle();
        is_in(EngineState::kStreaming);
        begin_print();
    }
  }

  void rejoin() {
    engine_.rejoin(now_);
    is_in(EngineState::kWaitingForStart);
    if (situation_ == Situation::kWaitingToRejoin) return;
    wait(std::chrono::seconds(3));
    wait(std::chrono::seconds(1));
    is_in(EngineState::kProbing);
    if (situation_ == Situation::kRejoinProbing) return;
    hear("Error:Line Number is not Last Line Number+1, Last Line: 7\nResend: 8\nok\n");
    is_in(EngineState::kDraining);
  }

  void begin_print() {
    switch (situation_) {
      case Situation::kLinesOnTheirWay:
        for (int i = 0; i < 5; ++i) submit("G1 X1");
        require(engine_.outstanding().size() >= 2, "not where the script is to begin");
        break;
      case Situation::kEndHeld:
      case Situation::kHeldLineBroken:
        for (int i = 0; i < 5; ++i) submit("G1 X1");
        require(engine_.outstanding().back().held, "not where the script is to begin");
        if (situation_ == Situation::kHeldLineBroken) hear(kRefusedLine1);
        break;
      case Situation::kBlocked:
        submit("M109 S200");
        hear("echo:busy: processing\n");
        break;
      case Situation::kPaused:
        submit("M0");
        hear("echo:busy: paused for user\n");
        submit("G1 X1");
        break;
      case Situation::kUrgent:
        engine_.send_urgent("M108", now_);
        ++urged_;
        break;
      case Situation::kWritingFile:
        run_line("M28 A.GCO");
        submit("G1 X1");
        break;
      case Situation::kNegotiating:
      case Situation::kPacked:
      case Situation::kPlainForGood:
        hear("Cap:MEATPACK:1\n");
        if (situation_ == Situation::kNegotiating) break;
        hear("[MP] PV01 ON NSP\n[MP] PV01 ON ESP\n");
        require(engine_.packs(), "not where the script is to begin");
        for (int i = 0; i < 5; ++i) submit("G1 X1 E-.5");
        if (situation_ == Situation::kPlainForGood) hear(kRefusedLine1);
        break;
      case Situation::kDraining:
        submit("G1 X1");
        hear(kRefusedLine1);
        is_in(EngineState::kDraining);
        break;
      case Situation::kOlderLinesRun:
        for (int i = 0; i < 5; ++i) submit("G1 X1");
        hear("Error:checksum mismatch, Last Line: 1\nResend: 2\nok\n");
        is_in(EngineState::kDraining);
        break;
      case Situation::kPlaceAsked:
      case Situation::kRanWithoutNumber:
        lose_number();
        break;
      case Situation::kProbing:
      case Situation::kQuestionAsked:
        submit("G1 X1");
        wait(std::chrono::seconds(30));
        if (situation_ == Situation::kQuestionAsked) wait(std::chrono::seconds(1));
        is_in(EngineState::kProbing);
        break;
      case Situation::kCautious:
        submit("G1 X1");
        hear(kRefusedLine1);
        wait(std::chrono::seconds(1));
        require(engine_.cautious(), "not where the script is to begin");
        break;
      default:
        break;
    }
  }

  void lose_number() {
    run_line("G1 X1 E1");
    submit("G1 X2 E1");
    hear("Error:No Checksum with line number, Last Line: 1\nResend: 2\nok\n");
    wait(std::chrono::milliseconds(50));
    wait(std::chrono::milliseconds(50));
    hear("Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n");
    wait(std::chrono::milliseconds(50));
    require(engine_.take_output().find("M110") != std::string::npos, "not where the script is to begin");
    if (situation_ == Situation::kPlaceAsked) return;
    for (int i = 0; i < 2; ++i) hear("X:2.00 Y:0.00 Z:0.00 E:1.00 Count X:0 Y:0 Z:0\nok\n");
    is_in(EngineState::kStreaming);
  }

  void step() {
    const unsigned char what = next();
    switch (what % 8U) {
      case 0: {
        const std::size_t length = std::min<std::size_t>(what / 8U, input_.size());
        engine_.receive(input_.substr(0, length), now_);
        input_.remove_prefix(length);
        break;
      }
      case 1:
      case 2:
        engine_.receive(kWords[next() % kWords.size()], now_);
        break;
      case 3:
        engine_.submit(kCommands[next() % kCommands.size()],
                       what < 64 ? LineOrigin::kInjected : LineOrigin::kJob);
        break;
      case 4:
        wait(std::chrono::milliseconds(1LL << (next() % 17U)));
        break;
      case 5:
        // What a good printer would say of the oldest line.
        if (!engine_.outstanding().empty() && engine_.outstanding().front().number)
          engine_.receive("ok N" + std::to_string(*engine_.outstanding().front().number) + " P14 B3\n", now_);
        break;
      case 6:
        if (what == 6) {
          engine_.send_urgent("M108", now_);
          ++urged_;
        }
        if (what == 14) engine_.drop_queued();
        if (what == 22) engine_.close("the script says so");
        engine_.tick(now_);
        break;
      default: {
        const LineNumber wanted = engine_.next_number() - static_cast<LineNumber>(what / 8U);
        engine_.receive("Error:checksum mismatch, Last Line: " + std::to_string(wanted - 1) +
                            "\nResend: " + std::to_string(wanted) + "\nok\n",
                        now_);
        break;
      }
    }
  }

  void wait(Duration time) {
    now_ += time;
    engine_.tick(now_);
  }

  /// What holds after every call.
  void look() {
    const std::string output = engine_.take_output();
    require(!ended_ || output.empty(), "it speaks after the end");
    for (const Event& event : engine_.take_events()) {
      if (std::holds_alternative<ReplyReceived>(event)) continue;
      require(!ended_, "an event after the end");
      if (const auto* rejoined = std::get_if<Rejoined>(&event)) {
        acknowledged_ = rejoined->next - 1;
        sent_ = rejoined->next - 1;
      }
      if (const auto* sent = std::get_if<LineSent>(&event)) {
        require(sent->again ? sent->line.number <= sent_ : sent->line.number == sent_ + 1,
                "a number was skipped");
        if (!sent->again) ++sent_;
      }
      if (const auto* acknowledged = std::get_if<LineAcknowledged>(&event)) {
        require(acknowledged->line.number == acknowledged_ + 1, "acknowledged out of turn, or twice");
        ++acknowledged_;
        require(acknowledged_ <= sent_, "acknowledged before it was sent");
      }
      if (std::holds_alternative<Ended>(event)) ended_ = true;
    }
    require(ended_ == (engine_.state() == EngineState::kEnded), "ended without a word");
    require(engine_.outstanding().size() < 200 + urged_, "lines on their way pile up");
    const auto deadline = engine_.deadline();
    require(!deadline || *deadline > now_ || engine_.state() == EngineState::kWaitingForStart,
            "something is due and was not done");
  }

  std::string_view input_;
  EngineOptions options_;
  Situation situation_;
  ProtocolEngine engine_;
  Instant now_{};
  LineNumber sent_ = 0;
  LineNumber acknowledged_ = 0;
  std::size_t urged_ = 0;
  bool ended_ = false;
};

}  // namespace

void protocol_engine(std::string_view input) {
  Script(input).run();
}

}  // namespace lamina::fuzz
