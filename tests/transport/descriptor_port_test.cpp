#include "transport/port/descriptor_port.h"

#include <array>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include "transport/port/pty_host.h"
#include "transport/port/tcp_port.h"

// What every port owes its user, whatever the system does to it.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;

/// A port on one end of a pair of sockets with small buffers; the test holds the other end.
struct Pair {
  Pair() {
    std::array<int, 2> ends{};
    REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0);
    const int small = 4096;
    ::setsockopt(ends[0], SOL_SOCKET, SO_SNDBUF, &small, sizeof small);
    port = std::make_unique<TcpPort>(ends[0], "pair");
    other_end = ends[1];
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;
  ~Pair() { hang_up(); }

  void hang_up() {
    if (other_end >= 0) ::close(other_end);
    other_end = -1;
  }

  std::unique_ptr<TcpPort> port;
  int other_end = -1;
};

std::string numbers(std::size_t bytes) {
  std::string text;
  for (int i = 0; text.size() < bytes; ++i) text += std::to_string(i) + "\n";
  text.resize(bytes);
  return text;
}

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator begin("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator{}));
}

void ignore_signal(int /*signal*/) {}

PortProblem problem_of_write(Port& port) {
  try {
    // The first may still go into a buffer.
    for (int i = 0; i < 3; ++i) port.write("x");
  } catch (const PortError& error) {
    return error.problem;
  }
  return PortProblem::kSystem;
}

}  // namespace

TEST_CASE("port: a write takes what there is room for, and the rest later, in order") {
  Pair pair;
  const std::string all = numbers(200'000);
  std::string received;
  std::string unsent = all;
  int partial_writes = 0;
  int full = 0;
  while (received.size() < all.size()) {
    const std::size_t taken = pair.port->write(unsent);
    REQUIRE(taken <= unsent.size());
    if (taken == 0 && !unsent.empty()) ++full;
    if (taken > 0 && taken < unsent.size()) ++partial_writes;
    unsent.erase(0, taken);
    if (taken > 0) continue;
    std::array<char, 1000> bytes;
    const ssize_t count = ::read(pair.other_end, bytes.data(), bytes.size());
    REQUIRE(count > 0);
    received.append(bytes.data(), static_cast<std::size_t>(count));
  }
  CHECK(partial_writes > 0);
  CHECK(full > 0);
  CHECK(received == all);
  CHECK(pair.port->write("") == 0);
}

TEST_CASE("port: waiting for room ends when there is some") {
  Pair pair;
  const std::string much = numbers(100'000);
  std::size_t written = 0;
  while (const std::size_t taken = pair.port->write(much)) written += taken;
  const auto before = std::chrono::steady_clock::now();
  pair.port->wait(30ms, true);
  CHECK(std::chrono::steady_clock::now() - before >= 25ms);
  std::thread reader([&] {
    std::string bytes(written, ' ');
    std::size_t read = 0;
    while (read < written) {
      const ssize_t count = ::read(pair.other_end, bytes.data(), bytes.size());
      if (count <= 0) break;
      read += static_cast<std::size_t>(count);
    }
  });
  pair.port->wait(10s, true);
  CHECK(pair.port->write("x") == 1);
  reader.join();
  CHECK(std::chrono::steady_clock::now() - before < 5s);
}

TEST_CASE("port: a peer that has gone is an error, not a signal") {
  Pair pair;
  pair.hang_up();
  CHECK(problem_of_write(*pair.port) == PortProblem::kUnplugged);
  std::array<char, 16> bytes;
  CHECK_THROWS_AS(pair.port->read(bytes), PortError);
  // Waiting for a port that has failed does not block, nor does closing it.
  const auto before = std::chrono::steady_clock::now();
  pair.port->wait(10s, false);
  pair.port->close();
  pair.port->close();
  CHECK(std::chrono::steady_clock::now() - before < 1s);
}

TEST_CASE("port: what had arrived before the peer went is still read") {
  Pair pair;
  REQUIRE(::write(pair.other_end, "ok\n", 3) == 3);
  pair.hang_up();
  std::array<char, 16> bytes;
  CHECK(pair.port->read(bytes) == 3);
  CHECK_THROWS_AS(pair.port->read(bytes), PortError);
}

TEST_CASE("port: signals neither fail a call nor prolong a wait") {
  struct sigaction action {};
  action.sa_handler = ignore_signal;  // without SA_RESTART: calls are broken off
  struct sigaction before_action {};
  REQUIRE(::sigaction(SIGUSR1, &action, &before_action) == 0);
  Pair pair;
  const pthread_t self = ::pthread_self();
  std::atomic<bool> done = false;
  std::thread nuisance([&] {
    while (!done) {
      ::pthread_kill(self, SIGUSR1);
      std::this_thread::sleep_for(200us);
    }
  });
  const std::string all = numbers(300'000);
  std::string received;
  std::thread reader([&] {
    std::array<char, 4096> bytes;
    while (received.size() < all.size()) {
      const ssize_t count = ::read(pair.other_end, bytes.data(), bytes.size());
      if (count <= 0) break;
      received.append(bytes.data(), static_cast<std::size_t>(count));
    }
  });
  std::string unsent = all;
  while (!unsent.empty()) {
    unsent.erase(0, pair.port->write(unsent));
    pair.port->wait(100ms, true);
  }
  const auto before = std::chrono::steady_clock::now();
  pair.port->wait(50ms, false);
  CHECK(std::chrono::steady_clock::now() - before < 5s);
  reader.join();
  done = true;
  nuisance.join();
  CHECK(received == all);
  ::sigaction(SIGUSR1, &before_action, nullptr);
}

TEST_CASE("port: closing lets what was written leave") {
  Pair pair;
  const std::string words = numbers(2'000);
  REQUIRE(pair.port->write(words) == words.size());
  std::string received;
  std::thread reader([&] {
    std::this_thread::sleep_for(100ms);
    std::array<char, 4096> bytes;
    for (ssize_t count = 1; count > 0;) {
      count = ::read(pair.other_end, bytes.data(), bytes.size());
      if (count > 0) received.append(bytes.data(), static_cast<std::size_t>(count));
    }
  });
  pair.port->close();
  reader.join();
  CHECK(received == words);
}

TEST_CASE("port: closing does not wait for a peer that never reads") {
  Pair pair;
  while (pair.port->write(numbers(10'000)) > 0) {
  }
  const auto before = std::chrono::steady_clock::now();
  pair.port->close();
  const auto took = std::chrono::steady_clock::now() - before;
  CHECK(took >= 900ms);
  CHECK(took < 3s);
}

TEST_CASE("port: neither a failed open nor a closed port leaves a descriptor") {
  PtyHost device;
  const std::size_t before = open_descriptors();
  for (int round = 0; round < 3; ++round) {
    const auto host = open_port(device.path());
    CHECK(open_descriptors() == before + 1);
    CHECK_THROWS_AS(open_port(device.path()), PortError);
    CHECK_THROWS_AS(open_port("/dev/null"), PortError);
    CHECK_THROWS_AS(open_port("tcp://127.0.0.1:1"), PortError);
  }
  CHECK(open_descriptors() == before);
}
