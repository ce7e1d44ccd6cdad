#include "tools/bench/kill_campaign.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

#include "tools/bench/host_process.h"
#include "tools/bench/live_printer.h"

namespace lamina::tools {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::duration;
using transport::Bead;

constexpr double kLongest = 60;  // s of real time for one host
constexpr int kMostHosts = 12;

/// Something of everything that a host must carry over: relative and absolute extrusion, retractions, layers,
/// fan, flow, an arc, a dwell, E set anew.
std::string short_print() {
  std::string text =
      "; a short print\nM140 S60\nM104 S200\nG28\nM190 S60\nM109 S200\nG90\nM82\nG92 E0\n"
      "M204 P1500 T1500\nG1 Z2 F600\n";
  constexpr int kLayers = 6;
  constexpr int kChords = 24;
  double e = 0;
  for (int layer = 0; layer < kLayers; ++layer) {
    text += fmt::format(";LAYER_CHANGE\n;LAYER:{}\nG1 Z{:.2f} F600\nG1 X60 Y50 F6000\nG1 F1800\n", layer,
                        0.2 + 0.2 * layer);
    if (layer == 1) text += "M106 S128\nM221 S95\n";
    if (layer == 3) text += "M83\nG92 E0\n";
    for (int i = 1; i <= kChords; ++i) {
      const double angle = i * 2 * std::numbers::pi / kChords;
      const double feed = 0.06 + 0.002 * (i % 7) + 0.0001 * layer;
      e += feed;
      text += fmt::format("G1 X{:.3f} Y{:.3f} E{:.5f} ; chord\n", 50 + 10 * std::cos(angle),
                          50 + 10 * std::sin(angle), layer < 3 ? e : feed);
    }
    if (layer < 3) {
      text += fmt::format("G1 E{:.5f} F2100\nG4 P50\nG1 E{:.5f} F2100\nG92 E0\n", e - 0.8, e);
      e = 0;
    } else {
      text += "G1 E-0.8 F2100\nG2 X52 Y50 I-4 J0\nG1 E0.8 F2100\n";
    }
  }
  return text + "M107\nM104 S0\nM140 S0\nM84\n";
}

class Campaign {
 public:
  explicit Campaign(const KillOptions& options) : options_(options), random_(options.seed) {
    folder_ = fs::temp_directory_path() / fmt::format("lamina_kill_{}", ::getpid());
    fs::create_directories(folder_);
    std::ofstream(folder_ / "print.gcode") << short_print();
  }
  Campaign(const Campaign&) = delete;
  Campaign& operator=(const Campaign&) = delete;
  ~Campaign() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  KillCampaign run() {
    KillCampaign campaign;
    print_undisturbed(campaign);
    for (int i = 0; i < options_.kills; ++i) campaign.prints.push_back(print_killed(campaign.seconds));
    return campaign;
  }

 private:
  std::vector<std::string> arguments(const LivePrinter& printer, bool resume) const {
    std::vector<std::string> arguments{options_.program.string(),
                                       "print",
                                       (folder_ / "print.gcode").string(),
                                       "--port",
                                       printer.path(),
                                       "--journal",
                                       (folder_ / "journal").string(),
                                       "--time-scale",
                                       fmt::format("{}", options_.time_scale),
                                       "--quiet",
                                       "--force"};
    if (resume) arguments.emplace_back("--resume");
    return arguments;
  }

  std::string messages() const {
    std::ostringstream text;
    text << std::ifstream(folder_ / "messages").rdbuf();
    return text.str();
  }

  void print_undisturbed(KillCampaign& campaign) {
    LivePrinter printer(options_.time_scale);
    const Clock::time_point begin = Clock::now();
    HostProcess host(arguments(printer, false), folder_ / "messages");
    if (host.wait(kLongest) != 0) throw std::runtime_error("the undisturbed print failed: " + messages());
    campaign.seconds = duration<double>(Clock::now() - begin).count();
    reference_ = printer.switch_off().beads;
    campaign.beads = reference_.size();
  }

  KilledPrint print_killed(double usual_seconds) {
    KilledPrint print;
    LivePrinter printer(options_.time_scale);
    std::error_code ignored;
    fs::remove(folder_ / "journal", ignored);
    bool resume = false;
    for (int hosts = 0; hosts < kMostHosts && !print.completed; ++hosts) {
      const bool to_be_killed = hosts == 0 || (print.deaths < 4 && chance_(random_) < options_.again);
      const double life = to_be_killed ? usual_seconds * chance_(random_) : kLongest;
      HostProcess host(arguments(printer, resume), folder_ / "messages");
      const std::optional<int> status = host.wait(life);
      if (!status) {
        host.kill();
        ++print.deaths;
        if (hosts == 0) print.after = life;
        resume = true;
        continue;
      }
      print.completed = *status == 0;
      print.finished_first = print.completed && print.deaths == 0;
      if (print.completed) break;
      const std::string said = messages();
      // Killed behind its last breath.
      if (said.find("was completed") != std::string::npos) {
        print.completed = print.finished_first = true;
        break;
      }
      constexpr int kNothingToResume = 3;
      if (*status == kNothingToResume && said.find("nothing to resume") != std::string::npos) {
        print.begun_anew = true;
        resume = false;
        continue;
      }
      print.trouble = said;
      ++print.given_up;
      resume = true;
    }
    const std::vector<Bead>& beads = printer.switch_off().beads;
    print.beads = beads.size();
    print.same = beads == reference_;
    return print;
  }

  KillOptions options_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> chance_{0, 1};
  fs::path folder_;
  std::vector<Bead> reference_;
};

}  // namespace

KillCampaign run_kill_campaign(const KillOptions& options) {
  return Campaign(options).run();
}

}  // namespace lamina::tools
