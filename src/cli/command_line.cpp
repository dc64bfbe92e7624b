#include "cli/command_line.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/exit_code.h"
#include "base/interruption.h"
#include "cli/build_on_demand.h"
#include "cli/command_line_internal.h"
#include "cli/command_table.h"
#include "cli/project.h"
#include "cli/terminal.h"
#include "submission/demonstrations.h"

namespace rex::cli {

CLI::App* addVerb(CLI::App* command, const std::string& name, const std::string& purpose,
                  const std::string& examples) {
  CLI::App* verb = command->add_subcommand(name, purpose);
  verb->footer(examples);
  return verb;
}

Action print(const std::string& text) {
  return [text](const Project&) {
    say(text.substr(0, text.find_last_not_of('\n') + 1));
    return ExitCode::kFull;
  };
}

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

bool wantsPosture(const CLI::App& command, const std::string& option) {
  const CLI::Option* known = command.get_option_no_throw(option);
  return known && (known->get_type_name() == "POSTURE" || known->get_type_name() == "GOAL");
}

// What may stand in place of the last of these words, which begins it: a command, an option or a verb of the
// command that the others reach, an exercise where the command takes one, a posture of the scene after its
// option. Sorted; empty if a file is meant.
std::vector<std::string> completions(const CLI::App& program, std::span<const std::string> words,
                                     const Project& project, const CommandSet& set) {
  const std::string begun = words.empty() ? "" : words.back();
  const CLI::App& command = reachedBy(program, words.first(words.empty() ? 0 : words.size() - 1));
  std::vector<std::string> found;
  if (set.postures && words.size() > 2 && wantsPosture(command, words[words.size() - 2])) {
    found = set.postures(project, words.first(words.size() - 2));
  } else if (begun.starts_with('-')) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) found.push_back("--" + name);
  } else {
    for (const CLI::App* verb : verbsOf(command)) found.push_back(verb->get_name());
    if (takes("EXERCISE", command) || takes("PROGRAM", command))
      for (const ExerciseInfo& one : project.exercises()) found.push_back(one.name);
    if (takes("DEMONSTRATION", command))
      for (const submission::Demonstration& one :
           submission::demonstrations(project.files() / "share" / "demonstrations"))
        found.push_back(one.name);
  }
  std::erase_if(found, [&](const std::string& one) { return !one.starts_with(begun); });
  std::ranges::sort(found);
  return found;
}

// A minus sign that may be copied, and no line that begins with a command of the language.
std::string plain(std::string_view text) {
  std::string written;
  for (const char c : text) {
    if (c == '\\' || c == '-') written += '\\';
    if ((c == '.' || c == '\'') && (written.empty() || written.back() == '\n')) written += "\\&";
    written += c;
  }
  return written;
}

// The manual page rex(1) in the language of man: the table of commands, exit codes, files and variables.
std::string manualPage() {
  std::string page = ".TH REX 1 \"\" \"rex " REX_VERSION
                     "\" \"User Commands\"\n"
                     ".SH NAME\n"
                     "rex \\- robotics exercises: see, solve and test them\n"
                     ".SH SYNOPSIS\n"
                     ".B rex\n"
                     ".RI [ COMMAND \" [\" ARGUMENTS ]]\n"
                     ".SH DESCRIPTION\n"
                     "Without a command, rex shows your points in all exercises and what to do next.\n"
                     "It works in a course folder, which\n"
                     ".B rex init\n"
                     "makes, and in all folders below it; commands about robots and methods work anywhere.\n"
                     ".B rex COMMAND \\-\\-help\n"
                     "explains the options of a command.\n"
                     ".SH COMMANDS\n";
  const char* topic = "";
  for (const TableEntry& entry : commandTable()) {
    if (std::string_view(topic) != toString(entry.topic))
      page += fmt::format(".SS {}\n", topic = toString(entry.topic));
    page += fmt::format(".TP\n.B {}\n{}.\n", plain(entry.name), plain(entry.purpose));
  }
  page += fmt::format(".SH EXIT STATUS\n{}\n", plain(kExitCodesHelp));
  page +=
      ".SH FILES\n"
      ".TP\n.I exercises/*/main.cpp\nWhat you complete and hand in.\n"
      ".TP\n.I out/\nPictures, films, replays and results. It may be deleted at any time.\n"
      ".TP\n.I .rex/course.json\nMarks a course folder and says what was handed out.\n"
      ".TP\n.I .rex/progress.json\nYour points.\n"
      ".SH ENVIRONMENT\n"
      ".TP\n.B NO_COLOR\nIf set, there are no colours.\n"
      ".TP\n.B TMPDIR\nThe folder for temporary files.\n"
      ".SH SEE ALSO\n"
      "The documents in\n.IR /usr/share/doc/rex ,\nabove all\n.IR student.md .\n";
  return page;
}

