#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "transport/protocol/line_framing.h"
#include "transport/protocol/protocol_engine.h"

// The protocol engine alone: every step states what came in, what went out, and which lines are on their way
// after it.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;

std::string name(EngineState state) {
  switch (state) {
    case EngineState::kIdle:
      return "idle";
    case EngineState::kWaitingForStart:
      return "waiting";
    case EngineState::kGreeting:
      return "greeting";
    case EngineState::kSettling:
      return "settling";
    case EngineState::kStreaming:
      return "streaming";
    case EngineState::kDraining:
      return "draining";
    case EngineState::kProbing:
      return "probing";
    case EngineState::kEnded:
      return "ended";
  }
  return "?";
}

/// The engine with a clock and a short notation: "streaming 3 4a" is the state and the lines on their way,
/// `a` for those that the printer has accepted, `-` for one without a number.
class Bench {
 public:
  explicit Bench(EngineOptions options = {}) : engine(readable(options)) {}

  /// Lines as one would write them, and whole.
  static EngineOptions readable(EngineOptions options) {
    options.form = {false, true};
    options.window.hold_ends = false;
    return options;
  }

  std::string state() const {
    std::string text = name(engine.state());
    for (const OutstandingLine& line : engine.outstanding()) {
      text += line.number ? fmt::format(" {}{}", *line.number, line.accepted ? "a" : "") : std::string(" -");
    }
    return text;
  }

  /// Bytes in; bytes out.
  std::string hear(const std::string& bytes) {
    engine.receive(bytes, now);
    return drain();
  }

  std::string wait(Duration time) {
    now += time;
    engine.tick(now);
    return drain();
  }

  std::string submit(const std::string& command, LineOrigin origin = LineOrigin::kJob) {
    engine.submit(command, origin);
    engine.tick(now);
    return drain();
  }

  void connect() {
    engine.connect(now);
    hear("start\n");
    REQUIRE(wait(100ms) == "\nN0 M110 N0*125\n");
    hear("ok\n");
    wait(100ms);
    REQUIRE(state() == "streaming");
  }

  template <typename Wanted>
  std::vector<Wanted> take() {
    std::vector<Wanted> found;
    for (const Event& event : events) {
      if (const auto* wanted = std::get_if<Wanted>(&event)) found.push_back(*wanted);
    }
    return found;
  }

  EndReason end_reason() {
    const auto ended = take<Ended>();
    REQUIRE(ended.size() == 1);
    return ended.front().reason;
  }

  /// Numbers of the lines acknowledged since the last call.
  std::vector<LineNumber> acknowledged() {
    std::vector<LineNumber> numbers;
    for (const LineAcknowledged& event : take<LineAcknowledged>()) numbers.push_back(event.line.number);
    events.clear();
    return numbers;
  }

  ProtocolEngine engine;
  Instant now{};
  std::vector<Event> events;

 private:
  std::string drain() {
    for (Event& event : engine.take_events()) events.push_back(std::move(event));
    // No deadline may lie in the past: the owner's loop would spin.
    if (const auto deadline = engine.deadline()) REQUIRE(*deadline > now);
    return engine.take_output();
  }
};

EngineOptions one_line() {
  EngineOptions options;
  options.window.lines = 1;
  return options;
}

using Numbers = std::vector<LineNumber>;

const std::string kRefused2 = "Error:checksum mismatch, Last Line: 1\nResend: 2\nok\n";
const std::string kProbe = "N2000000000 M105*21\n";

}  // namespace

TEST_CASE("engine: start-up greets after start, or after waiting for it") {
  Bench bench;
  bench.engine.connect(bench.now);
  CHECK(bench.state() == "waiting");
  CHECK(bench.wait(2400ms).empty());
  CHECK(bench.wait(100ms) == "\nN0 M110 N0*125\n");
  CHECK(bench.state() == "greeting");
  // A board that is slow to start forgets the greeting; it is greeted again.
  CHECK(bench.hear("start\nMarlin 2.1.2.1\n").empty());
  CHECK(bench.state() == "waiting");
  CHECK(bench.wait(100ms) == "\nN0 M110 N0*125\n");
  CHECK(bench.hear("ok\n").empty());
  CHECK(bench.state() == "settling");
  CHECK(bench.wait(90ms).empty());
  // Stale oks of another program's lines are heard out.
  CHECK(bench.hear("ok\n").empty());
  CHECK(bench.wait(90ms).empty());
  CHECK(bench.state() == "settling");
  CHECK(bench.take<Connected>().empty());
  CHECK(bench.wait(10ms).empty());
  CHECK(bench.state() == "streaming");
  CHECK(bench.take<Connected>().size() == 1);
  CHECK(bench.engine.next_number() == 1);
}

