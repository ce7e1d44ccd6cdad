#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "transport/protocol/engine_options.h"
#include "transport/protocol/line_framing.h"
#include "transport/time.h"

namespace lamina::transport {

/// Makes bytes of lines: shortened, numbered, and packed where the printer offers it and the link can be
/// trusted with it.
///
///             offered, clean         ask         confirmed
///     plain -----------------> ready ----> asked ----------> packed
///       ^                                   |                  |
///       +---------- asked often enough -----+                  |
///                                                              |
///     any of them -- trouble --> plain for good <--------------+
///
/// The firmware's checksum, an exclusive or, sees every damage to one byte of a plain line. Packed in the
/// right form (packed_line.h) it sees a bit turned over and a byte lost, but not everything that noise may
/// put in between, as it stands for two characters at once. So lines are packed only on a link that has
/// carried EngineOptions::meatpack_after bytes without any trouble, never where lines go one at a time, which
/// is meant for bad links, and no more after the first thing that was odd in either direction.
class LineEncoder {
 public:
  explicit LineEncoder(const EngineOptions& options);

  /// The printer begins anew, or is met for the first time: it does not unpack.
  void restart();

  /// M115 lists MeatPack. Taken up once.
  void offered();
  /// Lines of so many bytes have been acknowledged.
  void carried(std::size_t bytes);
  /// "[MP] PV01 ON NSP"
  void answered(std::string_view text);
  /// The printer is to be asked to unpack, or to answer that: nothing else may be sent.
  bool negotiates() const;
  /// When the next request is due. Only while it is to answer.
  Instant request_due() const { return due_; }
  /// The next request, if it is due at `now`: bytes. Empty if it is not. None if there was no answer to the
  /// last one: the lines stay as they are, and the bytes sent lie in front of the next line.
  std::optional<std::string> request(Instant now);

  /// A line was damaged, or may have been, or a reply: from here on they go plain.
  void trouble();

  bool packs() const { return state_ == State::kPacked; }
  bool asked() const { return state_ == State::kAsked; }

  /// A numbered line as bytes. Throws LineError if it is too long. Ends packing where the line has no packed
  /// form in which every damage shows.
  std::string encode(LineNumber number, std::string_view command);

  /// `bytes`, with what ends packing in front of them if the printer may not know of that yet.
  std::string set_right(std::string bytes);

  /// What ends packing, also if that was ended before and the printer may have missed it; and what begins it
  /// again, where lines are packed. Else empty.
  std::string off() const;
  std::string on() const;

 private:
  enum class State { kPlain, kReady, kAsked, kPacked, kPlainForGood };

  std::optional<std::string> best_packed(LineNumber number, const std::string& text) const;

  /// A line in the packed form, worked out once: it is asked for whenever there might be room for it.
  struct PackedLine {
    std::string line;
    std::string packed;
  };

  LineForm form_;
  bool wanted_;
  std::size_t clean_bytes_wanted_;
  Duration wait_;
  int most_requests_;
  State state_ = State::kPlain;
  bool offered_ = false;
  std::size_t clean_bytes_ = 0;
  int requests_ = 0;
  Instant due_{};
  bool may_unpack_ = false;  ///< the printer, as it was told to
  bool in_doubt_ = false;    ///< whether it has heard that it is to do so no more
  PackedLine last_packed_;
};

}  // namespace lamina::transport
