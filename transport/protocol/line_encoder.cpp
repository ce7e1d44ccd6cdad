#include "transport/protocol/line_encoder.h"

#include <utility>

#include "transport/protocol/line_form.h"
#include "transport/protocol/meatpack.h"
#include "transport/protocol/packable_form.h"
#include "transport/protocol/packed_line.h"

namespace lamina::transport {

namespace {

/// Number and checksum of a line, with room for numbers up to a thousand billion.
constexpr std::size_t kMostFrameBytes = 18;

}  // namespace

LineEncoder::LineEncoder(const EngineOptions& options)
    : form_(options.form),
      wanted_(options.meatpack && options.window.lines > 1),
      clean_bytes_wanted_(options.meatpack_after),
      wait_(options.meatpack_wait),
      most_requests_(options.meatpack_requests) {}

void LineEncoder::restart() {
  state_ = State::kPlain;
  offered_ = may_unpack_ = in_doubt_ = false;
  clean_bytes_ = 0;
  requests_ = 0;
}

void LineEncoder::offered() {
  offered_ = wanted_;
  carried(0);
}

void LineEncoder::carried(std::size_t bytes) {
  clean_bytes_ += bytes;
  const bool ready =
      offered_ && state_ == State::kPlain && requests_ == 0 && clean_bytes_ >= clean_bytes_wanted_;
  if (ready) state_ = State::kReady;
}

void LineEncoder::answered(std::string_view text) {
  const bool confirmed = state_ == State::kAsked && text.starts_with("[MP]") &&
                         text.find(form_.blanks ? " ON ESP" : " ON NSP") != std::string_view::npos;
  if (confirmed) state_ = State::kPacked;
}

bool LineEncoder::negotiates() const {
  return state_ == State::kReady || state_ == State::kAsked;
}

std::optional<std::string> LineEncoder::request(Instant now) {
  if (state_ == State::kAsked && now < due_) return std::string();
  if (requests_ == most_requests_) {
    state_ = State::kPlain;
    may_unpack_ = false;
    return std::nullopt;
  }
  state_ = State::kAsked;
  may_unpack_ = true;
  ++requests_;
  due_ = now + wait_;
  return meatpack::start(!form_.blanks);
}

void LineEncoder::trouble() {
  state_ = State::kPlainForGood;
  in_doubt_ = may_unpack_;
}

std::string LineEncoder::encode(LineNumber number, std::string_view command) {
  const std::string text = wire_form(command, form_);
  std::string line = frame_line(number, text, {form_.blanks});
  if (!packs()) return line;
  if (line != last_packed_.line) {
    auto packed = best_packed(number, text);
    if (!packed) {
      trouble();
      return line;
    }
    last_packed_ = {std::move(line), std::move(*packed)};
  }
  return last_packed_.packed;
}

std::optional<std::string> LineEncoder::best_packed(LineNumber number, const std::string& text) const {
  if (form_.blanks || text.size() + kMostFrameBytes > kMaxLineBytes)
    return packed_line(frame_line(number, text, {form_.blanks}), number, !form_.blanks);
  const LineFrame even{false, true, false};
  const LineFrame odd{false, false, true};
  // The frame puts an odd count of characters before the command, or an even one.
  for (const auto& [frame, offset] : {std::pair{even, std::size_t{1}}, std::pair{odd, std::size_t{0}}}) {
    std::string packable = packable_form(text, offset);
    if (packable.size() + kMostFrameBytes > kMaxLineBytes) packable = text;
    auto packed = packed_line(frame_line(number, packable, frame), number, true);
    if (packed) return packed;
  }
  return std::nullopt;
}

std::string LineEncoder::set_right(std::string bytes) {
  if (!std::exchange(in_doubt_, false)) return bytes;
  return meatpack::control(meatpack::kResetAll) + bytes;
}

std::string LineEncoder::off() const {
  return may_unpack_ ? meatpack::control(meatpack::kDisable) : std::string();
}

std::string LineEncoder::on() const {
  return packs() ? meatpack::start(!form_.blanks) : std::string();
}

}  // namespace lamina::transport