TEST_CASE("engine: a damaged greeting is repeated, silence ends it") {
  Bench bench;
  bench.engine.connect(bench.now);
  bench.wait(2500ms);
  CHECK(bench.hear("Error:checksum mismatch, Last Line: 0\nResend: 1\nok\n").empty());
  CHECK(bench.state() == "greeting");
  // Every second time together with what switches an unpacker off that another host left on.
  CHECK(bench.wait(50ms) == "\xFF\xFF\xF9\nN0 M110 N0*125\n");
  CHECK(bench.wait(2s) == "\nN0 M110 N0*125\n");
  CHECK(bench.wait(2s) == "\xFF\xFF\xF9\nN0 M110 N0*125\n");
  CHECK(bench.wait(2s) == "\nN0 M110 N0*125\n");
  CHECK(bench.wait(2s).empty());
  CHECK(bench.state() == "ended");
  CHECK(bench.end_reason() == EndReason::kNotAPrinter);
}

TEST_CASE("engine: one line at a time") {
  Bench bench(one_line());
  bench.connect();
  CHECK(bench.submit("G1 X1") == "N1 G1 X1*96\n");
  CHECK(bench.state() == "streaming 1");
  CHECK(bench.submit("G1 X2").empty());
  CHECK(bench.hear("ok\n") == "N2 G1 X2*96\n");
  CHECK(bench.state() == "streaming 2");
  CHECK(bench.acknowledged() == Numbers{1});
  CHECK(bench.hear("ok\n").empty());
  CHECK(bench.acknowledged() == Numbers{2});
  CHECK(bench.engine.all_acknowledged());
}

TEST_CASE("engine: the window holds three lines and 127 bytes") {
  Bench bench;
  bench.connect();
  CHECK(bench.submit("G1 X1") == frame_line(1, "G1 X1"));
  CHECK(bench.submit("G1 X2") == frame_line(2, "G1 X2"));
  CHECK(bench.submit("G1 X3") == frame_line(3, "G1 X3"));
  CHECK(bench.submit("G1 X4").empty());
  CHECK(bench.state() == "streaming 1 2 3");
  CHECK(bench.hear("ok\n") == frame_line(4, "G1 X4"));
  CHECK(bench.state() == "streaming 2 3 4");
  bench.hear("ok\nok\nok\n");
  // Two lines of 60 bytes leave no room for a third.
  const std::string command = "G1 X100.123 Y100.456 E0.12345 F1200 S0 P0 Q0 R0 I0";
  const std::string first = frame_line(5, command);
  REQUIRE(first.size() > 127 / 3);
  REQUIRE(2 * first.size() <= 127);
  CHECK(bench.submit(command) == first);
  CHECK(bench.submit(command) == frame_line(6, command));
  CHECK(bench.submit(command).empty());
  CHECK(bench.state() == "streaming 5 6");
}

TEST_CASE("engine: a numbered ok acknowledges everything up to its line") {
  Bench bench;
  bench.connect();
  bench.submit("G1 X1");
  bench.submit("G1 X2");
  bench.submit("G1 X3");
  CHECK(bench.hear("ok N2 P10 B2\n").empty());
  CHECK(bench.acknowledged() == Numbers{1, 2});
  CHECK(bench.state() == "streaming 3");
  // One for a line that is not on its way says nothing.
  bench.hear("ok N2 P10 B2\n");
  CHECK(bench.state() == "streaming 3");
  CHECK(bench.take<StrayReply>().size() == 1);
  // From this firmware a plain one can only be part of a resend.
  bench.hear("ok\n");
  CHECK(bench.state() == "streaming 3");
  // And one with the rest but no number belongs to a line that had none: the tail of a cut one.
  bench.hear("ok P10 B3\n");
  CHECK(bench.state() == "streaming 3");
  bench.hear("ok N3 P10 B3\n");
  CHECK(bench.state() == "streaming");
}

TEST_CASE("engine: the ok after a resend acknowledges nothing") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  bench.submit("G1 X2");
  bench.hear("ok\n");
  CHECK(bench.acknowledged() == Numbers{1});
  CHECK(bench.hear(kRefused2).empty());
  CHECK(bench.state() == "draining");
  CHECK(bench.acknowledged().empty());
  CHECK(bench.wait(49ms).empty());
  CHECK(bench.wait(1ms) == "N2 G1 X2*96\n");
  // Then an M105, whose answer is like no other, before anything new.
  CHECK(bench.submit("G1 X3").empty());
  CHECK(bench.hear("ok\n") == frame_line(3, "M105"));
  CHECK(bench.acknowledged() == Numbers{2});
  CHECK(bench.hear("ok\n").empty());
  CHECK(bench.state() == "streaming 3");
  CHECK(bench.hear("ok T:20.00 /0.00 @:0\n") == frame_line(4, "G1 X3"));
}

