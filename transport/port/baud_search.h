#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "transport/port/port.h"
#include "transport/protocol/reply.h"
#include "transport/time.h"

namespace lamina::transport {

/// What printers run at, the most usual ones first.
inline constexpr std::array<int, 8> kUsualBauds{115200, 250000, 230400, 57600, 500000, 1000000, 38400, 9600};

struct BaudSearchOptions {
  std::vector<int> bauds{kUsualBauds.begin(), kUsualBauds.end()};
  /// A board that restarts when it is opened is deaf for so long, and may speak of its own accord.
  Duration boot_wait = std::chrono::milliseconds(2500);
  /// For the answer to a question, in the first round and in the second. A printer that heats up answers no
  /// question, but reports about once a second.
  std::array<Duration, 2> answer_waits{std::chrono::milliseconds(400), std::chrono::milliseconds(1200)};
  /// The rest of what the printer has to say is over when it has been quiet for this long.
  Duration quiet = std::chrono::milliseconds(100);
};

/// Looks for the speed at which a printer can be understood. Without I/O and clock: bytes and the time go in,
/// the speed to be at and bytes to send come out.
///
/// At each rate it sends a line end (a half line must not hide the question) and M105, in a second round
/// M115, and judges what comes back: one whole line of plain characters that Marlin would say settles it; a
/// handful of bytes that no text has in it moves it on to the next rate at once; silence does when the wait
/// is over.
///
/// Use: start; then write `take_output` at `baud`, `receive` what arrives, `tick` at `deadline`. When `baud`
/// changes, what the port holds of the old speed is to be thrown away.
class BaudSearch {
 public:
  enum class State { kSearching, kFound, kFailed };

  explicit BaudSearch(BaudSearchOptions options = {}) : options_(std::move(options)) {}

  void start(Instant now);
  void receive(std::string_view bytes, Instant now);
  void tick(Instant now);

  /// The device cannot run at `baud()`.
  void refuse(Instant now);

  State state() const { return state_; }

  /// The speed to be at; once kFound, the printer's.
  int baud() const { return options_.bauds[rate_]; }

  std::string take_output();
  Instant deadline() const { return due_; }

 private:
  bool garbled() const;
  void try_rate(std::size_t rate, Instant now);
  void next_rate(Instant now);

  BaudSearchOptions options_;
  State state_ = State::kSearching;
  std::size_t rate_ = 0;
  std::size_t round_ = 0;
  bool booting_ = true;
  bool understood_ = false;
  Instant boot_end_{};
  Instant due_{};
  ReplyLines lines_;
  std::size_t bytes_ = 0;      ///< at this rate
  std::size_t bad_bytes_ = 0;  ///< of these, no text
  std::string output_;
};

/// Finds the speed of the printer at `port` by the clock, and leaves the port at it. It takes some
/// milliseconds to some 15 seconds. A port without a serial line answers at the first rate tried. Returns
/// the speed. Throws PortError (kNoAnswer where no printer is found).
int find_baud(Port& port, const BaudSearchOptions& options = {});

}  // namespace lamina::transport
