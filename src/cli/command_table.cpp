#include "cli/command_table.h"

#include <array>

namespace rex::cli {

std::string programName(Program program) {
  switch (program) {
    case Program::kStudent:
      return "rex";
    case Program::kRobot:
      return "rex-robot";
    case Program::kMethods:
      return "rex-methods";
    case Program::kInstructor:
      return "rex-instructor";
  }
  return "";
}

std::span<const TableEntry> commandTable() {
  using enum Program;
  static constexpr auto kTable = std::to_array<TableEntry>({
      {"list", "Show all exercises with points, script section and title", kStudent},
      {"run", "Build your main.cpp, or any .cpp file, run it, show what it wrote", kStudent},
      {"test", "Grade your main.cpp: which checks pass, for how many points", kStudent},
      {"report", "Write a result for Gradescope, GitHub, JUnit readers and others", kStudent},
      {"watch", "Grade your main.cpp now and whenever you save it", kStudent},
      {"hint", "Show the next hint for an exercise", kStudent},
      {"show", "Say where the replay, films and pictures of an exercise are", kStudent},
      {"reset", "Start again with main.cpp as it was handed out", kStudent},
      {"solution", "Print the reference solution, where the course allows it", kStudent},
      {"submit", "Write the zip file to hand in, with a receipt", kStudent},
      {"debug", "Run your main.cpp in the debugger gdb", kStudent},
      {"scene", "Look into a scene, check it, convert it", kRobot},
      {"render", "Draw a scene: a picture, a film, a model or a page with a replay", kRobot},
      {"simulate", "Let a robot fall, or hold it: a log, an energy plot and a film", kRobot},
      {"plan", "Find a way for a robot past all obstacles: path, film and replay", kRobot},
      {"trajectory", "Move a body to a point smoothly, past obstacles: motion, costs, film and replay",
       kRobot},
      {"curves", "Find the shortest ways of a car with a turning radius", kMethods},
      {"slam", "Make the map of a pose graph fit its measurements", kMethods},
      {"filter", "Let a filter follow the car: errors, consistency and a film", kMethods},
      {"cma", "Count the evaluations that CMA-ES needs for a test function", kMethods},
      {"care", "Solve an algebraic Riccati equation in continuous time", kMethods},
      {"dare", "Solve an algebraic Riccati equation in discrete time", kMethods},
      {"grade", "Grade what many students handed in", kInstructor},
      {"grade-one", "Grade one line of a list of tasks, unless that is done", kInstructor},
      {"collect", "Make the table of grades, name the tasks that are missing", kInstructor},
      {"doctor", "Try all that pictures need on this machine, or attack its sandbox", kRobot},
      {"bench", "Measure speed against other libraries", kInstructor},
      {"dev", "For those who write exercises and teach: new, check, release, stats", kInstructor},
  });
  return kTable;
}

}  // namespace rex::cli