TEST_CASE("engine: errors overtake older oks") {
  Bench bench;
  bench.connect();
  bench.submit("G1 X1");
  bench.submit("G1 X2");
  bench.submit("G1 X3");
  CHECK(bench.hear(kRefused2).empty());
  CHECK(bench.state() == "draining 1a");
  // Line 3 came behind and is refused in turn: an echo.
  CHECK(bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n").empty());
  CHECK(bench.state() == "draining 1a");
  // Nothing is sent while line 1 may still be waiting for its place in the planner.
  CHECK(bench.wait(1s).empty());
  CHECK(bench.hear("ok\n") == frame_line(2, "G1 X2"));
  CHECK(bench.acknowledged() == Numbers{1});
  // One at a time from here on.
  CHECK(bench.state() == "streaming 2");
  CHECK(bench.engine.cautious());
  CHECK(bench.hear("ok\n") == frame_line(3, "G1 X3"));
}

namespace {

/// Streams with held ends, over a link on which an ok takes a millisecond.
struct HeldBench : Bench {
  HeldBench() {
    EngineOptions options;
    options.form = {false, true};
    engine = ProtocolEngine(options);
    connect();
    submit("M114");
    wait(1ms);
    hear("ok\n");
  }
};

const std::string kEraser = std::string(95, '\b') + "\n";

std::string without_end(std::string line) {
  line.pop_back();
  return line;
}

}  // namespace

TEST_CASE("engine: the end of a line is held back until the one before is acknowledged") {
  HeldBench bench;
  CHECK(bench.submit("G1 X2") == frame_line(2, "G1 X2"));
  CHECK(bench.submit("G1 X3") == without_end(frame_line(3, "G1 X3")));
  CHECK(bench.submit("G1 X4").empty());
  bench.wait(1ms);
  CHECK(bench.hear("ok\n") == "\n" + without_end(frame_line(4, "G1 X4")));
  CHECK(bench.state() == "streaming 3 4");
  bench.wait(1ms);
  CHECK(bench.hear("ok\n") == "\n");
  bench.wait(1ms);
  CHECK(bench.hear("ok\n").empty());
  CHECK(bench.engine.all_acknowledged());
}

TEST_CASE("engine: what an error leaves of a held line is erased before the resend") {
  HeldBench bench;
  bench.submit("G1 X2");
  bench.submit("G1 X3");
  CHECK(bench.hear("Error:checksum mismatch, Last Line: 1\nResend: 2\nok\n").empty());
  CHECK(bench.state() == "draining");
  CHECK(bench.wait(50ms) == kEraser + frame_line(2, "G1 X2"));
}

TEST_CASE("engine: a probe erases a held line, an urgent command ends it") {
  HeldBench probed;
  probed.submit("G1 X2");
  probed.submit("G1 X3");
  CHECK(probed.wait(30s) == kEraser + "\n");
  HeldBench urged;
  urged.submit("G1 X2");
  urged.submit("G1 X3");
  urged.engine.send_urgent("M108", urged.now);
  CHECK(urged.engine.take_output() == "\nM108\n");
  CHECK(urged.hear("ok\nok\nok\n").empty());
  CHECK(urged.engine.all_acknowledged());
}

TEST_CASE("engine: until an answer has shown how long one takes, ends are held") {
  EngineOptions options;
  options.form = {false, true};
  Bench bench;
  bench.engine = ProtocolEngine(options);
  bench.connect();
  CHECK(bench.submit("G1 X1") == frame_line(1, "G1 X1"));
  CHECK(bench.submit("G1 X2") == without_end(frame_line(2, "G1 X2")));
}

TEST_CASE(
    "engine: whole lines go ahead, an error's time apart, where answers come late and the printer is "
    "hungry") {
  EngineOptions options;
  options.form = {false, true};
  Bench bench;
  bench.engine = ProtocolEngine(options);
  bench.connect();
  bench.submit("G1 X1");
  bench.wait(16ms);
  bench.hear("ok\n");
  CHECK(bench.submit("G1 X2") == frame_line(2, "G1 X2"));
  // A refusal of line 2 is told, and the flush over, before the first byte of line 3 arrives. Line 2 is 12
  // bytes of ten bits, the error at most 72.
  CHECK(bench.submit("G1 X3").empty());
  const Instant opens = *bench.engine.deadline();
  CHECK(to_seconds(opens - bench.now) == Approx((12 + 72) * 10 / 115200.0));
  CHECK(bench.wait(opens - bench.now - 1us).empty());
  CHECK(bench.wait(1us) == frame_line(3, "G1 X3"));
  CHECK(bench.submit("G1 X4").empty());
  CHECK(bench.wait(8ms) == frame_line(4, "G1 X4"));
  CHECK(bench.submit("G1 X5").empty());
  CHECK(bench.wait(8ms).empty());
  CHECK(bench.state() == "streaming 2 3 4");
  bench.hear("ok\n");
  // Later its planner is full: there is time to be careful.
  bench.wait(100ms);
  bench.hear("ok\nok\nok\n");
  REQUIRE(bench.engine.all_acknowledged());
  CHECK(bench.submit("G1 X6") == frame_line(6, "G1 X6"));
  CHECK(bench.submit("G1 X7") == without_end(frame_line(7, "G1 X7")));
}

TEST_CASE("engine: a doubled request, and one for the line that comes next anyway") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  bench.submit("G1 X2");
  bench.hear("ok\n");
  bench.hear("Error:checksum mismatch, Last Line: 1\nResend: 2\nResend: 2\nok\n");
  CHECK(bench.state() == "draining");
  CHECK(bench.wait(50ms) == "N2 G1 X2*96\n");
  CHECK(bench.take<ResendRequested>().size() == 1);
  // Line 2 has arrived, says the printer; its ok is still to come.
  CHECK(bench.hear("Error:checksum mismatch, Last Line: 2\nResend: 3\nok\n").empty());
  CHECK(bench.state() == "streaming 2");
  CHECK(bench.hear("ok\n") == frame_line(3, "M105"));
}

