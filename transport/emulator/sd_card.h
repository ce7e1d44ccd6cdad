#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace lamina::transport {

/// The printer's SD card: files, the one that is being printed, the one that is being written. It survives a
/// restart, what is under way does not. Names are as DOS has them, in upper case.
class SdCard {
 public:
  /// Name and size, by name.
  const std::map<std::string, std::string>& files() const { return files_; }
  void put(std::string_view name, std::string content) { files_[dos_name(name)] = std::move(content); }

  /// M23: the file to print next, from its beginning. False if there is none.
  bool select(std::string_view name);
  bool selected() const { return selected_.has_value(); }
  /// Empty without a selected file.
  std::string selected_name() const { return selected_.value_or(""); }
  std::size_t size() const;
  std::size_t position() const { return position_; }
  void seek(std::size_t position) { position_ = position; }

  /// M24, M25, M524.
  void print() { printing_ = selected(); }
  void pause() { printing_ = false; }
  void abort();
  bool printing() const { return printing_; }

  /// The next line of the file that is being printed; none at its end, which also ends the printing and
  /// closes the file, as in Marlin.
  std::optional<std::string> next_line();

  /// M28: from here on lines are written down instead of run. The file is there when it is closed (M29).
  void begin_file(std::string_view name);
  bool writing() const { return written_.has_value(); }
  void write_line(std::string_view line);
  void close_file();

  /// M30. False if there is no such file.
  bool remove(std::string_view name);

  /// A restart: nothing is selected, written or printed any more.
  void restart();

  static std::string dos_name(std::string_view name);

 private:
  std::map<std::string, std::string> files_;
  std::optional<std::string> selected_;
  std::size_t position_ = 0;
  bool printing_ = false;
  std::optional<std::string> written_;  ///< the name
  std::string content_;
};

}  // namespace lamina::transport
