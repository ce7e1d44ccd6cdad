#include "profiles/resolve.h"

#include <functional>

#include <catch2/catch.hpp>

#include "profiles/key_table.h"
#include "tests/profiles/profile_folder.h"

using namespace lamina::profiles;
using lamina::tests::ProfileFolder;

namespace {

ProfileChoice with_quality(const std::string& quality) {
  ProfileChoice choice;
  choice.quality = quality;
  return choice;
}

ProfileChoice with_settings(const std::vector<std::string>& settings) {
  ProfileChoice choice;
  for (const std::string& setting : settings) choice.assignments.push_back(parse_assignment(setting));
  return choice;
}

ProfileError error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ProfileError& error) {
    return error;
  }
  FAIL("no ProfileError was thrown");
  return ProfileError({});
}

std::string message_of(const std::function<void()>& action) {
  return error_of(action).what();
}

}  // namespace

TEST_CASE("every shipped profile resolves, in every combination") {
  const ProfileStore store;
  REQUIRE(store.names(ProfileKind::kPrinter) ==
          std::vector<std::string>{"ender3", "generic_marlin_220", "prusa_mk3s"});
  REQUIRE(store.names(ProfileKind::kFilament) == std::vector<std::string>{"petg", "pla"});
  REQUIRE(store.names(ProfileKind::kQuality) == std::vector<std::string>{"draft", "fine", "normal"});
  for (const std::string& printer : store.names(ProfileKind::kPrinter)) {
    for (const std::string& filament : store.names(ProfileKind::kFilament)) {
      for (const std::string& quality : store.names(ProfileKind::kQuality)) {
        INFO(printer << ", " << filament << ", " << quality);
        const ResolvedProfile resolved = resolve(store, {printer, filament, quality, {}});
        const auto& gcode = resolved.settings.gcode;
        CHECK(gcode.marlin.printer_name == printer);
        CHECK(gcode.filament.name == filament);
        CHECK(gcode.marlin.quality_name == quality);
        CHECK_FALSE(gcode.marlin.templates.start.empty());
        CHECK_FALSE(gcode.marlin.templates.end.empty());
        // No bead is thicker than wide, and no layer thicker than four fifths of the nozzle.
        CHECK(resolved.settings.planes.layer_thickness <= 0.8 * gcode.marlin.nozzle_diameter);
        CHECK(gcode.plan.width.top_surface > resolved.settings.planes.layer_thickness);
      }
    }
  }
}

TEST_CASE("values of the shipped profiles arrive in the option structs") {
  const ProfileStore store;
  const Settings generic = resolve(store, {}).settings;
  CHECK(generic.planes.layer_thickness == 0.2);
  CHECK(generic.planes.layer_thickness == 0.2);
  CHECK(generic.gcode.marlin.layer_height == 0.2);
  CHECK(generic.slice.epsilon == 0.05);
  CHECK(generic.gcode.plan.infill.density == 0.15);
  CHECK(generic.gcode.volume.width == 220.0);
  CHECK(generic.gcode.filament.max_volumetric_speed == 10.0);

  const Settings prusa = resolve(store, {"prusa_mk3s", "petg", "draft", {}}).settings;
  CHECK(prusa.gcode.volume.width == 250.0);
  CHECK(prusa.gcode.volume.height == 210.0);
  CHECK(prusa.gcode.limits.max_jerk.e == 4.5);
  CHECK(prusa.gcode.marlin.features.m73);
  CHECK(prusa.gcode.plan.speed.outer_wall == 35.0);    // override for draft
  CHECK(prusa.gcode.plan.speed.solid_infill == 80.0);  // override for normal, which draft inherits
  CHECK(prusa.gcode.plan.retraction.length == 1.0);    // override for petg
  CHECK(prusa.gcode.filament.max_volumetric_speed == 8.0);

  const Settings ender = resolve(store, {"ender3", "pla", "normal", {}}).settings;
  CHECK(ender.gcode.volume.width == 220.0);  // inherited from the generic printer
  CHECK(ender.gcode.limits.max_feedrate.z == 5.0);
  CHECK(ender.gcode.marlin.temperature.nozzle == 205.0);
}

