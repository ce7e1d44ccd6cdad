#include <catch2/catch.hpp>

#include "tests/tools/program_run.h"

using namespace lamina::tests;
using Catch::Contains;
using Catch::StartsWith;

namespace {

struct WrongUse {
  std::string arguments;
  int exit_code;
  std::string complaint;  ///< Part of stderr.
};

}  // namespace

TEST_CASE("help and version go to stdout, with exit code 0") {
  const WorkFolder folder;
  const ProgramRun version = run_lamina(folder, "--version");
  CHECK(version.exit_code == 0);
  CHECK_THAT(version.out, StartsWith("lamina "));
  CHECK(version.err.empty());

  const ProgramRun help = run_lamina(folder, "--help");
  CHECK(help.exit_code == 0);
  for (const std::string verb : {"slice", "print", "emulate", "contours", "info", "profiles", "ports", "replay"}) {
    INFO(verb);
    CHECK_THAT(help.out, Contains("\n  " + verb + " "));
    const ProgramRun of_verb = run_lamina(folder, verb + " --help");
    CHECK(of_verb.exit_code == 0);
    CHECK(of_verb.err.empty());
    CHECK_THAT(of_verb.out, Contains("Examples:\n  lamina " + verb));
    CHECK_THAT(of_verb.out, Contains("Exit codes:"));
    CHECK(run_lamina(folder, "help " + verb).out == of_verb.out);
  }
}

TEST_CASE("wrong usage: exit code, one clear line, nothing on stdout, no file left behind") {
  const std::string box = model_file("box.igs");
  const std::vector<WrongUse> cases{
      {"", 2, "Verbs:"},
      {"slcie part.igs", 2, "error: unknown verb 'slcie'\nhint: did you mean 'slice'?\n"},
      {"help slcie", 2, "error: unknown verb 'slcie'\nhint: did you mean 'slice'?\n"},
      {"--verison", 2, "error: unknown option '--verison'\nhint: did you mean '--version'?\n"},
      {"slice", 2, "error: a model is missing\nhint: name one or more files\n"},
      {"slice --layr-height 0.3", 2,
       "error: unknown option '--layr-height' of lamina slice\nhint: did you mean '--layer-height'?\n"},
      {"slice " + box + " --layr-height=0.3", 2, "hint: did you mean '--layer-height'?\n"},
      {"slice " + box + " other.igs", 3, "error: other.igs: no such file"},
      {"slice " + box + " -o", 2, "error: --output needs FILE\n"},
      {"slice " + box + " --scale two", 2, "error: --scale is 'two': it must be a number\n"},
      {"slice " + box + " --scale 0", 2, "error: --scale is 0: it must be a number above 0\n"},
      {"slice " + box + " --move 1", 2, "error: --move needs two numbers"},
      {"slice " + box + " -o - --json", 2, "error: --json and -o - both write to stdout\n"},
      {"slice " + box + " -o nowhere/x.gcode", 2,
       "error: cannot write to nowhere: No such file or directory\n"},
      {"slice missing.igs", 3, "error: missing.igs: no such file"},
      {"slice " + model_file("README.md"), 3, "error: README.md: "},
      {"slice " + box + " -p endr3", 5, "error: unknown printer profile 'endr3' (did you mean 'ender3'?)\n"},
      {"slice " + box + " -s infil.density=3", 5,
       "error: -s infil.density=3: unknown key 'infil.density' (did you mean 'infill.density'?)\n"},
      {"slice " + box + " --layer-height=-1", 5,
       "error: --layer-height -1: layer.height is -1: it must be a number above 0, at most 10 mm\n"},
      {"slice " + box + " --slice-at botom", 5, "(did you mean 'bottom'?)\n"},
      {"slice " + box + " -s layer.height=0.5", 5, "width.outer_wall"},
      {"slice " + box + " -s 'gcode.start=M104 S{nozle}'", 5, "{nozle}: unknown name 'nozle'"},
      {"slice " + box + " --scale 20", 6, "by 90.000 mm at the left side"},
      {"slice " + box + " --move 105,0", 6, "5.000 mm at the right side"},
      {"slice " + box + " --no-center -s adhesion.skirt_distance=30", 6, "does not fit the printer"},
      {"print " + box, 2, "error: lamina print needs --port DEVICE or --emulate\n"},
      {"print " + box + " --port x --emulate", 2, "error: --port and --emulate exclude each other\n"},
      {"print " + box + " --emulate --baud 9600", 2, "error: --baud needs --port\n"},
      {"print " + box + " --emulate --time-scale 0", 2, "error: --time-scale must be a number above 0\n"},
      {"print missing.gcode --emulate", 3, "error: cannot read missing.gcode\n"},
      {"print " + box + " --port ./no_such_device", 7, "error: ./no_such_device: No such file or directory"},
      {"contours " + box + " --csv - --json", 2, "error: --json and --csv - both write to stdout\n"},
      {"contours " + box + " --at 5,high", 2, "error: --at is 'high': it must be a number\n"},
      {"contours " + box + " --step 0 --csv x.csv", 2, "error: --step must be a number above 0 mm\n"},
      {"contours " + box + " --tolerance 0", 5, "slicing.tolerance is 0"},
      {"contours " + box + " --scale 1e6 --tolerance 0.0001", 4, "error: "},
      {"info", 2, "error: lamina info: MODEL is required\n"},
      {"profiles shw", 2, "error: lamina profiles cannot 'shw'\nhint: did you mean 'show'?\n"},
      {"profiles show pal", 5, "error: unknown profile 'pal'\nhint: did you mean 'pla'?\n"},
      {"emulate --time-scale=-1", 2, "error: --time-scale must be a number above 0\n"},
  };
  for (const WrongUse& wrong : cases) {
    INFO("lamina " << wrong.arguments);
    const WorkFolder folder;
    const ProgramRun run = run_lamina(folder, wrong.arguments);
    CHECK(run.exit_code == wrong.exit_code);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Contains(wrong.complaint));
    CHECK(folder.files().empty());
  }
}

