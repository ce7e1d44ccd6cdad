#pragma once

#include <cstddef>

#include "transport/protocol/line_form.h"
#include "transport/protocol/line_framing.h"
#include "transport/time.h"

namespace lamina::transport {

/// How much may be under way at once, sent and not acknowledged. Three lines and 127 bytes keep a serial line
/// full and never overrun Marlin's 128-byte receive buffer; four lines of usual length already do.
struct Window {
  std::size_t lines = 3;
  std::size_t bytes = 127;
  /// Hold a line's end back until the line before it is acknowledged, where that keeps the wire as full. Then
  /// no whole line ever follows one that may be refused, and what the firmware's error flush leaves of a cut
  /// line is erased by backspaces before anything can run it. Else (the answers take longer than a line and
  /// an error together, the printer is hungry, and the link has lost nothing yet) whole lines go out ahead,
  /// each an error's time behind the one before. False: whole lines, as close as the window allows.
  bool hold_ends = true;
};

/// How long the printer may be silent before the engine asks what arrived. Automatic reports do not count as
/// an answer; ok, busy and the reports inside M109 do.
struct AnswerTimeouts {
  /// No word on a quick or motion command. DEFAULT: 30 s, what a firmware without busy lines needs for long
  /// moves.
  Duration silent_firmware = std::chrono::seconds(30);
  /// The same once the firmware has shown that it sends busy lines, every two seconds while it works.
  Duration busy_firmware = std::chrono::seconds(3);
  /// A blocking command (homing, heating) of a firmware that sends no busy lines.
  Duration blocking = std::chrono::minutes(5);
  /// A blocking command where busy lines are known: some of them must have been lost on the way.
  Duration blocking_busy_firmware = std::chrono::seconds(10);
  /// Between the newline of a probe and its question, and from there to the next question, twice as long
  /// from one to the next.
  Duration probe = std::chrono::seconds(1);
};

struct EngineOptions {
  Window window;
  AnswerTimeouts timeouts;
  /// Bits per second of the wire, to tell how long a line takes; 0: no time, as with native USB.
  int baud = 115200;
  LineForm form;

  /// Pack the lines where M115 offers it (Cap:MEATPACK:1) and the window has more than one line, from when so
  /// many bytes of lines were acknowledged without any trouble in either direction, until the first trouble.
  bool meatpack = true;
  std::size_t meatpack_after = 4096;
  /// For the answer to the request to unpack, and how often it is made before the lines stay as they are.
  Duration meatpack_wait = std::chrono::milliseconds(500);
  int meatpack_requests = 3;

  /// How long a freshly opened printer may take to say `start`. One that does not restart when it is opened
  /// says nothing.
  Duration start_wait = std::chrono::milliseconds(2500);
  /// For the answer to one greeting, and how often it is tried.
  Duration greeting_wait = std::chrono::seconds(2);
  int greetings = 5;
  /// Stale oks from before the greeting are over when it has been quiet for this long.
  Duration greeting_quiet = std::chrono::milliseconds(100);

  /// After an error: how long the wire must be quiet before anything is sent again. It covers what was still
  /// on the wire.
  Duration drain_quiet = std::chrono::milliseconds(50);
  /// An ok that comes this long after a Resend no longer belongs to it (some firmwares send none).
  Duration resend_ok_wait = std::chrono::milliseconds(500);

  /// Lines sent one at a time after any resend.
  std::size_t cautious_lines = 200;
  /// More resends a line than this, and at least `noisy_resends` of them: one at a time for good.
  double noisy_ratio = 0.001;
  std::size_t noisy_resends = 5;
  /// Requests for one and the same line, in a row, before the engine gives up.
  int resends_of_one_line = 10;
  /// Probes without an answer, in a row, before the printer counts as gone.
  int silent_probes = 5;
  /// Answered probes, in a row, without any line acknowledged in between, before the printer counts as stuck.
  int fruitless_probes = 10;

  /// Acknowledged lines kept for a late request.
  LineNumber history_lines = 256;
};

}  // namespace lamina::transport
