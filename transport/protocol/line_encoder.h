#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "transport/protocol/engine_options.h"
#include "transport/protocol/line_framing.h"
#include "transport/time.h"

namespace lamina::transport {

/// Makes bytes of lines: shortened, numbered, and packed once printer and host have agreed on that.
///
///             offered           ask         confirmed
///     plain ----------> offered ----> asked ----------> packed
///       ^                               |                  |
///       +-------- asked often enough ---+                  | damaged
///                                                          v
///                                                  plain for good
class LineEncoder {
 public:
  explicit LineEncoder(const EngineOptions& options);

  /// The printer begins anew, or is met for the first time: it does not unpack.
  void restart();

  /// M115 lists MeatPack. Taken up once.
  void offered();
  /// "[MP] PV01 ON NSP"
  void answered(std::string_view text);
  /// Nothing else may be sent: the printer is to be asked to unpack, or to answer.
  bool negotiates(bool wire_is_clear) const;
  /// When the next request is due. Only while it is to answer.
  Instant request_due() const { return due_; }
  /// The next request, if it is due at `now`: bytes. Empty if it is not. None if there was no answer to the
  /// last one: the lines stay as they are, and the bytes sent lie in front of the next line.
  std::optional<std::string> request(Instant now);

  /// A packed line was refused. From here on they go plain: the checksum, an exclusive or, misses more of
  /// what can happen to a packed line than of what can happen to a plain one.
  void damaged();

  bool packs() const { return state_ == State::kPacked; }
  bool asked() const { return state_ == State::kAsked; }

  /// A numbered line as bytes. Throws LineError if it is too long.
  std::string encode(LineNumber number, std::string_view command) const;
  /// Bytes that are no line of ours, packed where lines are.
  std::string packed(std::string bytes) const;

  /// The unpacker may have lost its place.
  void doubt() { in_doubt_ = true; }
  /// `bytes`, with what sets the unpacker right in front of them where it is in doubt.
  std::string set_right(std::string bytes);

  /// What ends packing, also if that was ended before and the printer may have missed it; and what begins it
  /// again, where lines are packed. Else empty.
  std::string off() const;
  std::string on() const;

 private:
  enum class State { kPlain, kOffered, kAsked, kPacked, kPlainForGood };

  LineForm form_;
  bool wanted_;
  Duration wait_;
  int most_requests_;
  State state_ = State::kPlain;
  int requests_ = 0;
  Instant due_{};
  bool in_doubt_ = false;
};

}  // namespace lamina::transport
