#include "tools/cli/file_header.h"

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <string_view>

#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

constexpr std::int64_t kEndOfYear9999 = 253402300799;

std::int64_t file_time() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::seconds>(now).count();
  }
  const std::string_view text = epoch;
  std::int64_t seconds = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (result.ec == std::errc() && result.ptr == text.data() + text.size() && seconds >= 0 &&
      seconds <= kEndOfYear9999) {
    return seconds;
  }
  throw Failure(ExitCode::kUsage,
                "SOURCE_DATE_EPOCH is '" + std::string(text) + "': it must be seconds since 1970");
}

}  // namespace

void name_print(profiles::Settings& settings, const std::string& object_name) {
  gcode::MarlinOptions& marlin = settings.gcode.marlin;
  marlin.generator_version = LAMINA_VERSION;
  marlin.timestamp = file_time();
  marlin.object_name.clear();
  for (const char c : object_name) marlin.object_name += (c > ' ' && c <= '~') ? c : '_';
}

}  // namespace lamina::tools
