// The kill campaign: the host of a print is killed at random moments and another goes on in its place. The
// deposited record must be the one of a print that nobody disturbed.

#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/bench/kill_campaign.h"

int main(int argc, char** argv) {
  using namespace lamina::tools;
  KillOptions options;
  options.program = LAMINA_PROGRAM;
  bool quick = false;
  bool verbose = false;
  CLI::App app("Kills printing hosts (SIGKILL), resumes, and compares what was deposited", "kill");
  app.add_option("--kills", options.kills, "How many prints are killed")->capture_default_str();
  app.add_option("--seed", options.seed, "Of the moments")->capture_default_str();
  app.add_option("--time-scale", options.time_scale, "Seconds in one second")->capture_default_str();
  app.add_option("--lamina", options.program, "The program to kill");
  app.add_flag("--quick", quick, "Ten kills");
  app.add_flag("--verbose", verbose, "One line for each print");
  CLI11_PARSE(app, argc, argv);
  constexpr int kQuickKills = 10;
  if (quick) options.kills = kQuickKills;
  try {
    const KillCampaign campaign = run_kill_campaign(options);
    int same = 0, deaths = 0, early = 0, anew = 0, given_up = 0;
    for (std::size_t i = 0; i < campaign.prints.size(); ++i) {
      const KilledPrint& print = campaign.prints[i];
      const bool good = print.completed && print.same;
      same += good ? 1 : 0;
      deaths += print.deaths;
      early += print.finished_first ? 1 : 0;
      anew += print.begun_anew ? 1 : 0;
      given_up += print.given_up;
      if (verbose || !good) {
        fmt::print("print {}: killed after {:.3f} s, {} deaths, {} given up, {} beads{}{}{}\n", i,
                   print.after, print.deaths, print.given_up, print.beads,
                   print.begun_anew ? ", begun anew" : "", print.finished_first ? ", finished first" : "",
                   good ? "" : ", NOT THE SAME");
        if (!print.trouble.empty()) fmt::print("  {}", print.trouble);
      }
    }
    fmt::print("seed {}: {} prints of {} beads, {:.2f} s each undisturbed; {} hosts killed\n", options.seed,
               campaign.prints.size(), campaign.beads, campaign.seconds, deaths);
    fmt::print("the same record: {} of {}\n", same, campaign.prints.size());
    fmt::print("killed before the first line: {}; over before the kill: {}; hosts that gave up: {}\n", anew,
               early, given_up);
    return same == static_cast<int>(campaign.prints.size()) ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 2;
  }
}