TEST_CASE("engine: a resend without an ok of its own") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  bench.hear("Error:checksum mismatch, Last Line: 0\nResend: 1\n");
  CHECK(bench.wait(600ms) == "N1 G1 X1*96\n");
  CHECK(bench.hear("ok\n") == frame_line(2, "M105"));
}

TEST_CASE("engine: requests that do not fit together are not believed") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  bench.hear("ok\n");
  bench.submit("G1 X2");
  // A damaged number.
  CHECK(bench.hear("Error:checksum mismatch, Last Line: 1\nResend: 72\nok\n") == "\n");
  CHECK(bench.state() == "probing 2");
  CHECK(bench.wait(50ms) == kProbe);
  CHECK(bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n").empty());
  CHECK(bench.state() == "draining");
  CHECK(bench.wait(50ms) == "N2 G1 X2*96\n");
}

TEST_CASE("engine: a lost resend line is noticed by the error before it") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  CHECK(bench.hear("Error:checksum mismatch, Last Line: 0\nRe?end: 1\nok\n") == "\n");
  CHECK(bench.state() == "probing 1");
  CHECK(bench.acknowledged().empty());
}

TEST_CASE("engine: a lost ok is found by asking, and nothing is sent twice") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  CHECK(bench.wait(29s).empty());
  // Automatic reports do not show that the line was run.
  CHECK(bench.hear(" T:20.00 /0.00 @:0\n").empty());
  CHECK(bench.wait(1s) == "\n");
  CHECK(bench.state() == "probing 1");
  CHECK(bench.wait(1s) == kProbe);
  CHECK(bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n").empty());
  CHECK(bench.acknowledged() == Numbers{1});
  CHECK(bench.state() == "draining");
  CHECK(bench.wait(50ms) == frame_line(2, "M105"));
  CHECK(bench.hear("ok\n").empty());
  CHECK(bench.hear("ok T:20.00 /0.00 @:0\n").empty());
  CHECK(bench.engine.all_acknowledged());
}

TEST_CASE("engine: a lost line is found by asking, and sent again under its number") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  bench.hear("echo:busy: processing\n");
  // A firmware that says when it is busy is missed sooner.
  CHECK(bench.wait(3s) == "\n");
  CHECK(bench.wait(1s) == kProbe);
  bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 0\nResend: 1\nok\n");
  CHECK(bench.wait(50ms) == "N1 G1 X1*96\n");
}

TEST_CASE("engine: busy lines keep it waiting, silence does not") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G28");
  for (int i = 0; i < 100; ++i) {
    CHECK(bench.wait(2s).empty());
    CHECK(bench.hear("echo:busy: processing\n").empty());
  }
  CHECK(bench.state() == "streaming 1");
  CHECK(bench.wait(10s) == "\n");
  CHECK(bench.wait(1s) == kProbe);
  for (const Duration patience : {1s, 2s, 4s, 8s}) {
    CHECK(bench.wait(patience - 1ms).empty());
    CHECK(bench.wait(1ms) == kProbe);
  }
  CHECK(bench.wait(16s).empty());
  CHECK(bench.end_reason() == EndReason::kNoAnswer);
}

