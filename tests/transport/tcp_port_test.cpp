#include "transport/port/tcp_port.h"

#include <array>
#include <optional>
#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/transport/port_reading.h"
#include "tests/transport/sample_print.h"
#include "tests/transport/served_printer.h"
#include "transport/port/tcp_host.h"
#include "transport/session/runner.h"

namespace {

using namespace lamina::transport;
using namespace lamina::tests;
using namespace std::chrono_literals;

const TcpAddress kHere{"127.0.0.1", 0};

std::optional<PortError> error_of(const std::string& address, Duration timeout = 5s) {
  PortOptions options;
  options.connect_timeout = timeout;
  try {
    open_port(address, options);
  } catch (const PortError& error) {
    CHECK(std::string(error.what()).find(address) == 0);
    return error;
  }
  return std::nullopt;
}

PortProblem problem_of(const std::string& address, Duration timeout = 5s) {
  const auto error = error_of(address, timeout);
  return error ? error->problem : PortProblem::kSystem;
}

/// A socket bound to this machine that nobody accepts from.
class DeafSocket {
 public:
  explicit DeafSocket(bool listening) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    if (listening) REQUIRE(::listen(socket_, 0) == 0);
    socklen_t size = sizeof address;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  DeafSocket(const DeafSocket&) = delete;
  DeafSocket& operator=(const DeafSocket&) = delete;
  ~DeafSocket() { ::close(socket_); }

  std::string address() const { return to_text(TcpAddress{"127.0.0.1", port_}); }

 private:
  int socket_;
  int port_ = 0;
};

}  // namespace

TEST_CASE("tcp: addresses are read and written") {
  const auto read = [](const std::string& text) {
    const TcpAddress address = parse_tcp_address(text);
    CHECK(to_text(address) == text);
    return address;
  };
  CHECK(read("tcp://printer.local:8888").host == "printer.local");
  CHECK(read("tcp://printer.local:8888").port == 8888);
  CHECK(read("tcp://10.0.0.7:23").port == 23);
  CHECK(read("tcp://[fe80::1%eth0]:2000").host == "fe80::1%eth0");
  CHECK_FALSE(is_tcp_address("/dev/ttyUSB0"));
  for (const char* const text : {"tcp://", "tcp://host", "tcp://host:", "tcp://:23", "tcp://host:port",
                                 "tcp://host:70000", "tcp://host:-1", "tcp://::1:23", "tcp://host:23x"}) {
    INFO(text);
    CHECK(problem_of(text) == PortProblem::kBadAddress);
  }
}

TEST_CASE("tcp: bytes pass both ways, over IPv4 and over IPv6") {
  for (const char* const number : {"127.0.0.1", "::1"}) {
    std::unique_ptr<TcpHost> device;
    try {
      device = std::make_unique<TcpHost>(TcpAddress{number, 0});
    } catch (const PortError& error) {
      WARN("no " << number << " here: " << error.what());
      continue;
    }
    const auto host = open_port(device->name());
    CHECK(host->name() == device->name());
    std::string every_byte;
    for (int i = 0; i < 256; ++i) every_byte += static_cast<char>(i);
    CHECK(host->write(every_byte) == 256);
    CHECK(read_within(*device, 256, 2s) == every_byte);
    CHECK(device->write(every_byte) == 256);
    CHECK(read_within(*host, 256, 2s) == every_byte);
    std::array<char, 16> bytes;
    CHECK(host->read(bytes) == 0);
    // Nothing to set on a network connection, and no harm in asking.
    host->set_baud(250000);
    device->write("stale");
    host->wait(1s, false);
    host->discard();
    CHECK(host->read(bytes) == 0);
  }
}

TEST_CASE("tcp: what is wrong with an address is said") {
  const DeafSocket closed(false);
  const auto refused = error_of(closed.address());
  REQUIRE(refused);
  CHECK(refused->problem == PortProblem::kRefused);
  CHECK(refused->hint.find("ser2net") != std::string::npos);

  // A name that no name server may know (RFC 6761); without any the answer is the same.
  CHECK(problem_of("tcp://printer.invalid:8888") == PortProblem::kUnknownHost);

  // A queue of one that is full: the next ones get no answer, as from a host that is switched off.
  const DeafSocket full(true);
  std::vector<std::unique_ptr<Port>> waiting;
  std::optional<PortError> silent;
  const auto before = std::chrono::steady_clock::now();
  for (int attempt = 0; attempt < 5 && !silent; ++attempt) {
    PortOptions options;
    options.connect_timeout = 300ms;
    try {
      waiting.push_back(open_port(full.address(), options));
    } catch (const PortError& error) {
      silent = error;
    }
  }
  REQUIRE(silent);
  CHECK(silent->problem == PortProblem::kUnreachable);
  CHECK(std::chrono::steady_clock::now() - before < 3s);
}

TEST_CASE("tcp: a port that is taken is said") {
  const TcpHost first(kHere);
  try {
    const TcpHost second(parse_tcp_address(first.name()));
    FAIL("two cannot listen at one port");
  } catch (const PortError& error) {
    CHECK(error.problem == PortProblem::kBusy);
  }
}

TEST_CASE("tcp: hosts may come and go, one at a time") {
  TcpHost device(kHere);
  for (int round = 0; round < 3; ++round) {
    const auto host = open_port(device.name());
    host->write("a");
    CHECK(read_within(device, 1, 2s) == "a");
    const auto second = open_port(device.name());
    // The device sees to its door when it next reads.
    CHECK(read_within(device, 1, 20ms).empty());
    second->wait(2s, false);
    std::array<char, 16> bytes;
    try {
      second->read(bytes);
      FAIL("a second host must be turned away");
    } catch (const PortError& error) {
      CHECK(error.problem == PortProblem::kUnplugged);
    }
    device.write("b");
    CHECK(read_within(*host, 1, 2s) == "b");
    host->close();
    CHECK(read_within(device, 1, 20ms).empty());
  }
  // Without a host, bytes go nowhere.
  CHECK(device.write("lost") == 4);
  device.close();
  device.close();
}

TEST_CASE("tcp: last words arrive, even where the other end's words were never read") {
  TcpHost device(kHere);
  auto host = open_port(device.name());
  host->write("x");
  CHECK(read_within(device, 1, 2s) == "x");
  device.write("unread");
  host->wait(2s, false);
  host->write("M104 S0\n");
  host.reset();
  CHECK(read_within(device, 8, 2s) == "M104 S0\n");
}

TEST_CASE("tcp: a whole print over the network") {
  TcpHost device(kHere);
  ServedPrinter printer(device, fast_printer());
  const auto host = open_port(device.name());
  PrintJob job(source_of(sample_print(120)), quick_start());
  const std::atomic<bool> cancel = false;
  const PrintResult result = run_print(*host, job, {}, cancel);
  INFO(result.failure);
  CHECK(result.outcome == JobPhase::kCompleted);
  CHECK(result.progress.wire.resends == 0);
  CHECK(printer.stop().report.beads == 120);
}

TEST_CASE("tcp: a connection that breaks ends the print with that reason") {
  TcpHost device(kHere);
  ServedPrinter printer(device, fast_printer());
  const auto host = open_port(device.name());
  const PrintResult result = print_until_unplugged(*host, printer, device);
  CHECK(result.outcome == JobPhase::kFailed);
  INFO(result.failure);
  CHECK(result.failure.find("tcp://127.0.0.1:") == 0);
  CHECK(result.failure.find("heaters may still be on") != std::string::npos);
}
