#include "tools/cli/command_line.h"

#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <string_view>

#include <CLI/CLI.hpp>

#include "profiles/nearest_name.h"
#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

constexpr std::size_t kHelpColumn = 34;

constexpr const char* kOverview =
    "Slices CAD models made of NURBS surfaces without turning them into triangles, and prints them.";

constexpr const char* kProgramExamples =
    "Examples:\n"
    "  lamina slice part.igs                         part.gcode for a generic 220 mm printer\n"
    "  lamina slice part.igs -p ender3 -s infill.density=30 -o part.gcode\n"
    "  lamina print part.igs --port /dev/ttyUSB0\n"
    "  lamina print part.gcode --emulate             try it without a printer\n"
    "  lamina help slice                             the options of a verb";

double parse_number(const std::string& option, std::string_view text) {
  double number = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec == std::errc() && result.ptr == text.data() + text.size() && std::isfinite(number))
    return number;
  throw Failure(ExitCode::kUsage, option + " is '" + std::string(text) + "': it must be a number");
}

std::string long_name(const std::string& names) {
  const std::size_t comma = names.rfind(',');
  return comma == std::string::npos ? names : names.substr(comma + 1);
}

std::vector<double> parse_numbers(const std::string& option, std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    numbers.push_back(parse_number(option, text.substr(0, comma)));
    if (comma == text.size()) return numbers;
    text.remove_prefix(comma + 1);
  }
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// What is left over after parsing is a mistake; the first one is explained.
void refuse_leftovers(const CLI::App& app) {
  const std::vector<std::string> leftovers = app.remaining();
  if (leftovers.empty()) return;
  const std::string& verb = app.get_name();
  const std::string& first = leftovers.front();
  const std::string help = "'lamina help " + verb + "' lists the options";
  if (first.size() > 1 && first.front() == '-') {
    const std::string name = first.substr(0, first.find('='));
    throw Failure(ExitCode::kUsage, "unknown option '" + name + "' of lamina " + verb,
                  profiles::suggestion(name, option_names(app), help));
  }
  throw Failure(ExitCode::kUsage, "unexpected argument '" + first + "' of lamina " + verb, help);
}

/// What CLI11 says when the value of an option is missing, in our words.
std::string missing_value(const CLI::ArgumentMismatch& error) {
  std::string text = error.what();
  const std::string verbose = ": 1 required ";
  const std::size_t begin = text.find(verbose);
  if (begin != std::string::npos) text.replace(begin, verbose.size(), " needs ");
  if (text.ends_with(" missing")) text.resize(text.size() - std::string(" missing").size());
  return text;
}

[[noreturn]] void refuse_verb(const std::string& word, const std::vector<Verb>& verbs) {
  std::vector<std::string> names{"help"};
  for (const Verb& verb : verbs) names.push_back(verb.name);
  const bool option = word.starts_with("-");
  throw Failure(ExitCode::kUsage, (option ? "unknown option '" : "unknown verb '") + word + "'",
                profiles::suggestion(word, option ? std::vector<std::string>{"--help", "--version"} : names,
                                     "'lamina --help' lists the verbs"));
}

class Program {
 public:
  Program(const std::vector<Verb>& verbs, const std::string& version) : verbs_(verbs) {
    app_.name("lamina");
    app_.set_version_flag("--version", "lamina " + version, "Show the version");
    app_.footer(std::string(kProgramExamples) + "\n\n" + kExitCodesHelp);
    prepare(app_);
    // One verb: what comes behind it may be called like another ("lamina sd print").
    app_.require_subcommand(0, 1);
    for (const Verb& verb : verbs_) {
      CLI::App* const app = app_.add_subcommand(verb.name, verb.summary)->group("Verbs");
      app->footer("Examples:\n" + verb.examples + "\n\n" + kExitCodesHelp);
      prepare(*app);
      OptionSet options(*app);
      verb.declare(options);
    }
  }

