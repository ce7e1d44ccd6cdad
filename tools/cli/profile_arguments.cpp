#include "tools/cli/profile_arguments.h"

#include <cstdlib>

namespace lamina::tools {

void SlicingArguments::declare(OptionSet& options) {
  options.text("--layer-height", layer_height, "MM", "Layer thickness (layer.height)");
  options.text("--tolerance", tolerance, "MM", "Accuracy inside a layer (slicing.tolerance)");
  options.text("--degree", degree, "N", "Greatest degree of the contours' curves, 2 to 5 (slicing.degree)");
  options.text("--bridge", bridge, "MM", "Gaps up to this are closed (slicing.longest_bridge)");
  options.text("--slice-at", slice_at, "bottom|middle|top",
               "Where a plane cuts its layer (slicing.position)");
  options.count("--threads", threads, "N", "Threads that slice [0: one a core]; the result is the same");
}

std::vector<profiles::Assignment> SlicingArguments::assignments() const {
  struct Option {
    const char* name;
    const char* key;
    const std::optional<std::string>& value;
  };
  std::vector<profiles::Assignment> result;
  for (const Option& option :
       {Option{"--layer-height", "layer.height", layer_height},
        Option{"--tolerance", "slicing.tolerance", tolerance}, Option{"--degree", "slicing.degree", degree},
        Option{"--bridge", "slicing.longest_bridge", bridge},
        Option{"--slice-at", "slicing.position", slice_at}}) {
    if (!option.value) continue;
    result.push_back({option.key, *option.value, std::string(option.name) + " " + *option.value});
  }
  return result;
}

void ProfileArguments::declare(OptionSet& options) {
  options.text("-p,--printer", choice.printer, "NAME",
               "Printer profile, or a .toml file [generic_marlin_220]");
  options.text("-f,--filament", choice.filament, "NAME", "Filament profile, or a .toml file [pla]");
  options.text("-q,--quality", choice.quality, "NAME", "Quality profile, or a .toml file [normal]");
  options.texts("-s,--set", settings, "KEY=VALUE",
                "One setting, such as infill.density=20; repeatable ('lamina profiles show' lists the keys)");
}

profiles::ProfileStore profile_store() {
  const char* const search_path = std::getenv("LAMINA_PROFILE_PATH");
  return profiles::ProfileStore(profiles::split_search_path(search_path != nullptr ? search_path : ""));
}

profiles::ResolvedProfile resolve(const ProfileArguments& profile, const SlicingArguments& slicing) {
  profiles::ProfileChoice choice = profile.choice;
  choice.assignments = slicing.assignments();
  for (const std::string& setting : profile.settings)
    choice.assignments.push_back(profiles::parse_assignment(setting));
  profiles::ResolvedProfile resolved = profiles::resolve(profile_store(), choice);
  resolved.settings.slice.threads = slicing.threads;
  return resolved;
}

}  // namespace lamina::tools
