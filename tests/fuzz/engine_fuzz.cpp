#include <array>
#include <set>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_targets.h"
#include "transport/protocol/protocol_engine.h"

namespace lamina::fuzz {

using namespace transport;

namespace {

constexpr std::array kCommands{"G1 X10.5 Y-0.250 E0.03",
                               "G1 X1",
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
                            "Error:Line Number is not Last Line Number+1, Last Line: 0\n"};

/// Reads the script and acts it out.
class Script {
 public:
  explicit Script(std::string_view input) : input_(input), engine_(options(next())) {}

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
    options.form.blanks = (how & 16U) != 0;
    options.cautious_lines = (how & 32U) != 0 ? 3 : 200;
    options.history_lines = (how & 64U) != 0 ? 4 : 256;
    options.baud = (how & 128U) != 0 ? 0 : 115200;
    return options;
  }

  unsigned char next() {
    if (input_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(input_.front());
    input_.remove_prefix(1);
    return byte;
  }

  /// Takes the engine to one of its states.
  void start() {
    const unsigned char where = next() % 12U;
    if (where == 0) return;
    next() % 2U == 0 ? engine_.connect(now_) : engine_.rejoin(now_);
    if (where == 1) return;
    wait(std::chrono::seconds(3));
    if (where == 2) return;
    engine_.receive("ok\n", now_);
    if (where == 3) return;
    engine_.receive("Error:Line Number is not Last Line Number+1, Last Line: 7\nResend: 8\nok\n", now_);
    wait(std::chrono::seconds(1));
    if (where == 4) return;
    if (where == 8) {
      engine_.receive("Cap:MEATPACK:1\n", now_);
      engine_.receive("[MP] PV01 ON NSP\n", now_);
      return;
    }
    if (where == 9 || where == 10) {
      // A command that blocks, and a file being written.
      engine_.submit(where == 9 ? "M109 S200" : "M28 A.GCO", LineOrigin::kJob);
      engine_.tick(now_);
      if (where == 10) engine_.receive("ok\n", now_);
      return;
    }
    if (where == 11) {
      engine_.close("at the start");
      return;
    }
    for (int i = 0; i < 4; ++i) engine_.submit("G1 X1", LineOrigin::kJob);
    engine_.tick(now_);
    if (where == 5) return;
    engine_.receive("Error:checksum mismatch, Last Line: 0\nResend: 1\nok\n", now_);
    if (where == 6) return;
    wait(std::chrono::minutes(1));
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
