#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lamina::tools {

struct KillOptions {
  std::filesystem::path program;  ///< lamina
  int kills = 500;
  std::uint64_t seed = 1;
  /// Seconds for the printer, and for the host's patience, in one second.
  double time_scale = 50;
  /// Chance that a resumed print is killed again.
  double again = 0.3;
};

/// What became of one print that was killed.
struct KilledPrint {
  double after = 0;             ///< s of real time from the start of the host to its death
  int deaths = 0;               ///< hosts killed
  int given_up = 0;             ///< hosts that ended by themselves before the print did, and were resumed
  bool finished_first = false;  ///< the print was over before it could be killed
  bool begun_anew = false;      ///< killed before its first line went out
  bool completed = false;
  bool same = false;    ///< every bead as in the print that nobody disturbed
  std::string trouble;  ///< what the program said, where it did not complete
  std::size_t beads = 0;
};

struct KillCampaign {
  std::size_t beads = 0;  ///< of the undisturbed print
  double seconds = 0;     ///< of real time that it takes
  std::vector<KilledPrint> prints;
};

/// Prints one short file over and over on an emulated printer behind a pseudo-terminal, with a real process
/// as the host that is killed (SIGKILL) at a random moment and resumed by another. The emulated printer lives
/// on here. Throws std::runtime_error where the undisturbed print fails.
KillCampaign run_kill_campaign(const KillOptions& options);

}  // namespace lamina::tools
