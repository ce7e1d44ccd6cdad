#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace lamina::engine {

/// The attributes of an XML element, valid while it starts.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}

  /// Value of the attribute with that name, whatever its namespace prefix.
  std::optional<std::string_view> find(std::string_view name) const;

 private:
  const char** pairs_;  ///< name, value, name, value ... null
};

/// Told of every element. Names come without namespace prefix.
class XmlHandler {
 public:
  virtual ~XmlHandler() = default;
  virtual void start(std::string_view name, const XmlAttributes& attributes) = 0;
  virtual void end(std::string_view name) = 0;

  std::size_t line = 0;  ///< of the XML text, from 1, set before each call
};

/// Parses an XML text that comes in pieces. Document types are refused. Throws ImportError, naming `file` and
/// the line, where the text is not well-formed; what the handler throws passes through.
class XmlParser {
 public:
  /// Both must outlive the parser.
  XmlParser(XmlHandler& handler, const std::string& file);
  XmlParser(const XmlParser&) = delete;
  XmlParser& operator=(const XmlParser&) = delete;
  ~XmlParser();

  void feed(std::string_view piece);
  void finish();

 private:
  struct State;
  void parse(std::string_view piece, bool is_last);

  std::unique_ptr<State> state_;
};

}  // namespace lamina::engine
