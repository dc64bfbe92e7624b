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
      {"init", "Make a course folder with the exercises, to work in", kStudent},
      {"update", "Bring new and changed exercises into your course folder", kStudent},
      {"list", "Show all exercises with points, script section and title", kStudent},
      {"run", "Build and run your main.cpp or any .cpp file, list what it wrote", kStudent},
      {"test", "Grade your main.cpp: which checks pass, and their points", kStudent},
      {"report", "Write a result for Gradescope, GitHub, JUnit readers and others", kStudent},
      {"watch", "Grade your main.cpp now and whenever you save it", kStudent},
      {"hint", "Show the next hint for an exercise", kStudent},
      {"show", "Say where the replay, films and pictures of an exercise are", kStudent},
      {"reset", "Restore main.cpp as it was handed out", kStudent},
      {"solution", "Print the reference solution, if the course allows it", kStudent},
      {"submit", "Write the zip file to hand in, with a receipt", kStudent},
      {"demo", "Show a demonstration of a chapter in a browser, or as a page", kStudent},
      {"debug", "Run your main.cpp in the debugger gdb", kStudent},
      {"scene", "Inspect, check or convert a scene", kRobot},
      {"view", "Move a robot in a browser: sliders, dragging, simulation", kRobot},
      {"render", "Draw a scene: a picture, a film, a model or a page with a replay", kRobot},
      {"simulate", "Let a robot fall, or hold it: a log, an energy plot and a film", kRobot},
      {"plan", "Plan a path of a robot around obstacles: path, film and replay", kRobot},
      {"park", "Park a car in a scene: path, film and replay", kRobot},
      {"trajectory", "Move a body smoothly to a point past obstacles: motion, costs, film and replay",
       kRobot},
      {"curves", "Find the shortest paths of a car with a turning radius", kMethods},
      {"slam", "Optimize a pose graph, so that the map fits its measurements", kMethods},
      {"map", "Map a building by grid SLAM: how true the map is, and a film", kMethods},
      {"localize", "Find a robot in a known map by its scans: errors and a film", kMethods},
      {"walk", "Let the humanoid walk on an uneven floor and push it: zero moment point and a film",
       kMethods},
      {"filter", "Let a filter track the car: errors, consistency and a film", kMethods},
      {"cma", "Count the evaluations that CMA-ES needs for a test function", kMethods},
      {"search", "Compare searches without derivatives on test functions", kMethods},
      {"care", "Solve an algebraic Riccati equation in continuous time", kMethods},
      {"dare", "Solve an algebraic Riccati equation in discrete time", kMethods},
      {"linear", "Judge a linear system: stability, control, observation, Bode and Nyquist plots", kMethods},
      {"import", "Take submissions from Moodle, Classroom, Gradescope or folders", kInstructor},
      {"grade", "Grade the submissions of many students", kInstructor},
      {"grade-one", "Grade one line of a list of tasks, unless it is done", kInstructor},
      {"collect", "Make the table of grades, list missing tasks", kInstructor},
      {"export", "Write grades and feedback for Moodle, Canvas and others", kInstructor},
      {"doctor", "Test what pictures need on this machine, or attack its sandbox", kRobot},
      {"bench", "Measure speed against other libraries", kInstructor},
      {"dev", "For those who write exercises and teach: new, check, release, stats", kInstructor},
  });
  return kTable;
}

}  // namespace rex::cli
