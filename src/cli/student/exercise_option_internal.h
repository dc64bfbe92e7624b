#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace rex::cli {

inline constexpr const char* kExerciseHelp = "number, topic or whole name: 01, kinematics, 01-kinematics";
inline constexpr const char* kExercisesHelp = "numbers, topics or whole names: 01, kinematics, 01-kinematics";
inline constexpr const char* kOutHelp = "output folder (default: out/EXERCISE, or out/EXERCISE-solution)";

/// The exercise that a command is about.
inline void addExercise(CLI::App* command, std::string& exercise) {
  command->add_option("EXERCISE", exercise, kExerciseHelp)->type_name("")->required();
}

}  // namespace rex::cli