TEST_CASE("engine: a blocking line that was accepted is waited for, with a question behind it") {
  Bench bench;
  bench.connect();
  bench.submit("G28");
  CHECK(bench.submit("G1 X1").empty());  // nothing goes out behind a blocking line
  CHECK(bench.wait(5min) == "\n");
  CHECK(bench.wait(1s) == kProbe);
  bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n");
  CHECK(bench.wait(50ms) == frame_line(2, "M105"));
  CHECK(bench.state() == "streaming 1a 2");
  CHECK(bench.acknowledged().empty());
  // The ok of line 1 was lost; that of line 2 tells that both have run.
  CHECK(bench.hear("ok T:20.00 /0.00 @:0\n") == frame_line(3, "G1 X1"));
  CHECK(bench.acknowledged() == Numbers{1, 2});
}

TEST_CASE("engine: behind a blocking line the question is asked anew when its answer is lost") {
  Bench bench;
  bench.connect();
  bench.submit("G28");
  bench.hear("echo:busy: processing\n");
  for (LineNumber question = 2; question <= 5; ++question) {
    CHECK(bench.wait(10s) == "\n");
    CHECK(bench.wait(1s) == kProbe);
    bench.hear(fmt::format("Error:Line Number is not Last Line Number+1, Last Line: {}\nResend: {}\nok\n",
                           question - 1, question));
    CHECK(bench.wait(50ms) == frame_line(question, "M105"));
    CHECK(bench.state() == fmt::format("streaming 1a {}", question));
  }
  bench.hear("ok T:20.00 /0.00 @:0\n");
  CHECK(bench.engine.all_acknowledged());
}

TEST_CASE("engine: a blocking line whose ok is lost does not keep lines behind it from being sent again") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G28");
  bench.submit("M190 S60");
  // The ok belongs to something else: line 1 never arrived, and line 2 is refused.
  CHECK(bench.hear("ok\n") == frame_line(2, "M190 S60"));
  bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 0\nResend: 1\nok\n");
  CHECK(bench.wait(50ms) == frame_line(1, "G28"));
  bench.hear("echo:busy: processing\n");
  // Its ok is lost.
  CHECK(bench.wait(10s) == "\n");
  CHECK(bench.wait(1s) == kProbe);
  bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n");
  CHECK(bench.wait(50ms) == frame_line(2, "M190 S60"));
  CHECK(bench.hear("ok\n") == frame_line(3, "M105"));
}

TEST_CASE("engine: a report inside M109 is a sign of life") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("M109 S200");
  bench.hear("echo:busy: processing\n");
  for (int i = 0; i < 100; ++i) {
    bench.wait(8s);
    bench.hear(" T:20.00 /200.00 @:127 W:?\n");
  }
  CHECK(bench.state() == "streaming 1");
}

TEST_CASE("engine: the tail of a cut line is recognised") {
  Bench bench;
  bench.connect();
  bench.submit("G1 X1");
  // Run as a command of its own; its ok is not line 1's.
  CHECK(bench.hear("echo:Unknown command: \"1 X1\"\nok\n") == "\n");
  CHECK(bench.take<StrayReply>().size() == 1);
  CHECK(bench.acknowledged().empty());
  CHECK(bench.state() == "probing 1");
  // A command of ours that the printer does not know is another matter.
  Bench other;
  other.connect();
  other.submit("M300 S440");
  CHECK(other.hear("echo:Unknown command: \"M300 S440\"\nok\n").empty());
  CHECK(other.acknowledged() == Numbers{1});
}

TEST_CASE("engine: a plain ok is not the answer to M105") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("M105", LineOrigin::kInjected);
  bench.hear("ok\n");
  CHECK(bench.state() == "streaming 1");
  CHECK(bench.take<StrayReply>().size() == 1);
  bench.hear("ok T:20.00 /0.00 @:0\n");
  CHECK(bench.state() == "streaming");
}

TEST_CASE("engine: a doubled ok cannot acknowledge a line that has not left") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  bench.submit("G1 X2");
  CHECK(bench.hear("ok\nok\n") == "N2 G1 X2*96\n");
  CHECK(bench.state() == "streaming 2");
  CHECK(bench.acknowledged() == Numbers{1});
}