// Builds that program of rex if it is out of date, and executes it in place of this one, with the same
// arguments. Throws like bringUpToDate(), and Error if there is no such program.
[[noreturn]] void execProgram(const Project& project, Program program, std::vector<std::string> words) {
  const std::string name = programName(program);
  bringUpToDate(project, {name}, name);
  const std::string file = (project.build / name).string();
  words.insert(words.begin(), file);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  const sigset_t held = stopSignals();
  ::sigprocmask(SIG_UNBLOCK, &held, nullptr);  // signals blocked here would stay blocked there
  ::execv(file.c_str(), arguments.data());
  throw Error({.what = "cannot start a part of rex",
               .where = {file},
               .found = std::strerror(errno),
               .wanted = "the programs of rex side by side, as `scripts/rex` builds them"});
}

Action complain(const std::string& text) {
  return [text](const Project&) {
    note(text);
    return ExitCode::kUsage;
  };
}

// The innermost command that the arguments reached.
const CLI::App* reached(const CLI::App* app) {
  const auto inner = app->get_subcommands();
  return inner.empty() ? app : reached(inner.back());
}

// The name includes arguments that come before a subcommand: "rex scene FILE fk".
std::string fullName(const CLI::App* app) {
  if (app->get_parent() == nullptr) return "rex";
  std::string name = fullName(app->get_parent()) + " " + app->get_name();
  if (app->get_subcommands([](const CLI::App*) { return true; }).empty()) return name;
  for (const CLI::Option* option : app->get_options())
    if (option->get_positional()) name += " " + option->get_name(true);
  return name;
}

// Answers an unknown word with the nearest known ones.
Action explainExtras(const CLI::App* command, const std::string& word) {
  std::vector<std::string> known;
  const bool isOption = word.starts_with("-");
  if (isOption) {
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    if (std::ranges::find(known, word.substr(0, word.find('='))) != known.end())
      return complain(
          fmt::format("rex: option '{}' must come after `{}`", escapeForTerminal(word), fullName(command)));
  } else {
    for (const CLI::App* inner : command->get_subcommands([](const CLI::App*) { return true; }))
      known.push_back(inner->get_name());
  }
  const std::string kind = isOption ? "option" : known.empty() ? "argument" : "command";
  const Error error(
      {.what = fmt::format("{}: unknown {} '{}'", fullName(command), kind, escapeForTerminal(word)),
       .nearest = nearestNames(word, known)});
  return complain(fmt::format("{}\n`{} --help` shows what is available.", error.what(), fullName(command)));
}

bool isFlag(const CLI::App* command, const std::string& name) {
  for (; command != nullptr; command = command->get_parent())
    if (const CLI::Option* option = command->get_option_no_throw(name))
      return option->get_expected_max() == 0;
  return false;
}

// Rewords messages of CLI11 such as "Could not convert: --margin = abc".
std::string reasonOf(const CLI::ParseError& error, const CLI::App* command) {
  const std::string text = error.what(), start = "Could not convert: ", sign = " = ";
  const std::size_t at = text.find(sign);
  if (!text.starts_with(start) || at == std::string::npos) return text;
  const std::string option = text.substr(start.size(), at - start.size());
  return Error({.what = option,
                .found = "'" + escapeForTerminal(text.substr(at + sign.size())) + "'",
                .wanted = isFlag(command, option) ? "no value" : "a number"})
      .what();
}

// Commands of the other programs have only names and purposes here; their arguments are not parsed.
void addCommands(CLI::App& program, const CommandSet& set, Action& action) {
  for (const TableEntry& entry : commandTable()) {
    CLI::App* command = program.add_subcommand(std::string(entry.name), std::string(entry.purpose));
    command->group(toString(entry.topic));
    if (entry.program == set.program) {
      set.commands.at(entry.name)(command, action);
      continue;
    }
    command->set_help_flag();
    command->allow_extras();
  }
}

