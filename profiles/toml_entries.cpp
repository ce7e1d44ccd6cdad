#include "profiles/toml_entries.h"

#include <algorithm>
#include <string_view>
#include <tuple>

#include <toml++/toml.h>

namespace lamina::profiles {
namespace {

Origin origin_of(const toml::source_region& region, const std::string& source) {
  return {source, region.begin.line, region.begin.column};
}

[[noreturn]] void refuse(const Origin& origin, const std::string& key, const std::string& problem) {
  ProfileError::Fields fields;
  fields.origin = origin;
  fields.key = key;
  fields.problem = problem;
  throw ProfileError(std::move(fields));
}

void collect(const toml::table& table, const std::string& prefix, const std::string& source,
             std::vector<TomlEntry>& entries) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (const toml::table* inner = node.as_table()) {
      collect(*inner, key + ".", source, entries);
      continue;
    }
    TomlEntry entry{key, {}, origin_of(name.source(), source)};
    if (const auto* flag = node.as_boolean()) {
      entry.value = flag->get();
    } else if (const auto* integer = node.as_integer()) {
      entry.value = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
      entry.value = number->get();
    } else if (const auto* text = node.as_string()) {
      entry.value = text->get();
    } else {
      refuse(entry.origin, key, key + " must be a number, true, false or a string");
    }
    entries.push_back(std::move(entry));
  }
}

}  // namespace

std::vector<TomlEntry> parse_toml(const std::string& text, const std::string& source) {
  std::vector<TomlEntry> entries;
  try {
    collect(toml::parse(std::string_view(text), std::string_view(source)), "", source, entries);
  } catch (const toml::parse_error& error) {
    refuse(origin_of(error.source(), source), {}, "not valid TOML: " + std::string(error.description()));
  }
  std::stable_sort(entries.begin(), entries.end(), [](const TomlEntry& a, const TomlEntry& b) {
    return std::tie(a.origin.line, a.origin.column) < std::tie(b.origin.line, b.origin.column);
  });
  return entries;
}

}  // namespace lamina::profiles