namespace {

/// The answer to M115, `apart` from one byte to the next.
void tell_capabilities(Bench& bench, Duration apart) {
  std::string answer;
  for (int i = 0; i < 30; ++i) answer += fmt::format("Cap:SOMETHING_{}:1\n", i);
  for (const char byte : answer) {
    bench.now += apart;
    bench.hear({byte});
  }
  bench.hear("ok\n");
}

}  // namespace

TEST_CASE("engine: an ok that comes sooner than the wire allows is one too many") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("M115");
  tell_capabilities(bench, 87us);
  bench.acknowledged();
  bench.submit("G1 X2");
  bench.submit("G1 X3");
  bench.wait(3ms);
  // Line 3 takes a millisecond to arrive, its ok another quarter.
  CHECK(bench.hear("ok\n") == frame_line(3, "G1 X3"));
  bench.wait(1200us);
  bench.hear("ok\n");
  CHECK(bench.state() == "streaming 3");
  CHECK(bench.take<StrayReply>().size() == 1);
  bench.wait(100us);
  bench.hear("ok\n");
  CHECK(bench.acknowledged() == Numbers{2, 3});
}

TEST_CASE("engine: where the speed is only a number, an ok may come as soon as it likes") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("M115");
  tell_capabilities(bench, 2us);
  bench.submit("G1 X2");
  bench.hear("ok\n");
  CHECK(bench.engine.all_acknowledged());
}

TEST_CASE("engine: a refused ok after which nothing came is believed the next time") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("M115");
  tell_capabilities(bench, 87us);
  bench.submit("G1 X2");
  bench.hear("ok\n");
  REQUIRE(bench.state() == "streaming 2");
  bench.wait(30s);
  bench.wait(1s);
  bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 2\nResend: 3\nok\n");
  bench.wait(50ms);
  bench.hear("ok T:20.00 /0.00 @:0\n");
  REQUIRE(bench.engine.all_acknowledged());
  bench.submit("G1 X4");
  bench.hear("ok\n");
  CHECK(bench.engine.all_acknowledged());
}

TEST_CASE("engine: an ok cannot be for a line whose end was not sent") {
  HeldBench bench;
  bench.submit("G1 X2");
  bench.submit("G1 X3");
  bench.wait(1ms);
  bench.hear("ok\nok\n");
  CHECK(bench.state() == "streaming 3");
  CHECK(bench.take<StrayReply>().size() == 1);
}

TEST_CASE("engine: lines asked for although their oks were there: those oks were for something else") {
  Bench bench;
  bench.connect();
  bench.submit("G1 X1");
  bench.submit("G1 X2");
  bench.submit("G1 X3");
  bench.hear("ok\nok\n");
  REQUIRE(bench.acknowledged() == Numbers{1, 2});
  bench.hear(kRefused2);
  CHECK(bench.take<StrayReply>().size() == 1);
  CHECK(bench.engine.statistics().stray_replies == 1);
}

namespace {

constexpr const char* kPlaceQuestion = "N1 M114 M110 N1*";

/// Behind N1, which has run, the printer wants N2, which extrudes to X2; and an ok has come for which there
/// is no line. Up to the question where the printer is.
void lose_number_of_line_2(Bench& bench) {
  bench.connect();
  bench.submit("G1 X1 E1");
  bench.hear("ok\n");
  bench.submit("G1 X2 E1");
  bench.hear("ok\n");
  bench.submit("G1 X3 E1");
  bench.hear(kRefused2);
  REQUIRE(bench.state() == "draining");
  // That number may be an older one; asking for the place gives the number anew, so it has to be certain.
  CHECK(bench.wait(50ms) == "\n");
  CHECK(bench.wait(50ms).starts_with("N2000000000 M105*"));
  CHECK(bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n").empty());
  CHECK(bench.wait(50ms).starts_with(kPlaceQuestion));
}

std::string at_x(double x) {
  return fmt::format("X:{:.2f} Y:0.00 Z:0.00 E:1.00 Count X:0 Y:0 Z:0\nok\n", x);
}

}  // namespace

TEST_CASE("engine: a move that has run without its number is not run again") {
  Bench bench(one_line());
  lose_number_of_line_2(bench);
  // Once may be noise.
  CHECK(bench.hear(at_x(2)).starts_with(kPlaceQuestion));
  CHECK(bench.hear(at_x(2)) == frame_line(2, "M105"));
  CHECK(bench.take<StrayReply>().size() >= 2);
  bench.events.clear();
  CHECK(bench.hear("ok T:20 /0\n") == frame_line(3, "G1 X3 E1"));
  CHECK(bench.engine.statistics().lines_acknowledged == 2);
}

TEST_CASE("engine: a move that has not run is sent again, and so is one of which nobody can tell") {
  for (const std::string& answer : {at_x(1), at_x(7), std::string("X:2.0\nok\n"), std::string("ok\n"),
                                    std::string("echo:Unknown command: \"M11\"\nok\n")}) {
    INFO(answer);
    Bench bench(one_line());
    lose_number_of_line_2(bench);
    std::string sent;
    for (int questions = 0; questions < 10 && sent.find("N2 ") == std::string::npos; ++questions) {
      CHECK((questions == 0 || sent.starts_with(kPlaceQuestion)));
      sent = bench.hear(answer) + bench.wait(50ms);
    }
    CHECK(sent == frame_line(2, "G1 X2 E1"));
  }
}

TEST_CASE("engine: a number without a sum may have lost a command that ran, though its ok is still to come") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1 E1");
  bench.hear("ok\n");
  bench.submit("G1 X2 E1");
  bench.hear("Error:No Checksum with line number, Last Line: 1\nResend: 2\nok\n");
  CHECK(bench.wait(50ms) == "\n");
  CHECK(bench.wait(50ms).starts_with("N2000000000 M105*"));
  bench.hear("Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n");
  CHECK(bench.wait(50ms).starts_with(kPlaceQuestion));
  // The tail's ok, at last, looks like the question's.
  CHECK(bench.hear("ok\n").starts_with(kPlaceQuestion));
  CHECK(bench.hear(at_x(2)).starts_with(kPlaceQuestion));
  CHECK((bench.hear(at_x(2)) + bench.wait(50ms)).ends_with(frame_line(2, "M105")));
}