TEST_CASE("info tells units, size and entities") {
  const WorkFolder folder;
  const ProgramRun text = run_lamina(folder, "info " + model_file("box.igs"));
  CHECK(text.exit_code == 0);
  CHECK_THAT(text.out, Contains("box: IGES, 6 surfaces"));
  CHECK_THAT(text.out, Contains("box       (0, 0, 0) to (20, 15, 10) mm"));
  CHECK_THAT(text.out, Contains("6 x 128 "));
}

TEST_CASE("profiles: list names them all, show gives every value with its origin") {
  const WorkFolder folder;
  const ProgramRun list = run_lamina(folder, "profiles list");
  CHECK(list.exit_code == 0);
  for (const char* name :
       {"generic_marlin_220", "ender3", "prusa_mk3s", "pla", "petg", "draft", "normal", "fine"}) {
    CHECK_THAT(list.out, Contains(name));
  }
  const ProgramRun show = run_lamina(folder, "profiles show prusa_mk3s petg -s infill.density=31");
  CHECK(show.exit_code == 0);
  CHECK_THAT(show.out, Contains("# prusa_mk3s, petg, normal:"));
  CHECK_THAT(show.out,
             Contains("density = 31                  # filled share of the inside; a number from 0 to 100 %; "
                      "-s infill.density=31\n"));
  CHECK_THAT(show.out, Contains("built-in printers/prusa_mk3s.toml:"));
}

TEST_CASE("LAMINA_PROFILE_PATH comes before the built-in profiles") {
  const WorkFolder folder;
  const std::string make =
      "mkdir -p mine/qualities && printf 'schema = 1\\nkind = \"quality\"\\nname = \"mine\"\\ninherits = "
      "\"draft\"\\n[infill]\\ndensity = 42\\n' > mine/qualities/mine.toml && ";
  const ProgramRun show = run_shell(folder, make + "LAMINA_PROFILE_PATH=mine \"$LAMINA\" profiles show mine");
  CHECK(show.exit_code == 0);
  CHECK_THAT(show.out, Contains("density = 42"));
  CHECK_THAT(show.out, Contains("mine/qualities/mine.toml:6:1"));
  const ProgramRun missing = run_shell(folder, "LAMINA_PROFILE_PATH=nowhere \"$LAMINA\" profiles list");
  CHECK(missing.exit_code == 5);
  CHECK(missing.err == "error: no such folder of profiles: nowhere (is LAMINA_PROFILE_PATH right?)\n");
}
