#include "transport/protocol/line_encoder.h"

#include <utility>

#include "transport/protocol/line_form.h"
#include "transport/protocol/meatpack.h"
#include "transport/protocol/packable_form.h"

namespace lamina::transport {

namespace {

/// Number and checksum of a line, with room for numbers up to a thousand billion.
constexpr std::size_t kMostFrameBytes = 18;

}  // namespace

LineEncoder::LineEncoder(const EngineOptions& options)
    : form_(options.form),
      wanted_(options.meatpack),
      wait_(options.meatpack_wait),
      most_requests_(options.meatpack_requests) {}

void LineEncoder::restart() {
  state_ = State::kPlain;
  requests_ = 0;
}

void LineEncoder::offered() {
  if (wanted_ && state_ == State::kPlain && requests_ == 0) state_ = State::kOffered;
}

void LineEncoder::answered(std::string_view text) {
  const bool confirmed = state_ == State::kAsked && text.starts_with("[MP]") &&
                         text.find(form_.blanks ? " ON ESP" : " ON NSP") != std::string_view::npos;
  if (confirmed) state_ = State::kPacked;
}

bool LineEncoder::negotiates(bool wire_is_clear) const {
  return state_ == State::kAsked || (state_ == State::kOffered && wire_is_clear);
}

std::optional<std::string> LineEncoder::request(Instant now) {
  if (state_ == State::kAsked && now < due_) return std::string();
  if (requests_ == most_requests_) {
    state_ = State::kPlain;
    return std::nullopt;
  }
  state_ = State::kAsked;
  ++requests_;
  due_ = now + wait_;
  return meatpack::start(!form_.blanks);
}

void LineEncoder::damaged() {
  if (state_ != State::kPacked) return;
  state_ = State::kPlainForGood;
  in_doubt_ = true;
}

std::string LineEncoder::encode(LineNumber number, std::string_view command) const {
  const LineFrame frame{form_.blanks, packs() && !form_.blanks};
  std::string text = wire_form(command, form_);
  if (frame.even_digits) {
    // The frame puts an odd count of characters before it.
    std::string packable = packable_form(text, 1);
    if (packable.size() + kMostFrameBytes <= kMaxLineBytes) text = std::move(packable);
  }
  return packed(frame_line(number, text, frame));
}

std::string LineEncoder::packed(std::string bytes) const {
  return packs() ? meatpack::pack(bytes, !form_.blanks) : bytes;
}

std::string LineEncoder::set_right(std::string bytes) {
  if (!std::exchange(in_doubt_, false)) return bytes;
  if (state_ == State::kPlainForGood) return meatpack::control(meatpack::kResetAll) + bytes;
  return on() + bytes;
}

std::string LineEncoder::off() const {
  return packs() || state_ == State::kPlainForGood ? meatpack::control(meatpack::kDisable) : std::string();
}

std::string LineEncoder::on() const {
  return packs() ? meatpack::start(!form_.blanks) : std::string();
}

}  // namespace lamina::transport
