#pragma once

#include <string>

#include "transport/emulator/emulator.h"

namespace lamina::tests {

/// A printer that is hot enough to extrude, says nothing by itself, and writes its beads down.
inline transport::EmulatorOptions hot_printer() {
  transport::EmulatorOptions options;
  options.greet = false;
  options.thermal.room = 200;
  options.record = transport::RecordDetail::kBeads;
  return options;
}

/// A conversation with it, without a host.
struct EmulatorTalk {
  explicit EmulatorTalk(const transport::EmulatorOptions& options) : printer(options) {}

  /// Bytes in; what it has said `listen` later.
  std::string say(const std::string& bytes, transport::Duration listen) {
    printer.receive(bytes, now);
    now += listen;
    printer.advance(now);
    return printer.take_output();
  }

  transport::Instant now{};
  transport::Emulator printer;
};

}  // namespace lamina::tests
