#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "transport/time.h"

namespace lamina::transport {

/// What can happen to one byte.
enum class ByteFault { kFlip, kDrop, kRepeat, kInsert };

/// The same for one byte in particular.
struct OrderedByteFault {
  ByteFault fault = ByteFault::kFlip;
  std::uint64_t byte = 0;  ///< the first is 0
};

/// What goes wrong on a wire, each with its chance.
struct WireFaults {
  double flip = 0;           ///< per byte: one bit turned over
  double drop = 0;           ///< per byte: gone
  double repeat = 0;         ///< per byte: twice
  double insert = 0;         ///< per byte: another one before it, of any value
  double lose_ok = 0;        ///< per line that begins with "ok": the whole line gone
  double double_ok = 0;      ///< per line that begins with "ok": the line twice
  double double_resend = 0;  ///< per line that begins with "Resend": the line twice
  /// Damaged bytes lie at least so many bytes apart. Marlin's checksum is an exclusive or: the same bit
  /// turned over twice in one line goes unnoticed, whatever the host does.
  std::size_t spacing = 0;
  std::uint64_t seed = 1;
  std::vector<OrderedByteFault> ordered;
};

struct WireOptions {
  int baud = 0;        ///< bits per second, ten a byte; 0: no time at all
  Duration latency{};  ///< between the last bit of a byte and its arrival
  /// Bytes travel in packets of so many, as through a USB adapter; a packet that is not full leaves when its
  /// first byte has waited for `latency`, and then takes no time more. 0: one by one.
  std::size_t packet = 0;
  WireFaults faults;
};

/// One direction of a serial line: bytes take their time, and may come to harm. The same seed harms the same
/// bytes.
class Wire {
 public:
  explicit Wire(const WireOptions& options = {});

  /// Bytes set out at `now`, behind those that are still being sent.
  void send(std::string_view bytes, Instant now);

  /// The bytes that have arrived by `now`, oldest first. What is not taken in full stays: see `put_back`.
  std::string take_arrived(Instant now);

  /// Puts the tail of what was taken back: the receiver had no room.
  void put_back(std::string_view bytes, Instant now);

  /// When the next byte arrives.
  std::optional<Instant> next_arrival() const;

  bool empty() const { return under_way_.empty(); }

  /// Bytes that noise has touched so far.
  std::int64_t damaged() const { return damaged_; }

 private:
  struct Byte {
    Instant arrives;
    char value;
  };

  bool chance(double probability);
  void send_line(std::string_view line, Instant now);
  void send_byte(char byte, Instant now);
  void put_on(char byte);

  WireOptions options_;
  std::deque<Byte> under_way_;
  Instant free_{};               ///< when the last byte has left
  std::size_t packet_size_ = 0;  ///< bytes of the packet that is being filled: the last so many under way
  Instant packet_leaves_{};
  std::size_t since_damage_ = 0;
  std::uint64_t sent_ = 0;
  std::int64_t damaged_ = 0;
  std::mt19937_64 random_;
};

}  // namespace lamina::transport
