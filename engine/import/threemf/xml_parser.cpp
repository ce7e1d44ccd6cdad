#include "engine/import/threemf/xml_parser.h"

#include <exception>

#include <expat.h>
#include <fmt/format.h>

#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

std::string_view without_prefix(std::string_view name) {
  const auto colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

}  // namespace

struct XmlParser::State {
  State(XmlHandler& to, const std::string& name)
      : handler(to), file(name), parser(XML_ParserCreate(nullptr)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { XML_ParserFree(parser); }

  /// Exceptions must not pass through the C library.
  template <typename Call>
  void guarded(const Call& call) {
    if (failure) return;
    try {
      handler.line = XML_GetCurrentLineNumber(parser);
      call();
    } catch (...) {
      failure = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }

  XmlHandler& handler;
  const std::string& file;
  XML_Parser parser;
  std::exception_ptr failure;
};

std::optional<std::string_view> XmlAttributes::find(std::string_view name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
    if (without_prefix(pair[0]) == name) return pair[1];
  }
  return std::nullopt;
}

XmlParser::XmlParser(XmlHandler& handler, const std::string& file)
    : state_(std::make_unique<State>(handler, file)) {
  XML_SetUserData(state_->parser, state_.get());
  XML_SetElementHandler(
      state_->parser,
      [](void* state, const char* name, const char** attributes) {
        auto& self = *static_cast<State*>(state);
        self.guarded([&] { self.handler.start(without_prefix(name), XmlAttributes(attributes)); });
      },
      [](void* state, const char* name) {
        auto& self = *static_cast<State*>(state);
        self.guarded([&] { self.handler.end(without_prefix(name)); });
      });
  XML_SetStartDoctypeDeclHandler(state_->parser, [](void* state, const char*, const char*, const char*, int) {
    auto& self = *static_cast<State*>(state);
    self.guarded([&] {
      throw ImportError({.file = self.file, .section = "XML", .line = self.handler.line},
                        "a document type is declared, which models must not have");
    });
  });
}

XmlParser::~XmlParser() = default;

void XmlParser::feed(std::string_view piece) {
  parse(piece, false);
}

void XmlParser::finish() {
  parse({}, true);
}

void XmlParser::parse(std::string_view piece, bool is_last) {
  const XML_Status status =
      XML_Parse(state_->parser, piece.data(), static_cast<int>(piece.size()), is_last ? 1 : 0);
  if (state_->failure) std::rethrow_exception(state_->failure);
  if (status == XML_STATUS_OK) return;
  throw ImportError(
      {.file = state_->file, .section = "XML", .line = XML_GetCurrentLineNumber(state_->parser)},
      fmt::format("the XML is not well-formed: {}", XML_ErrorString(XML_GetErrorCode(state_->parser))),
      "copy or export it again");
}

}  // namespace lamina::engine
