#include "profiles/profile_store.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "profiles/embedded_profiles.h"
#include "profiles/nearest_name.h"

namespace lamina::profiles {
namespace {

constexpr std::string_view kExtension = ".toml";

std::string folder_name(ProfileKind kind) {
  switch (kind) {
    case ProfileKind::kPrinter:
      return "printers";
    case ProfileKind::kFilament:
      return "filaments";
    case ProfileKind::kQuality:
      return "qualities";
  }
  return {};
}

[[noreturn]] void refuse(const Origin& origin, const std::string& problem, const std::string& hint = {}) {
  ProfileError::Fields fields;
  fields.origin = origin;
  fields.problem = problem;
  fields.hint = hint;
  throw ProfileError(std::move(fields));
}

std::string read_file(const std::filesystem::path& path, const Origin& wanted_by) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file || !text) refuse(wanted_by, "cannot read the profile file " + path.string());
  return text.str();
}

}  // namespace

ProfileStore::ProfileStore(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {
  for (const std::filesystem::path& folder : folders_) {
    if (!std::filesystem::is_directory(folder)) {
      refuse({}, "no such folder of profiles: " + folder.string(), "is LAMINA_PROFILE_PATH right?");
    }
  }
}

std::vector<std::string> ProfileStore::names(ProfileKind kind) const {
  std::set<std::string> names;
  for (const std::filesystem::path& folder : folders_) {
    const std::filesystem::path kind_folder = folder / folder_name(kind);
    if (!std::filesystem::is_directory(kind_folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(kind_folder)) {
      if (entry.path().extension() == kExtension) names.insert(entry.path().stem().string());
    }
  }
  const std::string prefix = folder_name(kind) + "/";
  for (const EmbeddedProfile& profile : embedded_profiles()) {
    if (!profile.path.starts_with(prefix)) continue;
    names.emplace(
        profile.path.substr(prefix.size(), profile.path.size() - prefix.size() - kExtension.size()));
  }
  return {names.begin(), names.end()};
}

Profile ProfileStore::load(ProfileKind kind, const std::string& name, const Origin& wanted_by) const {
  if (name.ends_with(kExtension)) return read_profile(read_file(name, wanted_by), name, kind);

  const std::string file = folder_name(kind) + "/" + name + std::string(kExtension);
  std::optional<Profile> profile;
  for (const std::filesystem::path& folder : folders_) {
    const std::filesystem::path path = folder / file;
    if (!std::filesystem::is_regular_file(path)) continue;
    profile = read_profile(read_file(path, wanted_by), path.string(), kind);
    break;
  }
  if (!profile) {
    for (const EmbeddedProfile& embedded : embedded_profiles()) {
      if (embedded.path != file) continue;
      profile = read_profile(std::string(embedded.text), "built-in " + file, kind);
    }
  }
  if (!profile) {
    const std::vector<std::string> known = names(kind);
    refuse(wanted_by, fmt::format("unknown {} profile '{}'", to_text(kind), name),
           suggestion(name, known, fmt::format("there are: {}", fmt::join(known, ", "))));
  }
  if (profile->name != name) {
    refuse({profile->source, 0, 0}, fmt::format("name is '{}', but the file is '{}{}': they must agree",
                                                profile->name, name, kExtension));
  }
  return *profile;
}

std::vector<Profile> ProfileStore::load_chain(ProfileKind kind, const std::string& name,
                                              const Origin& wanted_by) const {
  std::vector<Profile> chain{load(kind, name, wanted_by)};
  while (chain.back().inherits) {
    const TomlEntry inherits = *chain.back().inherits;
    Profile parent = load(kind, std::get<std::string>(inherits.value), inherits.origin);
    const auto same = std::find_if(chain.begin(), chain.end(),
                                   [&](const Profile& profile) { return profile.source == parent.source; });
    if (same != chain.end()) {
      std::string cycle;
      for (auto profile = same; profile != chain.end(); ++profile) cycle += profile->name + " -> ";
      refuse(inherits.origin,
             fmt::format("'{}' inherits from itself: {}{}", parent.name, cycle, parent.name));
    }
    chain.push_back(std::move(parent));
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

std::vector<std::filesystem::path> split_search_path(const std::string& search_path) {
  std::vector<std::filesystem::path> folders;
  std::istringstream stream(search_path);
  for (std::string folder; std::getline(stream, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

}  // namespace lamina::profiles
