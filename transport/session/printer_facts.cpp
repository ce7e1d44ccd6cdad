#include "transport/session/printer_facts.h"

#include <charconv>

namespace lamina::transport {

namespace {

/// "area:{full:{min:{x:0.00,y:0.00,z:0.00},max:{x:200.00,y:200.00,z:200.00}},work:{...}}": the first six
/// numbers that follow an axis.
std::optional<ReachedVolume> parse_area(std::string_view text) {
  if (!text.starts_with("area:")) return std::nullopt;
  ReachedVolume volume;
  for (std::array<double, 3>* corner : {&volume.low, &volume.high}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      constexpr std::array<std::string_view, 3> kKeys{"{x:", ",y:", ",z:"};
      const std::size_t at = text.find(kKeys[axis]);
      if (at == std::string_view::npos) return std::nullopt;
      text.remove_prefix(at + kKeys[axis].size());
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), (*corner)[axis]);
      if (error != std::errc()) return std::nullopt;
    }
  }
  return volume;
}

}  // namespace

void PrinterFacts::take(const Reply& reply) {
  if (const auto* capability = std::get_if<CapabilityReply>(&reply))
    capabilities[capability->name] = capability->present;
  if (const auto* told = std::get_if<FirmwareReply>(&reply)) firmware = *told;
  if (const auto* text = std::get_if<TextReply>(&reply)) {
    if (const auto area = parse_area(text->text)) volume = area;
  }
}

bool PrinterFacts::can(const std::string& capability) const {
  const auto found = capabilities.find(capability);
  return found != capabilities.end() && found->second;
}

FirmwareDialect dialect(const PrinterFacts& facts) {
  FirmwareDialect dialect;
  dialect.arcs = facts.can("ARCS");
  dialect.bezier = facts.can("BEZIER") || facts.can("BEZIER_CURVES");
  dialect.progress = facts.can("BUILD_PERCENT");
  dialect.objects = facts.can("CANCEL_OBJECTS");
  return dialect;
}

}  // namespace lamina::transport
