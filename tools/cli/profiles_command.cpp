#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <variant>

#include <fmt/format.h>

#include "profiles/nearest_name.h"
#include "tools/cli/failure.h"
#include "tools/cli/json.h"
#include "tools/cli/profile_arguments.h"
#include "tools/cli/verbs.h"

namespace lamina::tools {
namespace {

using profiles::ProfileKind;

constexpr std::array<ProfileKind, 3> kKinds{ProfileKind::kPrinter, ProfileKind::kFilament,
                                            ProfileKind::kQuality};

struct ProfilesArguments {
  std::string action;
  std::vector<std::string> names;
  ProfileArguments profile;
  bool json = false;
};

Json value_json(const profiles::Value& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}

ExitCode list(const ProfilesArguments& arguments) {
  const profiles::ProfileStore store = profile_store();
  Json json = Json::array();
  for (const ProfileKind kind : kKinds) {
    for (const std::string& name : store.names(kind)) {
      const profiles::Profile profile = store.load(kind, name);
      json.push_back({{"kind", to_text(kind)},
                      {"name", name},
                      {"description", profile.description},
                      {"source", profile.source}});
    }
  }
  if (arguments.json) {
    std::cout << to_text(json) << '\n';
    return ExitCode::kOk;
  }
  for (const Json& profile : json) {
    std::cout << fmt::format("{:9} {:20} {}\n", profile["kind"].get<std::string>(),
                             profile["name"].get<std::string>(), profile["description"].get<std::string>());
  }
  return ExitCode::kOk;
}

/// A name given to `show` takes the place of its kind's default.
void choose(profiles::ProfileChoice& choice, const profiles::ProfileStore& store, const std::string& name) {
  std::vector<std::string> all;
  for (const ProfileKind kind : kKinds) {
    const std::vector<std::string> names = store.names(kind);
    all.insert(all.end(), names.begin(), names.end());
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    (kind == ProfileKind::kPrinter    ? choice.printer
     : kind == ProfileKind::kFilament ? choice.filament
                                      : choice.quality) = name;
    return;
  }
  throw Failure(ExitCode::kProfile, "unknown profile '" + name + "'",
                profiles::suggestion(name, all, "'lamina profiles list' shows them"));
}

std::string comment(const profiles::ResolvedValue& resolved) {
  const profiles::Key& key = resolved.key;
  std::string text = key.meaning;
  if (key.type != profiles::ValueType::kGcode && key.type != profiles::ValueType::kText)
    text += "; " + accepted(key);
  return text + "; " + to_text(resolved.origin);
}

void print_toml(const profiles::ResolvedProfile& profile) {
  std::cout << fmt::format("# {}, {}, {}: key = value  # meaning; what it takes; where it was set\n",
                           profile.printer, profile.filament, profile.quality);
  std::string table;
  for (const profiles::ResolvedValue& resolved : profile.values) {
    const std::size_t dot = resolved.key.name.rfind('.');
    const std::string this_table = resolved.key.name.substr(0, dot);
    if (this_table != table) {
      std::cout << "\n[" << this_table << "]\n";
      table = this_table;
    }
    const std::string assignment =
        resolved.key.name.substr(dot + 1) + " = " + profiles::to_toml(resolved.value);
    std::cout << fmt::format("{:28}  # {}\n", assignment, comment(resolved));
  }
}

void print_json(const profiles::ResolvedProfile& profile) {
  Json json{{"printer", profile.printer}, {"filament", profile.filament}, {"quality", profile.quality}};
  for (const profiles::ResolvedValue& resolved : profile.values) {
    json["settings"][resolved.key.name] = {{"value", value_json(resolved.value)},
                                           {"unit", resolved.key.unit},
                                           {"accepts", accepted(resolved.key)},
                                           {"meaning", resolved.key.meaning},
                                           {"origin", to_text(resolved.origin)}};
  }
  std::cout << to_text(json) << '\n';
}

ExitCode show(const ProfilesArguments& arguments) {
  ProfileArguments profile = arguments.profile;
  const profiles::ProfileStore store = profile_store();
  for (const std::string& name : arguments.names) choose(profile.choice, store, name);
  const profiles::ResolvedProfile resolved = resolve(profile);
  if (arguments.json) {
    print_json(resolved);
  } else {
    print_toml(resolved);
  }
  return ExitCode::kOk;
}

ExitCode run(const ProfilesArguments& arguments) {
  if (arguments.action == "list") return list(arguments);
  if (arguments.action == "show") return show(arguments);
  throw Failure(ExitCode::kUsage, "lamina profiles cannot '" + arguments.action + "'",
                profiles::suggestion(arguments.action, {"list", "show"}, "it can list and show"));
}

}  // namespace

Verb profiles_verb() {
  const auto arguments = std::make_shared<ProfilesArguments>();
  return {"profiles", "List the profiles, or show every setting, its value and where it comes from",
          "  lamina profiles list\n"
          "  lamina profiles show prusa_mk3s petg\n"
          "  lamina profiles show -q fine -s infill.density=30 --json\n"
          "  LAMINA_PROFILE_PATH=~/profiles lamina profiles list",
          [arguments](OptionSet& options) {
            options.argument("ACTION", arguments->action, "list or show");
            options.arguments("NAMES", arguments->names,
                              "Profiles to show together, instead of the default ones");
            arguments->profile.declare(options);
            options.flag("--json", arguments->json, "Print it as JSON");
          },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