Program ownerOf(const std::string& command, Program here) {
  for (const TableEntry& entry : commandTable())
    if (command == entry.name) return entry.program;
  return here;
}

// The program that has the command which the arguments reached.
Program ownerOf(const CLI::App& program, Program here) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  return chosen.empty() ? here : ownerOf(chosen.front()->get_name(), here);
}

Action list(const std::vector<std::string>& lines) {
  return [lines](const Project&) {
    for (const std::string& line : lines) say(line);
    return ExitCode::kFull;
  };
}

// `rex help COMMAND` asks for what `rex COMMAND --help` does.
std::vector<std::string> wordsOf(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

// The line that a user now types instead of a command of an earlier version; empty for other words.
std::string newNameOf(const std::vector<std::string>& words) {
  for (const OldCommand& old : oldCommands())
    if (words[0] == old.name || (words.size() > 1 && words[0] + " " + words[1] == old.name))
      return fmt::format("rex: `rex {}` is now: {}", old.name, old.now);
  return "";
}

Action parse(CLI::App& program, const std::vector<std::string>& words, const Action& action) {
  try {
    program.parse(std::vector(words.rbegin(), words.rend()));
  } catch (const CLI::CallForVersion&) {
    return print(program.version());
  } catch (const CLI::CallForHelp&) {
    const CLI::App* command = reached(&program);
    if (const std::vector<std::string> unknown = program.remaining(); command == &program && !unknown.empty())
      return explainExtras(command, unknown.front());
    return print(command->help(command == &program ? "" : fullName(command->get_parent())));
  } catch (const CLI::ParseError& error) {
    const CLI::App* command = reached(&program);
    // Reports a misspelt option first, as it may be the one that is missing.
    if (const std::vector<std::string> unknown = program.remaining(true); !unknown.empty())
      return explainExtras(command, unknown.front());
    return complain(fmt::format("{0}: {1}\n`{0} --help` explains the options.", fullName(command),
                                reasonOf(error, command)));
  }
  return action;
}

Action actionOf(int argc, const char* const* argv, const CommandSet& set, const Project& here) {
  const std::vector<std::string> words = wordsOf(argc, argv);
  const auto handOver = [words](Program other) {
    return [=](const Project& project) -> ExitCode { execProgram(project, other, words); };
  };
  Action action = set.withoutCommand ? set.withoutCommand : handOver(Program::kStudent);
  CLI::App program("Robotics exercises: see, solve and test them. Without a command: your progress", "rex");
  program.footer("`rex help COMMAND` explains a command.\n\n" + std::string(kExitCodesHelp));
  program.set_version_flag("--version", "rex " REX_VERSION, "print the version");
  program.require_subcommand(0, 1);
  program.get_formatter()->column_width(22);
  program.get_formatter()->label("REQUIRED", "");
  addCommands(program, set, action);
  // For shells, and for `cmake --install`; neither is in the help.
  if (!words.empty() && words.front() == "--complete") {
    const Program owner = words.size() > 1 ? ownerOf(words[1], set.program) : set.program;
    if (owner != set.program) return handOver(owner);
    return list(completions(program, std::span(words).subspan(1), here, set));
  }
  if (!words.empty() && words.front() == "--man") return print(manualPage());
  if (!words.empty())
    if (const std::string now = newNameOf(words); !now.empty()) return complain(now);
  Action asked = parse(program, words, action);
  const Program owner = ownerOf(program, set.program);
  return owner == set.program ? asked : handOver(owner);
}

}  // namespace

int runCommandLine(int argc, const char* const* argv, const Project& project, const CommandSet& set) {
  ExitCode code = ExitCode::kGraderFault;
  try {
    code = actionOf(argc, argv, set, project)(project);
  } catch (const UsageError& error) {
    note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
    code = ExitCode::kUsage;
  } catch (const Error& error) {
    note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
  } catch (const std::exception& error) {
    note(fmt::format("rex: {}", error.what()));
  }
  return static_cast<int>(code);
}

int runProgram(int argc, const char* const* argv, const Project& project, const CommandSet& set) {
  try {
    const HeldSignals held;
    return runCommandLine(argc, argv, project, set);
  } catch (const Interrupted& stop) {
    // All is cleaned up. Flush the output, then end by the signal, as its sender wants.
    std::fflush(nullptr);
    return std::raise(stop.signal);
  }
}

}  // namespace rex::cli
