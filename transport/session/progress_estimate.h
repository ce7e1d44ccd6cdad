#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lamina::transport {

/// How far along a print is, from what slicers write into it: M73, ;TIME_ELAPSED:, ;TIME:, "estimated
/// printing time", ;LAYER_COUNT:, ;LAYER:, ;LAYER_CHANGE, ;Z:.
class ProgressEstimate {
 public:
  /// Takes one source line.
  void read(std::string_view line);

  /// Share of the printing time that is over, as far as the lines tell; none if they do not.
  std::optional<double> fraction() const;

  /// Seconds left, as the lines tell.
  std::optional<double> seconds_left() const;

  std::int64_t layer() const { return layer_; }              ///< layers begun
  std::int64_t layer_count() const { return layer_count_; }  ///< 0: nobody said

 private:
  void read_comment(std::string_view comment);
  void read_progress(std::string_view command);

  std::int64_t layer_ = 0;
  std::int64_t layer_count_ = 0;
  std::optional<double> total_;    // s
  std::optional<double> elapsed_;  // s
  std::optional<double> left_;     // s
  std::optional<double> percent_;
};

}  // namespace lamina::transport
