#pragma once

#include <string>

namespace lamina::transport {

/// Marlin's MeatPack decoder, between the receive buffer and the line assembler. Off until it is switched on.
/// Errors of the line protocol do not reset it: what it waits for, it goes on waiting for.
class MeatPackDecoder {
 public:
  struct Decoded {
    std::string text;   ///< characters that this byte completed
    std::string reply;  ///< to a control command: what the printer answers at once; else empty
  };

  /// Takes one byte.
  Decoded push(char byte);

  /// As after power-up.
  void restart() { *this = {}; }

  bool enabled() const { return enabled_; }

 private:
  void obey(char code);
  std::string state() const;
  /// A byte that is no part of a control command.
  std::string unpack(char byte);

  bool enabled_ = false;
  bool no_spaces_ = false;
  bool packs_e_ = false;       ///< the table: a reset clears the flag above, and not this
  bool signal_seen_ = false;   ///< one 0xFF
  bool command_next_ = false;  ///< two of them
  int literals_due_ = 0;       ///< characters that come as they are
  char second_after_ = '\0';   ///< follows the literal that is due
};

}  // namespace lamina::transport
