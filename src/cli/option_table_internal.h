#pragma once

#include <concepts>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/terminal.h"
#include "sandbox/confinement.h"

namespace rex::cli {

/// What a name means. Throws UsageError for another one, with all choices and the nearest.
template <typename Value>
Value choose(const char* option, const std::string& name,
             const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [known, value] : choices) {
    if (name == known) return value;
    names.push_back(known);
  }
  throw UsageError({.what = option,
                    .found = "'" + escapeForTerminal(name) + "'",
                    .wanted = join(names, ", "),
                    .nearest = nearestNames(name, names)});
}

/// Throws UsageError for a number that is out of range, or none.
inline void requireBetween(const char* option, double number, double least, double most) {
  if (number >= least && number <= most) return;
  throw UsageError({.what = option,
                    .found = fmt::format("{:.9g}", number),
                    .wanted = fmt::format("{:g} to {:g}", least, most)});
}

/// What is wrong with a seed; nothing for one that thousands of others can follow.
std::string wrongSeed(const std::string& text);

/// `--seed S`. Refuses what is not a seed; CLI11 alone takes -1 for the largest number there is.
template <typename Seed>
CLI::Option* addSeed(CLI::App* command, Seed& seed, const std::string& help) {
  return command->add_option("--seed", seed, help)->check(wrongSeed)->type_name("S");
}

/// `--level N` of the sandbox.
CLI::Option* addLevel(CLI::App* command, std::optional<sandbox::Level>& level);

/// The numbers that an option accepts, both ends included.
struct Range {
  double least = 0, most = 0;
};

/// One option of a command: its flag, the variable that it sets, the numbers or names that it accepts, its
/// unit, and its help. The value of the variable at registration is the default, which the help prints. A
/// number out of range and a name that is none throw UsageError while the command line is parsed. The
/// variable outlives the parsing.
class OptionRow {
 public:
  /// A flag without a value.
  OptionRow(const char* flag, bool& value, const std::string& help);
  /// A number. An empty optional has no default; where it depends on something else, `help` says so.
  template <class Number>
  requires(std::integral<Number> || std::floating_point<Number>) &&
      (!std::same_as<Number, bool>)OptionRow(const char* flag, Number& value, const Range& range,
                                             const char* unit, const std::string& help)
      : OptionRow(flag, unit, fmt::format("{} (default: {})", help, shownNumber(value)), range,
                  [flag, &value](CLI::App* command) { return command->add_option(flag, value); }) {}
  template <class Number>
  OptionRow(const char* flag, std::optional<Number>& value, const Range& range, const char* unit,
            const std::string& help)
      : OptionRow(flag, unit, help, range,
                  [flag, &value](CLI::App* command) { return command->add_option(flag, value); }) {}
  /// What another function adds.
  explicit OptionRow(std::function<CLI::Option*(CLI::App*)> add) : add_(std::move(add)) {}
  /// One of these names, each with what it means.
  template <class Value>
  requires std::is_enum_v<Value> OptionRow(const char* flag, Value& value,
                                           const std::vector<std::pair<std::string, Value>>& names,
                                           const std::string& help)
      : OptionRow([=, &value](CLI::App* command) {
          std::vector<std::string> words;
          std::string usual;
          for (const auto& [name, meant] : names) {
            words.push_back(name);
            if (meant == value) usual = fmt::format(" (default: {})", name);
          }
          return command
              ->add_option_function<std::string>(
                  flag,
                  [=, &value](const std::string& given) {
                    value = choose<Value>(longName(flag).c_str(), given, names);
                  },
                  fmt::format("{}: {}{}", help, join(words, ", "), usual))
              ->type_name("NAME");
        }) {}
  /// Text and paths, with a default unless they are empty, and lists of which each is given with a flag of
  /// its own.
  OptionRow(const char* flag, std::string& value, const char* unit, const std::string& help);
  OptionRow(const char* flag, std::filesystem::path& value, const char* unit, const std::string& help);
  OptionRow(const char* flag, std::vector<std::string>& value, const char* unit, const std::string& help);

  /// It has to be given.
  [[nodiscard]] OptionRow required() &&;

  [[nodiscard]] CLI::Option* addTo(CLI::App* command) const { return add_(command); }

  /// "--out" of "-o,--out".
  [[nodiscard]] static std::string longName(const std::string& flag) { return flag.substr(flag.find("--")); }

 private:
  using Add = std::function<CLI::Option*(CLI::App*)>;
  OptionRow(const char* flag, const char* unit, const std::string& help, const Range& range, const Add& add);

  template <class Number>
  static std::string shownNumber(Number value) {
    if constexpr (std::integral<Number>)
      return fmt::format("{}", value);
    else
      return fmt::format("{:g}", value);
  }

  Add add_;
};

/// Adds the options of a table, in this order, and returns them. Those of a group have a paragraph of their
/// own in the help, under its name.
std::vector<CLI::Option*> addOptions(CLI::App* command, std::initializer_list<OptionRow> table,
                                     const std::string& group = "");

/// `--seed S`; see addSeed().
template <class Seed>
[[nodiscard]] OptionRow seedRow(Seed& seed, const std::string& help = "seed of the random numbers") {
  std::string text = help;
  if constexpr (std::integral<Seed>) text += fmt::format(" (default: {})", seed);
  return OptionRow([&seed, text](CLI::App* command) { return addSeed(command, seed, text); });
}

inline constexpr const char* kExerciseHelp = "number, topic or whole name: 01, kinematics, 01-kinematics";
inline constexpr const char* kExercisesHelp = "numbers, topics or whole names: 01, kinematics, 01-kinematics";
inline constexpr const char* kOutHelp = "output folder (default: out/EXERCISE, or out/EXERCISE-solution)";

/// The exercise that a command is about.
inline void addExercise(CLI::App* command, std::string& exercise) {
  command->add_option("EXERCISE", exercise, kExerciseHelp)->type_name("")->required();
}

}  // namespace rex::cli
