#include "profiles/profile.h"

#include <utility>

#include <fmt/format.h>

#include "profiles/key_table.h"

namespace lamina::profiles {
namespace {

constexpr std::int64_t kSchema = 1;

[[noreturn]] void refuse(const TomlEntry& entry, const std::string& problem, const std::string& hint = {}) {
  ProfileError::Fields fields;
  fields.origin = entry.origin;
  fields.key = entry.key;
  fields.value = to_toml(entry.value);
  fields.problem = problem;
  fields.hint = hint;
  throw ProfileError(std::move(fields));
}

std::string text_of(const TomlEntry& entry) {
  if (const std::string* text = std::get_if<std::string>(&entry.value)) return *text;
  refuse(entry, fmt::format("{} is {}: it must be a string", entry.key, to_toml(entry.value)));
}

TomlEntry checked_setting(TomlEntry entry) {
  entry.value = checked(find_key(entry.key, entry.origin), entry.value, entry.origin);
  return entry;
}

/// "override.filament.petg.retraction.length" split behind the kind and the name.
ProfileOverride read_override(TomlEntry entry, ProfileKind kind) {
  if (kind != ProfileKind::kPrinter) refuse(entry, "only a printer can override other profiles");
  ProfileOverride result;
  std::string rest = entry.key.substr(std::string("override.").size());
  for (const ProfileKind overridden : {ProfileKind::kFilament, ProfileKind::kQuality}) {
    const std::string prefix = to_text(overridden) + ".";
    const std::size_t name_end = rest.find('.', prefix.size());
    if (!rest.starts_with(prefix) || name_end == std::string::npos) continue;
    result.kind = overridden;
    result.name = rest.substr(prefix.size(), name_end - prefix.size());
    entry.key = rest.substr(name_end + 1);
    result.entry = checked_setting(std::move(entry));
    return result;
  }
  refuse(entry, "an override must be written as [override.filament.NAME] or [override.quality.NAME]");
}

}  // namespace

std::string to_text(ProfileKind kind) {
  switch (kind) {
    case ProfileKind::kPrinter:
      return "printer";
    case ProfileKind::kFilament:
      return "filament";
    case ProfileKind::kQuality:
      return "quality";
  }
  return {};
}

Profile read_profile(const std::string& text, const std::string& source, ProfileKind kind) {
  Profile profile;
  profile.kind = kind;
  profile.source = source;
  bool has_schema = false;
  bool has_kind = false;
  for (TomlEntry& entry : parse_toml(text, source)) {
    if (entry.key == "schema") {
      has_schema = true;
      if (entry.value != Value(kSchema)) {
        refuse(entry,
               fmt::format("schema is {}: this version reads schema {}", to_toml(entry.value), kSchema));
      }
    } else if (entry.key == "kind") {
      has_kind = true;
      if (text_of(entry) != to_text(kind)) {
        refuse(entry,
               fmt::format("kind is {}: a {} profile is wanted here", to_toml(entry.value), to_text(kind)));
      }
    } else if (entry.key == "name") {
      profile.name = text_of(entry);
    } else if (entry.key == "description") {
      profile.description = text_of(entry);
    } else if (entry.key == "inherits") {
      text_of(entry);
      profile.inherits = std::move(entry);
    } else if (entry.key.starts_with("override.")) {
      profile.overrides.push_back(read_override(std::move(entry), kind));
    } else {
      profile.settings.push_back(checked_setting(std::move(entry)));
    }
  }
  const auto need = [&](bool present, const std::string& line) {
    if (present) return;
    ProfileError::Fields fields;
    fields.origin = {source, 0, 0};
    fields.problem = "a profile needs the line '" + line + "'";
    throw ProfileError(std::move(fields));
  };
  need(has_schema, "schema = 1");
  need(has_kind, "kind = \"" + to_text(kind) + "\"");
  need(!profile.name.empty(), "name = \"...\"");
  return profile;
}

}  // namespace lamina::profiles
