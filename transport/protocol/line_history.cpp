#include "transport/protocol/line_history.h"

#include <cassert>
#include <utility>

namespace lamina::transport {

void LineHistory::reset(LineNumber first) {
  lines_.clear();
  first_ = first;
}

const NumberedLine& LineHistory::append(std::string command, LineOrigin origin) {
  lines_.push_back({next(), std::move(command), origin});
  return lines_.back();
}

const NumberedLine& LineHistory::at(LineNumber number) const {
  assert(number >= first_ && number < next());
  return lines_[static_cast<std::size_t>(number - first_)];
}

void LineHistory::forget_below(LineNumber number) {
  while (first_ < number && !lines_.empty()) {
    lines_.pop_front();
    ++first_;
  }
}

}  // namespace lamina::transport
