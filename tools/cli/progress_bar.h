#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace lamina::tools {

/// Progress on stderr: a bar that redraws itself where stderr is a terminal that can do so (TERM is not
/// "dumb"), otherwise one plain line per phase and one every ten seconds. It uses no colour. Nothing of the
/// bar stays behind.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// Begins a phase, at 0.
  void begin(const std::string& phase);

  /// `fraction` in [0, 1]; it never goes back. `detail` stands behind the bar. The time left is guessed from
  /// the fraction where nobody knows better.
  void update(double fraction, const std::string& detail, std::optional<double> seconds_left = std::nullopt);

  /// Says something in a line of its own, above the bar. Quiet or not.
  void say(const std::string& line);

  /// Takes the bar away.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const std::string& detail);
  std::string time_left() const;

  bool quiet_;
  bool redraws_;
  bool drawn_ = false;
  std::string phase_;
  double fraction_ = 0.0;
  std::optional<double> seconds_left_;
  Clock::time_point begun_;
  Clock::time_point shown_;
};

}  // namespace lamina::tools
