#include "profiles/resolve.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "profiles/key_table.h"
#include "profiles/nearest_name.h"

namespace lamina::profiles {
namespace {

class Resolver {
 public:
  Resolver() {
    const Settings defaults;
    for (const Key& key : key_table()) values_.push_back({key, key.load(defaults), {}});
  }

  void set(const std::string& key, const Value& value, const Origin& origin) {
    for (ResolvedValue& resolved : values_) {
      if (resolved.key.name != key) continue;
      resolved.value = value;
      resolved.origin = origin;
    }
  }

  void set(const std::vector<Profile>& chain) {
    for (const Profile& profile : chain) {
      for (const TomlEntry& entry : profile.settings) set(entry.key, entry.value, entry.origin);
    }
  }

  std::vector<ResolvedValue> take() && { return std::move(values_); }

 private:
  std::vector<ResolvedValue> values_;
};

/// What the printers of a chain override for the chosen filament or quality: for its ancestors first, then
/// for itself.
void apply_overrides(Resolver& resolver, const std::vector<Profile>& printers,
                     const std::vector<Profile>& chosen) {
  for (const Profile& overridden : chosen) {
    for (const Profile& printer : printers) {
      for (const ProfileOverride& replaced : printer.overrides) {
        if (replaced.kind != overridden.kind || replaced.name != overridden.name) continue;
        resolver.set(replaced.entry.key, replaced.entry.value, replaced.entry.origin);
      }
    }
  }
}

void check_override_names(const ProfileStore& store, const std::vector<Profile>& printers) {
  for (const Profile& printer : printers) {
    for (const ProfileOverride& replaced : printer.overrides) {
      const std::vector<std::string> known = store.names(replaced.kind);
      if (std::find(known.begin(), known.end(), replaced.name) != known.end()) continue;
      ProfileError::Fields fields;
      fields.origin = replaced.entry.origin;
      fields.key = replaced.entry.key;
      fields.value = replaced.name;
      fields.problem =
          fmt::format("override for an unknown {} profile '{}'", to_text(replaced.kind), replaced.name);
      fields.hint = suggestion(replaced.name, known);
      throw ProfileError(std::move(fields));
    }
  }
}

/// What several stages want to know is one key, and is handed on here.
void share_between_stages(ResolvedProfile& profile) {
  Settings& settings = profile.settings;
  const double thickness = settings.planes.layer_thickness;
  const double first = settings.planes.first_layer_thickness;
  gcode::MarlinOptions& marlin = settings.gcode.marlin;
  marlin.layer_height = thickness;
  marlin.first_layer_height = first > 0.0 ? first : thickness;
  marlin.printer_name = profile.printer;
  marlin.quality_name = profile.quality;
  settings.gcode.filament.name = profile.filament;
  for (const ResolvedValue& resolved : profile.values) {
    marlin.config.emplace_back(resolved.key.name, to_toml(resolved.value));
  }
}

}  // namespace

Assignment parse_assignment(const std::string& text) {
  const std::string source = "-s " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    ProfileError::Fields fields;
    fields.origin = {source, 0, 0};
    fields.value = text;
    fields.problem = "a setting must be written as key=value";
    throw ProfileError(std::move(fields));
  }
  return {text.substr(0, equals), text.substr(equals + 1), source};
}

const ResolvedValue& ResolvedProfile::at(const std::string& key) const {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const ResolvedValue& resolved) { return resolved.key.name == key; });
  assert(found != values.end());
  return *found;
}

ResolvedProfile resolve(const ProfileStore& store, const ProfileChoice& choice) {
  const std::vector<Profile> qualities = store.load_chain(ProfileKind::kQuality, choice.quality);
  const std::vector<Profile> filaments = store.load_chain(ProfileKind::kFilament, choice.filament);
  const std::vector<Profile> printers = store.load_chain(ProfileKind::kPrinter, choice.printer);
  check_override_names(store, printers);

  Resolver resolver;
  resolver.set(qualities);
  resolver.set(filaments);
  resolver.set(printers);
  apply_overrides(resolver, printers, qualities);
  apply_overrides(resolver, printers, filaments);
  for (const Assignment& assignment : choice.assignments) {
    const Origin origin{assignment.source, 0, 0};
    const Key& key = find_key(assignment.key, origin);
    resolver.set(key.name, parsed(key, assignment.value, origin), origin);
  }

  ResolvedProfile result{printers.back().name, filaments.back().name, qualities.back().name, {}, {}};
  result.values = std::move(resolver).take();
  for (const ResolvedValue& resolved : result.values) resolved.key.store(result.settings, resolved.value);
  share_between_stages(result);
  return result;
}

}  // namespace lamina::profiles
