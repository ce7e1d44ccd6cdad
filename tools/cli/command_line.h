#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/exit_codes.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}

namespace lamina::tools {

/// The options of one verb, while they are declared. Every target must live until the verb has run.
class OptionSet {
 public:
  explicit OptionSet(CLI::App& app) : app_(app) {}

  /// An argument without a name of its own, such as the model; it must be given.
  void argument(const std::string& name, std::string& target, const std::string& meaning);

  /// Any number of them.
  void arguments(const std::string& name, std::vector<std::string>& target, const std::string& meaning);

  /// `names` as in "-o,--output"; `placeholder` stands for the value in the help.
  void text(const std::string& names, std::string& target, const std::string& placeholder,
            const std::string& meaning);
  void text(const std::string& names, std::optional<std::string>& target, const std::string& placeholder,
            const std::string& meaning);

  /// An option that may be given several times.
  void texts(const std::string& names, std::vector<std::string>& target, const std::string& placeholder,
             const std::string& meaning);

  /// A finite number, in C notation whatever the locale.
  void number(const std::string& names, double& target, const std::string& placeholder,
              const std::string& meaning);
  void number(const std::string& names, std::optional<double>& target, const std::string& placeholder,
              const std::string& meaning);

  /// A whole number of 0 or more.
  void count(const std::string& names, int& target, const std::string& placeholder,
             const std::string& meaning);

  /// Numbers separated by commas, at least one.
  void numbers(const std::string& names, std::vector<double>& target, const std::string& placeholder,
               const std::string& meaning);

  void flag(const std::string& names, bool& target, const std::string& meaning);

 private:
  CLI::App& app_;
};

/// One verb of the program.
struct Verb {
  std::string name;
  std::string summary;
  std::string examples;  ///< Lines for the end of its help.
  std::function<void(OptionSet&)> declare;
  std::function<ExitCode()> run;
};

/// Runs `program VERB ...` as the arguments say (those of main) and returns the exit status. Help and version
/// go to stdout, complaints to stderr, with the nearest name for a mistyped verb or option.
int run_command_line(const std::vector<std::string>& arguments, const std::vector<Verb>& verbs,
                     const std::string& version);

}  // namespace lamina::tools