TEST_CASE("engine: the place is not asked for where it would tell nothing") {
  for (const std::string command : {"G1 E1", "G1 X1 E1", "G1 X2", "M104 S200", "G92 X2 E0"}) {
    INFO(command);
    Bench bench(one_line());
    bench.connect();
    bench.submit("G1 X1 E1");
    bench.hear("ok\n");
    bench.submit(command);
    bench.hear("ok\n");
    bench.submit("G1 X3 E1");
    bench.hear(kRefused2);
    CHECK(bench.wait(50ms) == frame_line(2, command));
  }
}

TEST_CASE("engine: injected lines overtake job lines that wait") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  bench.submit("G1 X2");
  bench.submit("M220 S50", LineOrigin::kInjected);
  bench.submit("M221 S50", LineOrigin::kInjected);
  CHECK(bench.hear("ok\n") == frame_line(2, "M220 S50"));
  CHECK(bench.hear("ok\n") == frame_line(3, "M221 S50"));
  CHECK(bench.hear("ok\n") == frame_line(4, "G1 X2"));
}

TEST_CASE("engine: urgent commands pass everything") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("M109 S200");
  bench.submit("G1 X2");
  bench.engine.send_urgent("M108", bench.now);
  CHECK(bench.engine.take_output() == "\nM108\n");
  CHECK(bench.state() == "streaming 1 -");
  bench.engine.drop_queued();
  CHECK(bench.hear("ok\nok\n").empty());
  CHECK(bench.engine.all_acknowledged());
}

TEST_CASE("engine: lines that would break the numbering are refused") {
  Bench bench;
  bench.connect();
  CHECK(bench.submit("M110 N5").empty());
  CHECK(bench.submit("M117 about M110").empty());
  CHECK(bench.submit("M117 " + std::string(90, 'x')).empty());
  CHECK(bench.take<LineRefused>().size() == 3);
  CHECK(bench.engine.all_acknowledged());
}

TEST_CASE("engine: every way to the end") {
  Bench bench(one_line());
  bench.connect();
  bench.submit("G1 X1");
  SECTION("a restart in the middle") {
    bench.hear("start\n");
    CHECK(bench.end_reason() == EndReason::kRestarted);
    CHECK(bench.take<Ended>().front().next == 1);
  }
  SECTION("the firmware halts") {
    bench.hear("Error:Printer halted. kill() called!\n");
    CHECK(bench.end_reason() == EndReason::kHalted);
  }
  SECTION("a warning does not") {
    bench.hear("Error:G2/G3 bad parameters\n");
    CHECK(bench.state() == "streaming 1");
    bench.engine.close("test");
    bench.hear("");
    CHECK(bench.end_reason() == EndReason::kClosed);
  }
  SECTION("the same line over and over") {
    for (int i = 0; i < 10; ++i) {
      bench.hear("Error:checksum mismatch, Last Line: 0\nResend: 1\nok\n");
      CHECK(bench.state() == "draining");
      CHECK(bench.wait(50ms) == "N1 G1 X1*96\n");
    }
    bench.hear("Error:checksum mismatch, Last Line: 0\nResend: 1\nok\n");
    CHECK(bench.end_reason() == EndReason::kTooManyResends);
  }
  SECTION("a line that was never sent") {
    bench.hear("Error:checksum mismatch, Last Line: 50\nResend: 51\nok\n");
    CHECK(bench.end_reason() == EndReason::kOutOfStep);
  }
  CHECK(bench.engine.state() == EngineState::kEnded);
  CHECK(bench.submit("G1 X5").empty());
  CHECK_FALSE(bench.engine.deadline());
}

