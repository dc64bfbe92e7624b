#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/commands.h"

namespace rex::cli {

/// What the command line asks for, ready to be done.
using Action = std::function<ExitCode(const Project&)>;

/// One command of CLI11 in our layout, with examples at the end of its help.
CLI::App* add(CLI::App& parent, const std::string& name, const std::string& purpose,
              const std::string& examples);

/// Prints a help text.
Action print(const std::string& text);

void addExercise(CLI::App* command, std::string& exercise);
void addGl(CLI::App* command, std::string& gl);

/// `rex watch`, `hint`, `show`, `reset`, `solution` and `submit`.
void addStudentCommands(CLI::App& program, Action& action);

/// `rex scene FILE VERB`, `rex render FILE`, `rex simulate FILE` and `rex plan FILE`.
void addScene(CLI::App& program, Action& action);
void addRender(CLI::App& program, Action& action);
void addSimulate(CLI::App& program, Action& action);
void addPlan(CLI::App& program, Action& action);
void addTrajectory(CLI::App& program, Action& action);

}  // namespace rex::cli
