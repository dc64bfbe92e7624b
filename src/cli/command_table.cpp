#include "cli/command_table.h"

#include <array>

namespace rex::cli {

std::string programName(Program program) {
  switch (program) {
    case Program::kStudent:
      return "rex";
    case Program::kRobot:
      return "rex-robot";
    case Program::kInstructor:
      return "rex-teach";
  }
  return "";
}

const char* toString(Topic topic) {
  switch (topic) {
    case Topic::kExercises:
      return "Exercises";
    case Topic::kRobots:
      return "Robots";
    case Topic::kMethods:
      return "Methods";
    case Topic::kCourses:
      return "Courses";
  }
  return "";
}

std::span<const TableEntry> commandTable() {
  using enum Topic;
  constexpr Program kStudent = Program::kStudent, kRobot = Program::kRobot,
                    kInstructor = Program::kInstructor;
  static constexpr auto kTable = std::to_array<TableEntry>({
      {"init", "Make a course folder with the exercises, to work in", kExercises, kStudent},
      {"update", "Bring new and changed exercises into your course folder", kExercises, kStudent},
      {"list", "Show all exercises with points, script section and title", kExercises, kStudent},
      {"run", "Build and run your main.cpp or any .cpp file, list what it wrote", kExercises, kStudent},
      {"test", "Grade your main.cpp: which checks pass, and their points", kExercises, kStudent},
      {"watch", "Grade your main.cpp now and whenever you save it", kExercises, kStudent},
      {"hint", "Show the next hint for an exercise", kExercises, kStudent},
      {"show", "Say where replays, films and pictures are, or print the solution", kExercises, kStudent},
      {"debug", "Run your main.cpp in the debugger gdb", kExercises, kStudent},
      {"reset", "Restore main.cpp as it was handed out", kExercises, kStudent},
      {"submit", "Write the zip file to hand in, with a receipt", kExercises, kStudent},
      {"scene", "Inspect, check or convert a scene", kRobots, kRobot},
      {"view", "Move a robot in a browser: sliders, dragging, simulation", kRobots, kRobot},
      {"render", "Draw a scene: a picture, a film, a model or a page with a replay", kRobots, kRobot},
      {"simulate", "Let a robot fall, or hold it: a log, an energy plot and a film", kRobots, kRobot},
      {"plan", "Plan the path of a robot or car around obstacles: path, film and replay", kRobots, kRobot},
      {"doctor", "Test what pictures need on this machine, or attack its sandbox", kRobots, kRobot},
      {"demo", "Show a method of a chapter in a browser, or as a page", kMethods, kStudent},
      {"slam", "Optimise a pose graph, so that the map fits its measurements", kMethods, kRobot},
      {"linear", "Judge a linear system: stability, regulator, filter, Bode and Nyquist plots", kMethods,
       kRobot},
      {"import", "Take submissions from Moodle, Gradescope, git clones or folders", kCourses, kInstructor},
      {"grade", "Grade the submissions of many students", kCourses, kInstructor},
      {"export", "Write grades and feedback for Moodle, Canvas and others", kCourses, kInstructor},
      {"dev", "For those who write exercises and teach: new, check, release, stats", kCourses, kInstructor},
  });
  return kTable;
}

}  // namespace rex::cli
