#include "cli/completion.h"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "cli/demonstrations.h"

namespace rex::cli {
namespace {

std::vector<const CLI::App*> verbsOf(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

// The innermost command that the words reach.
const CLI::App& reachedBy(const CLI::App& program, std::span<const std::string> words) {
  const CLI::App* command = &program;
  for (const std::string& word : words)
    for (const CLI::App* verb : verbsOf(*command))
      if (verb->get_name() == word) {
        command = verb;
        break;
      }
  return *command;
}

bool takes(std::string_view what, const CLI::App& command) {
  const auto isMeant = [&](const CLI::Option* option) {
    return option->get_positional() && option->get_name(true).find(what) != std::string::npos;
  };
  return std::ranges::any_of(command.get_options(), isMeant);
}

}  // namespace

std::vector<std::string> completions(const CLI::App& program, std::span<const std::string> words,
                                     const Project& project) {
  const std::string begun = words.empty() ? "" : words.back();
  const CLI::App& command = reachedBy(program, words.first(words.empty() ? 0 : words.size() - 1));
  std::vector<std::string> found;
  if (begun.starts_with('-')) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) found.push_back("--" + name);
  } else {
    for (const CLI::App* verb : verbsOf(command)) found.push_back(verb->get_name());
    if (takes("EXERCISE", command) || takes("PROGRAM", command))
      for (const ExerciseInfo& one : project.exercises()) found.push_back(one.name);
    if (takes("DEMONSTRATION", command))
      for (const Demonstration& one : demonstrations(project)) found.push_back(one.name);
  }
  std::erase_if(found, [&](const std::string& one) { return !one.starts_with(begun); });
  std::ranges::sort(found);
  return found;
}

}  // namespace rex::cli