TEST_CASE("engine: a line asked for long after its ok is still held, up to a point") {
  EngineOptions options = one_line();
  options.history_lines = 20;
  Bench bench(options);
  bench.connect();
  for (int i = 1; i <= 50; ++i) {
    bench.submit(fmt::format("G1 X{}", i));
    bench.hear("ok\n");
  }
  CHECK(bench.acknowledged().size() == 50);
  SECTION("held") {
    bench.hear("Error:checksum mismatch, Last Line: 39\nResend: 40\nok\n");
    CHECK(bench.wait(50ms) == frame_line(40, "G1 X40"));
    for (int i = 41; i <= 50; ++i) CHECK(bench.hear("ok\n") == frame_line(i, fmt::format("G1 X{}", i)));
    // Each line is acknowledged to the owner once.
    CHECK(bench.acknowledged().empty());
  }
  SECTION("no longer held") {
    bench.hear("Error:checksum mismatch, Last Line: 9\nResend: 10\nok\n");
    CHECK(bench.end_reason() == EndReason::kHistoryExceeded);
  }
}

TEST_CASE("engine: after a resend one line at a time, later the window again, on a noisy link never again") {
  EngineOptions options;
  options.cautious_lines = 4;
  options.noisy_resends = 3;
  Bench bench(options);
  bench.connect();
  const auto damage = [&](LineNumber line) {
    bench.submit("G1 X1");
    bench.hear(fmt::format("Error:checksum mismatch, Last Line: {}\nResend: {}\nok\n", line - 1, line));
    bench.wait(50ms);
    bench.hear("ok\n");
    bench.hear("ok T:20.00 /0.00 @:0\n");
  };
  damage(1);
  CHECK(bench.engine.cautious());
  bench.submit("G1 X3");
  bench.hear("ok\n");
  bench.submit("G1 X4");
  bench.hear("ok\n");
  CHECK_FALSE(bench.engine.cautious());
  damage(5);
  damage(7);
  for (int i = 0; i < 10; ++i) {
    bench.submit("G1 X1");
    bench.hear("ok\n");
  }
  CHECK(bench.engine.cautious());
}

TEST_CASE("engine: an ok for something else does not stand for the answer that a rejoining host asks for") {
  ProtocolEngine engine{EngineOptions{}};
  Instant now{};
  engine.rejoin(now);
  now += 10s;
  engine.tick(now);
  REQUIRE(engine.state() == EngineState::kProbing);
  engine.send_urgent("M108", now);
  engine.receive("ok\n", now);
  CHECK(engine.state() == EngineState::kProbing);
  // Until the printer has said where it is, no line is numbered.
  engine.submit("G1 X1", LineOrigin::kJob);
  for (int k = 0; k < 5 && engine.state() == EngineState::kProbing; ++k) {
    now = engine.deadline().value_or(now + 1s);
    engine.tick(now);
  }
  for (const Event& event : engine.take_events()) CHECK_FALSE(std::holds_alternative<LineSent>(event));
  engine.receive("Error:Line Number is not Last Line Number+1, Last Line: 41\nResend: 42\nok\n", now);
  bool rejoined = false;
  for (const Event& event : engine.take_events()) {
    if (const auto* answer = std::get_if<Rejoined>(&event)) {
      rejoined = true;
      CHECK(answer->next == 42);
    }
  }
  CHECK(rejoined);
}

TEST_CASE("engine: a host that rejoins may have its lines packed like any other") {
  EngineOptions options;
  options.meatpack_after = 0;
  ProtocolEngine engine(options);
  Instant now{};
  const auto wait = [&](Duration time) {
    now += time;
    engine.tick(now);
    return engine.take_output();
  };
  engine.rejoin(now);
  wait(3s);
  wait(1s);
  engine.receive("Error:Line Number is not Last Line Number+1, Last Line: 7\nResend: 8\nok\n", now);
  wait(50ms);
  engine.receive("ok T:20 /0\n", now);
  engine.receive("Cap:MEATPACK:1\n[MP] PV01 ON NSP\n", now);
  engine.receive("[MP] PV01 ON NSP\n", now);
  CHECK(engine.packs());
}
