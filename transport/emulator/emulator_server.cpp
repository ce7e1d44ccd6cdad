#include "transport/emulator/emulator_server.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <thread>

namespace lamina::transport {

namespace {

constexpr Duration kLongestSleep = std::chrono::milliseconds(50);
constexpr Duration kProgressInterval = std::chrono::milliseconds(100);
constexpr std::size_t kMostUnread = std::size_t{64} * 1024;

class Server {
 public:
  Server(Port& device, const EmulatorServerOptions& options)
      : device_(device),
        options_(options),
        emulator_(options.emulator),
        to_printer_(options.to_printer),
        to_host_(options.to_host) {}

  EmulatorServerResult run(const std::atomic<bool>& stop) {
    try {
      while (!stop && !emulator_.unplugged()) turn();
      // A pulled cable: the host's end hangs up.
      if (emulator_.unplugged()) device_.close();
    } catch (const PortError&) {
      // The host's end has gone for good; what was printed stands.
    }
    return {emulator_.report(), emulator_.beads()};
  }

 private:
  void turn() {
    const Duration real = std::chrono::steady_clock::now() - start_;
    const Instant now{from_seconds(to_seconds(real) * options_.time_scale)};
    emulator_.advance(now);
    std::array<char, 4096> bytes;
    // What the printer has no room for stays in the device, where it holds the host back.
    while (to_printer_.empty()) {
      const std::size_t count = device_.read(bytes);
      if (count == 0) break;
      to_printer_.send({bytes.data(), count}, now);
      deliver(now);
    }
    deliver(now);
    to_host_.send(emulator_.take_output(), now);
    unread_ += to_host_.take_arrived(now);
    unread_.erase(0, device_.write(unread_));
    if (unread_.size() > kMostUnread) unread_.erase(0, unread_.size() - kMostUnread);
    if (options_.on_progress && real >= progress_due_) {
      progress_due_ = real + kProgressInterval;
      options_.on_progress(emulator_);
    }
    if (to_printer_.empty()) {
      device_.wait(time_to_sleep(now), !unread_.empty());
    } else {
      // Nothing is read from the device just now, so what lies there must not wake us.
      std::this_thread::sleep_for(time_to_sleep(now));
    }
  }

  void deliver(Instant now) {
    const std::string arrived = to_printer_.take_arrived(now);
    const std::size_t taken = emulator_.receive(arrived, now);
    to_printer_.put_back(std::string_view(arrived).substr(taken), now);
    printer_full_ = taken < arrived.size();
  }

  Duration time_to_sleep(Instant now) const {
    std::optional<Instant> next = emulator_.next_event();
    const auto consider = [&next](std::optional<Instant> candidate) {
      if (candidate && (!next || *candidate < *next)) next = candidate;
    };
    consider(to_host_.next_arrival());
    if (!printer_full_) consider(to_printer_.next_arrival());
    if (!next) return kLongestSleep;
    return std::clamp(from_seconds(to_seconds(*next - now) / options_.time_scale), Duration{}, kLongestSleep);
  }

  Port& device_;
  const EmulatorServerOptions& options_;
  Emulator emulator_;
  Wire to_printer_;
  Wire to_host_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string unread_;
  Duration progress_due_{};
  bool printer_full_ = false;
};

}  // namespace

EmulatorServerResult serve_emulator(Port& device, const EmulatorServerOptions& options,
                                    const std::atomic<bool>& stop) {
  return Server(device, options).run(stop);
}

}  // namespace lamina::transport