TEST_CASE("the last one who sets a key wins, and is remembered") {
  const ProfileFolder folder;
  folder.write(
      "qualities/q.toml",
      "schema = 1\nkind = \"quality\"\nname = \"q\"\n[retraction]\nlength = 1\nspeed = 11\nz_hop = 0.1\n"
      "min_travel = 4\nrestart_extra = 0.01\n");
  folder.write(
      "filaments/f.toml",
      "schema = 1\nkind = \"filament\"\nname = \"f\"\n[retraction]\nlength = 2\nspeed = 12\nz_hop = 0.2\n"
      "min_travel = 5\n");
  folder.write(
      "printers/p.toml",
      "schema = 1\nkind = \"printer\"\nname = \"p\"\n[retraction]\nlength = 3\nspeed = 13\nz_hop = 0.3\n"
      "[override.filament.f.retraction]\nlength = 4\nspeed = 14\n");
  const ProfileStore store({folder.path()});
  ProfileChoice choice{"p", "f", "q", {parse_assignment("retraction.length=5")}};
  const ResolvedProfile resolved = resolve(store, choice);
  const auto& retraction = resolved.settings.gcode.plan.retraction;
  CHECK(retraction.length == 5.0);
  CHECK(retraction.speed == 14.0);
  CHECK(retraction.z_hop == 0.3);
  CHECK(retraction.min_travel == 5.0);
  CHECK(retraction.restart_extra == 0.01);
  CHECK(to_text(resolved.at("retraction.length").origin) == "-s retraction.length=5");
  CHECK(to_text(resolved.at("retraction.speed").origin) == folder.file("printers/p.toml") + ":10:1");
  CHECK(to_text(resolved.at("retraction.z_hop").origin) == folder.file("printers/p.toml") + ":7:1");
  CHECK(to_text(resolved.at("retraction.min_travel").origin) == folder.file("filaments/f.toml") + ":8:1");
  CHECK(to_text(resolved.at("retraction.restart_extra").origin) == folder.file("qualities/q.toml") + ":9:1");
  CHECK(to_text(resolved.at("wall.loops").origin) == "default");
}

TEST_CASE("inheritance: the child wins, the grandparent counts, folders go before the built-in profiles") {
  const ProfileFolder folder;
  folder.write_quality("parent", "[wall]\nloops = 7\n[infill]\ndensity = 31\n", "normal");
  folder.write_quality("child", "[wall]\nloops = 8\n", "parent");
  folder.write_quality("draft", "[wall]\nloops = 9\n");
  const ProfileStore store({folder.path()});
  const Settings child = resolve(store, with_quality("child")).settings;
  CHECK(child.gcode.plan.wall.loops == 8);
  CHECK(child.gcode.plan.infill.density == 0.31);
  CHECK(child.gcode.plan.width.top_surface == 0.40);  // from normal, which is built in
  CHECK(resolve(store, with_quality("draft")).settings.gcode.plan.wall.loops == 9);
  CHECK(resolve(store, with_quality(folder.file("qualities/child.toml"))).settings.gcode.plan.wall.loops ==
        8);
}

