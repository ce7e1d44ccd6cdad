#pragma once

#include <string>

#include <sys/types.h>

#include "transport/port/port.h"

namespace lamina::transport {

/// The part that every port on a file descriptor shares: non-blocking bytes, poll, and errors with the path
/// in them. A call that a signal breaks off is made again. The derived class opens the descriptor and closes
/// it.
class DescriptorPort : public Port {
 public:
  std::size_t read(std::span<char> into) override;
  std::size_t write(std::string_view bytes) override;
  void wait(Duration at_most, bool until_writable) override;
  void discard() override;
  std::string name() const override { return path_; }

 protected:
  explicit DescriptorPort(std::string path) : path_(std::move(path)) {}

  /// Locks the open descriptor against other programs that ask (this one, pyserial and others use the same
  /// lock). The lock goes with the descriptor, also when this process is killed. Throws PortError (kBusy).
  void claim() const;

  /// Waits up to a second until the system has passed on what was written; not if the device has failed. For
  /// `close`.
  void let_leave() const;

  std::string path_;
  int descriptor_ = -1;

 private:
  virtual ssize_t send(std::string_view bytes);
  PortError failure(int error);

  bool failed_ = false;
};

}  // namespace lamina::transport