  int run(std::vector<std::string> arguments) {
    if (arguments.size() > 1 && arguments[1] == "help") help_as_option(arguments);
    try {
      // CLI11 takes the arguments in reverse.
      app_.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend() - 1));
    } catch (const CLI::Success& request) {
      return app_.exit(request, std::cout, std::cerr);
    } catch (const CLI::RequiredError& error) {
      // A mistyped option explains a missing argument better than the lack of it.
      const CLI::App& app = *app_.get_subcommands().front();
      refuse_leftovers(app);
      throw Failure(ExitCode::kUsage, "lamina " + app.get_name() + ": " + error.what(),
                    "'lamina help " + app.get_name() + "' shows how");
    } catch (const CLI::ArgumentMismatch& error) {
      throw Failure(ExitCode::kUsage, missing_value(error));
    } catch (const CLI::ParseError& error) {
      throw Failure(ExitCode::kUsage, error.what());
    }
    return static_cast<int>(run_verb());
  }

 private:
  static void prepare(CLI::App& app) {
    app.allow_extras();
    app.get_formatter()->column_width(kHelpColumn);
    app.get_formatter()->label("OPTIONS", "options");
    app.get_formatter()->label("SUBCOMMAND", "VERB");
    app.get_formatter()->label("Positionals", "Arguments");
    app.set_help_flag("-h,--help", "Show this help");
  }

  /// "lamina help slice" is "lamina slice --help".
  void help_as_option(std::vector<std::string>& arguments) const {
    arguments.erase(arguments.begin() + 1);
    if (arguments.size() > 1) {
      const std::string word = arguments[1];
      if (std::none_of(verbs_.begin(), verbs_.end(), [&](const Verb& verb) { return verb.name == word; })) {
        refuse_verb(word, verbs_);
      }
      arguments.resize(2);
    }
    arguments.emplace_back("--help");
  }

  ExitCode run_verb() {
    if (!app_.remaining().empty()) refuse_verb(app_.remaining().front(), verbs_);
    const std::vector<CLI::App*> chosen = app_.get_subcommands();
    if (chosen.empty()) {
      std::cerr << app_.help();
      return ExitCode::kUsage;
    }
    const CLI::App& app = *chosen.front();
    refuse_leftovers(app);
    for (const Verb& verb : verbs_) {
      if (verb.name == app.get_name()) return verb.run();
    }
    return ExitCode::kInternal;
  }

  const std::vector<Verb>& verbs_;
  CLI::App app_{kOverview};
};

}  // namespace

void OptionSet::argument(const std::string& name, std::string& target, const std::string& meaning) {
  app_.add_option(name, target, meaning)->type_name("")->required();
}

void OptionSet::arguments(const std::string& name, std::vector<std::string>& target,
                          const std::string& meaning) {
  app_.add_option(name, target, meaning)->expected(0, -1)->type_name("");
}

void OptionSet::text(const std::string& names, std::string& target, const std::string& placeholder,
                     const std::string& meaning) {
  app_.add_option(names, target, meaning)->type_name(placeholder);
}

void OptionSet::text(const std::string& names, std::optional<std::string>& target,
                     const std::string& placeholder, const std::string& meaning) {
  app_.add_option_function<std::string>(
          names, [&target](const std::string& text) { target = text; }, meaning)
      ->type_name(placeholder);
}

void OptionSet::texts(const std::string& names, std::vector<std::string>& target,
                      const std::string& placeholder, const std::string& meaning) {
  app_.add_option(names, target, meaning)
      ->type_name(placeholder)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void OptionSet::number(const std::string& names, double& target, const std::string& placeholder,
                       const std::string& meaning) {
  const auto store = [&target, names](const std::string& text) {
    target = parse_number(long_name(names), text);
  };
  app_.add_option_function<std::string>(names, store, meaning)->type_name(placeholder);
}

void OptionSet::number(const std::string& names, std::optional<double>& target,
                       const std::string& placeholder, const std::string& meaning) {
  const auto store = [&target, names](const std::string& text) {
    target = parse_number(long_name(names), text);
  };
  app_.add_option_function<std::string>(names, store, meaning)->type_name(placeholder);
}

void OptionSet::count(const std::string& names, int& target, const std::string& placeholder,
                      const std::string& meaning) {
  const auto store = [&target, names](const std::string& text) {
    const double value = parse_number(long_name(names), text);
    constexpr double kMost = 1e6;
    if (!(value >= 0.0 && value <= kMost) || value != std::floor(value)) {
      throw Failure(ExitCode::kUsage,
                    long_name(names) + " " + text + ": a whole number of 0 or more is needed");
    }
    target = static_cast<int>(value);
  };
  app_.add_option_function<std::string>(names, store, meaning)->type_name(placeholder);
}

void OptionSet::numbers(const std::string& names, std::vector<double>& target, const std::string& placeholder,
                        const std::string& meaning) {
  const auto store = [&target, names](const std::string& text) {
    target = parse_numbers(long_name(names), text);
  };
  app_.add_option_function<std::string>(names, store, meaning)->type_name(placeholder);
}

void OptionSet::flag(const std::string& names, bool& target, const std::string& meaning) {
  app_.add_flag(names, target, meaning);
}

int run_command_line(const std::vector<std::string>& arguments, const std::vector<Verb>& verbs,
                     const std::string& version) {
  return Program(verbs, version).run(arguments);
}

}  // namespace lamina::tools