TEST_CASE("inheritance in a circle, from a stranger, or from nobody is refused") {
  const ProfileFolder folder;
  folder.write_quality("a", "", "b");
  folder.write_quality("b", "", "a");
  folder.write_quality("self", "", "self");
  folder.write_quality("orphan", "", "nromal");
  const ProfileStore store({folder.path()});
  CHECK(message_of([&] { resolve(store, with_quality("a")); }) ==
        folder.file("qualities/b.toml") + ":4:1: 'a' inherits from itself: a -> b -> a");
  CHECK(message_of([&] { resolve(store, with_quality("self")); }) ==
        folder.file("qualities/self.toml") + ":4:1: 'self' inherits from itself: self -> self");
  CHECK(message_of([&] { resolve(store, with_quality("orphan")); }) ==
        folder.file("qualities/orphan.toml") +
            ":4:1: unknown quality profile 'nromal' (did you mean 'normal'?)");
  CHECK(message_of([&] { resolve(store, with_quality("zzzzzz")); }) ==
        "unknown quality profile 'zzzzzz' (there are: a, b, draft, fine, normal, orphan, self)");
}

TEST_CASE("a wrong key or value in a file names file, line, column, value and bound") {
  const ProfileFolder folder;
  const ProfileStore store({folder.path()});
  const auto message = [&](const std::string& body) {
    folder.write_quality("bad", body);
    return message_of([&] { resolve(store, with_quality("bad")); });
  };
  const std::string file = folder.file("qualities/bad.toml");
  CHECK(message("[infill]\n  densty = 20\n") ==
        file + ":6:3: unknown key 'infill.densty' (did you mean 'infill.density'?)");
  CHECK(message("bogus_setting = 1\n") ==
        file + ":5:1: unknown key 'bogus_setting' ('lamina profiles show' lists the keys)");
  CHECK(message("[infill]\ndensity = \"20%\"\n") ==
        file + ":6:1: infill.density is \"20%\": it must be a number from 0 to 100 %");
  CHECK(message("[infill]\ndensity = 101\n") ==
        file + ":6:1: infill.density is 101: it must be a number from 0 to 100 %");
  CHECK(message("[layer]\nheight = 0\n") ==
        file + ":6:1: layer.height is 0: it must be a number above 0, at most 10 mm");
  CHECK(message("[layer]\nheight = nan\n") ==
        file + ":6:1: layer.height is nan: it must be a number above 0, at most 10 mm");
  CHECK(message("[wall]\nloops = 2.5\n") ==
        file + ":6:1: wall.loops is 2.5: it must be an integer from 0 to 1000");
  CHECK(
      message("[wall]\nseam = \"alinged\"\n") ==
      file +
          ":6:1: wall.seam is \"alinged\": it must be aligned or rear or nearest (did you mean 'aligned'?)");
  CHECK(message("[retraction]\non_layer_change = 1\n") ==
        file + ":6:1: retraction.on_layer_change is 1: it must be true or false");
  CHECK(message("[filament]\nvendor = \"a\\nb\"\n") ==
        file + ":6:1: filament.vendor is \"a\\nb\": it must be one line of ASCII text");
  CHECK(message("[layer]\nheight = [0.2, 0.3]\n") ==
        file + ":6:1: layer.height must be a number, true, false or a string");
  CHECK(message("[override.filament.pla.wall]\nloops = 2\n") ==
        file + ":6:1: only a printer can override other profiles");

  const ProfileError::Fields fields = [&] {
    folder.write_quality("bad", "[infill]\ndensity = 101\n");
    return error_of([&] { resolve(store, with_quality("bad")); }).fields();
  }();
  CHECK(fields.origin.source == file);
  CHECK(fields.origin.line == 6);
  CHECK(fields.origin.column == 1);
  CHECK(fields.key == "infill.density");
  CHECK(fields.value == "101");
  CHECK(fields.bound == "a number from 0 to 100 %");
}

