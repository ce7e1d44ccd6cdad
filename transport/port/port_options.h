#pragma once

#include "transport/time.h"

namespace lamina::transport {

/// What opening a serial device does to the board behind it. Many boards restart when the line DTR rises, and
/// the system raises it in every open that finds it low.
enum class BoardRestart {
  /// Opening may restart the board, as it is wired. While the port is open, and when this program dies, DTR
  /// stays up, so that the same print can be taken up again without a restart; a proper close lets it fall.
  kAsWired,
  /// DTR and RTS go down for a quarter of a second and up again: a board that can restart this way does.
  kForce,
  /// DTR stays up after the close, too, so that later opens do not restart the board. This one still may: the
  /// system raises the line before a program can ask it not to.
  kAvoid
};

struct PortOptions {
  /// Bits per second on a real serial line; network and native USB ignore it. 0: found by trying the usual
  /// ones. DEFAULT: 115200.
  int baud = 115200;
  BoardRestart restart = BoardRestart::kAsWired;
  /// For a network connection to come about.
  Duration connect_timeout = std::chrono::seconds(5);
};

}  // namespace lamina::transport
