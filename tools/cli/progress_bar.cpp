#include "tools/cli/progress_bar.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "gcode/marlin/time_text.h"

namespace lamina::tools {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kRedrawInterval{100};
constexpr seconds kLineInterval{10};
constexpr double kEtaAfter = 2.0;  // s: before that it is a guess
constexpr std::size_t kBarWidth = 24;
constexpr std::size_t kUsualColumns = 80;

bool can_redraw() {
  const char* const term = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && term != nullptr && std::string_view(term) != "dumb";
}

std::size_t columns() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsualColumns;
  return size.ws_col;
}

}  // namespace

ProgressBar::ProgressBar(bool quiet) : quiet_(quiet), redraws_(can_redraw()) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::begin(const std::string& phase) {
  clear();
  phase_ = phase;
  fraction_ = 0.0;
  begun_ = Clock::now();
  shown_ = begun_;
  if (quiet_) return;
  if (redraws_) {
    draw({});
  } else {
    std::cerr << phase_ << '\n';
  }
}

void ProgressBar::update(double fraction, const std::string& detail, std::optional<double> seconds_left) {
  seconds_left_ = seconds_left;
  fraction_ = std::clamp(fraction, fraction_, 1.0);
  const Clock::time_point now = Clock::now();
  if (quiet_ || now - shown_ < (redraws_ ? Clock::duration(kRedrawInterval) : Clock::duration(kLineInterval)))
    return;
  shown_ = now;
  if (redraws_) {
    draw(detail);
  } else {
    std::cerr << fmt::format("{}: {:.0f} %  {}\n", phase_, 100.0 * fraction_, detail);
  }
}

void ProgressBar::say(const std::string& line) {
  clear();
  std::cerr << line << '\n';
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::cerr << "\r\x1b[K" << std::flush;
  drawn_ = false;
}

void ProgressBar::draw(const std::string& detail) {
  const auto full = static_cast<std::size_t>(fraction_ * static_cast<double>(kBarWidth));
  std::string line = fmt::format("{} [{}{}] {:3.0f} %", phase_, std::string(full, '#'),
                                 std::string(kBarWidth - full, '.'), 100.0 * fraction_);
  const std::string left = time_left();
  if (!detail.empty()) line += "  " + detail;
  if (!left.empty()) line += "  " + left + " left";
  // A line that wraps cannot be drawn over.
  line.resize(std::min(line.size(), columns() - 1));
  std::cerr << '\r' << line << "\x1b[K" << std::flush;
  drawn_ = true;
}

std::string ProgressBar::time_left() const {
  if (seconds_left_) return gcode::duration_text(*seconds_left_);
  const double elapsed = duration<double>(Clock::now() - begun_).count();
  if (elapsed < kEtaAfter || fraction_ <= 0.0) return {};
  return gcode::duration_text(elapsed * (1.0 - fraction_) / fraction_);
}

}  // namespace lamina::tools