TEST_CASE("a file that is no profile of its kind is refused") {
  const ProfileFolder folder;
  const ProfileStore store({folder.path()});
  const auto message = [&](const std::string& text) {
    folder.write("qualities/bad.toml", text);
    return message_of([&] { resolve(store, with_quality("bad")); });
  };
  const std::string file = folder.file("qualities/bad.toml");
  CHECK_THAT(message("schema = 1\nkind = = \"quality\"\n"),
             Catch::StartsWith(file + ":2:8: not valid TOML: "));
  CHECK(message("schema = 2\n") == file + ":1:1: schema is 2: this version reads schema 1");
  CHECK(message("schema = 1\nkind = \"printer\"\n") ==
        file + ":2:1: kind is \"printer\": a quality profile is wanted here");
  CHECK(message("kind = \"quality\"\nname = \"bad\"\n") == file + ": a profile needs the line 'schema = 1'");
  CHECK(message("schema = 1\nname = \"bad\"\n") == file + ": a profile needs the line 'kind = \"quality\"'");
  CHECK(message("schema = 1\nkind = \"quality\"\n") == file + ": a profile needs the line 'name = \"...\"'");
  CHECK(message("schema = 1\nkind = \"quality\"\nname = \"other\"\n") ==
        file + ": name is 'other', but the file is 'bad.toml': they must agree");
  CHECK(message_of([&] { resolve(store, with_quality("nowhere/x.toml")); }) ==
        "cannot read the profile file nowhere/x.toml");
  CHECK(message_of([&] { ProfileStore({folder.path() / "missing"}); }) ==
        "no such folder of profiles: " + folder.file("missing") + " (is LAMINA_PROFILE_PATH right?)");
}

TEST_CASE("a printer's override for a filament that does not exist is refused") {
  const ProfileFolder folder;
  folder.write(
      "printers/p.toml",
      "schema = 1\nkind = \"printer\"\nname = \"p\"\n[override.filament.pteg.retraction]\nlength = 4\n");
  const ProfileStore store({folder.path()});
  CHECK(message_of([&] {
          resolve(store, {"p", "pla", "normal", {}});
        }) == folder.file("printers/p.toml") +
                  ":5:1: override for an unknown filament profile 'pteg' (did you mean 'petg'?)");
}

TEST_CASE("settings of the command line: right ones and wrong ones") {
  const ProfileStore store;
  const Settings settings = resolve(store, with_settings({"infill.density=20", "wall.order=outer_first",
                                                          "features.m73=true", "printer.model=My = Printer"}))
                                .settings;
  CHECK(settings.gcode.plan.infill.density == 0.2);
  CHECK(settings.gcode.plan.wall.order == lamina::gcode::WallOrder::kOuterFirst);
  CHECK(settings.gcode.marlin.features.m73);
  CHECK(settings.gcode.marlin.printer_model == "My = Printer");

  const auto message = [&](const std::string& setting) {
    return message_of([&] { resolve(store, with_settings({setting})); });
  };
  CHECK(message("infil.density=20") ==
        "-s infil.density=20: unknown key 'infil.density' (did you mean 'infill.density'?)");
  CHECK(message("infill.density=0,2") ==
        "-s infill.density=0,2: infill.density is \"0,2\": it must be a number from 0 to 100 %");
  CHECK(message("infill.density=") ==
        "-s infill.density=: infill.density is \"\": it must be a number from 0 to 100 %");
  CHECK(message("layer.height=-1") ==
        "-s layer.height=-1: layer.height is -1: it must be a number above 0, at most 10 mm");
  CHECK(message("layer.height=inf") ==
        "-s layer.height=inf: layer.height is inf: it must be a number above 0, at most 10 mm");
  CHECK(message("infill.density") == "-s infill.density: a setting must be written as key=value");
  CHECK(message("=3") == "-s =3: a setting must be written as key=value");
}

TEST_CASE("the footer's block repeats every key once, in one line each") {
  const ResolvedProfile resolved = resolve(ProfileStore(), with_settings({"infill.density=33"}));
  const auto& config = resolved.settings.gcode.marlin.config;
  REQUIRE(config.size() == key_table().size());
  for (const auto& [key, value] : config) {
    INFO(key);
    CHECK(value.find('\n') == std::string::npos);
    if (key == "infill.density") CHECK(value == "33");
    if (key == "wall.seam") CHECK(value == "\"aligned\"");
  }
}
