#include "tools/cli/gcode_picture.h"

#include <algorithm>
#include <charconv>

#include "gcode/marlin/gcode_line.h"
#include "gcode/marlin/role_name.h"

namespace lamina::tools {
namespace {

double number_in(std::string_view text) {
  double number = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

GcodePicture::GcodePicture(std::size_t layer_count, std::size_t pictures) {
  const std::size_t count = std::min(layer_count, pictures);
  for (std::size_t i = 0; i < count; ++i)
    wanted_.push_back(count == 1 ? 0 : i * (layer_count - 1) / (count - 1));
}

void GcodePicture::read(std::string_view line) {
  if (line.starts_with(';')) {
    read_comment(line.substr(1));
    return;
  }
  if (!line.starts_with("G1 ")) return;
  const gcode::GcodeLine parsed = gcode::parse_line(line);
  gcode::Move move;
  move.end = {parsed.value('X').value_or(position_.x()), parsed.value('Y').value_or(position_.y()),
              parsed.value('Z').value_or(position_.z())};
  if (collecting_ && move.end.head<2>() != position_.head<2>()) {
    if (parsed.value('E').value_or(0.0) > 0.0) {
      move.role = role_;
      move.width = width_;
      move.volume = 1.0;  // Any: a picture shows widths.
    }
    layers_.back().toolpath.moves.push_back(move);
  }
  position_ = move.end;
}

void GcodePicture::read_comment(std::string_view comment) {
  if (comment == "LAYER_CHANGE") {
    collecting_ = std::binary_search(wanted_.begin(), wanted_.end(), next_layer_);
    if (collecting_) {
      layers_.emplace_back();
      layers_.back().toolpath.index = next_layer_;
      layers_.back().start = position_;
    }
    ++next_layer_;
  } else if (comment.starts_with("Z:") && collecting_) {
    layers_.back().toolpath.z = number_in(comment.substr(2));
  } else if (comment.starts_with("TYPE:")) {
    role_ = gcode::role_of_name(comment.substr(5));
    // After the last layer: what follows belongs to none.
    if (comment == "TYPE:Custom") collecting_ = false;
  } else if (comment.starts_with("WIDTH:")) {
    width_ = number_in(comment.substr(6));
  }
}

}  // namespace lamina::tools
