#include "cli/student/progress.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/sha256.h"
#include "cli/student/progress_file.h"
#include "cli/terminal.h"
#include "submission/student_build.h"

namespace rex::cli {
namespace {

// Whether main.cpp differs from what was tested last.
bool isEdited(const ExerciseInfo& exercise, const Progress& progress) {
  try {
    return sha256(grading::readStudentFile(exercise.folder / "main.cpp")) != progress.fileSha256;
  } catch (const Error&) {
    return true;
  }
}

std::string lineOf(const ExerciseInfo& exercise, const Progress& progress, std::size_t nameWidth) {
  const int all = progress.tested ? progress.maxPoints : exercise.points();
  const std::string start = fmt::format("{:{}}  [{}] ", exercise.name, nameWidth, bar(progress.points, all));
  if (!progress.tested) return start + fmt::format("  - of {:2}", all);
  const bool isFull = progress.points == all;
  std::string line = start + paint(isFull ? Colour::kGreen : Colour::kYellow,
                                   fmt::format("{:3} of {:2}", progress.points, all));
  if (isEdited(exercise, progress)) line += "   edited since this test";
  return line;
}

// The exercise tested last if it is not solved, else the first unsolved one.
const ExerciseInfo* nextOf(const std::vector<ExerciseInfo>& exercises, const AllProgress& all) {
  const auto isOpen = [&](const ExerciseInfo& exercise) {
    const auto found = all.exercises.find(exercise.name);
    return found == all.exercises.end() || !found->second.solved;
  };
  const ExerciseInfo* next = nullptr;
  for (const ExerciseInfo& exercise : exercises) {
    if (!isOpen(exercise)) continue;
    if (exercise.name == all.last) return &exercise;
    if (next == nullptr) next = &exercise;
  }
  return next;
}

void sayNextStep(const ExerciseInfo& exercise, const Progress& progress) {
  const std::string main = shown(exercise.folder / "main.cpp");
  const std::string rex = "  scripts/rex ";
  say("Next: " + wrap(fmt::format("{}, {}", exercise.name, exercise.title), 6, 6));
  if (!progress.tested) {
    say(fmt::format("  read {} and edit {}, then", shown(exercise.folder / "README.md"), main));
    say(rex + fmt::format("{:20} its pictures", "run " + exercise.name.substr(0, 2)));
  } else {
    say(fmt::format("  go on with {}", main));
    say(rex + fmt::format("{:20} a question that helps", "hint " + exercise.name.substr(0, 2)));
  }
  say(rex + fmt::format("{:20} grade it", "test " + exercise.name.substr(0, 2)));
  say(rex + fmt::format("{:20} grade it whenever you save", "watch " + exercise.name.substr(0, 2)));
}

}  // namespace

ExitCode progress(const Project& project) {
  const std::vector<ExerciseInfo> exercises = project.exercises();
  if (exercises.empty() && !project.installed.empty()) {
    say(kNoCourseHere);
    return ExitCode::kFull;
  }
  const AllProgress all = ProgressFile(project.root).read();
  std::size_t nameWidth = 0;
  for (const ExerciseInfo& exercise : exercises) nameWidth = std::max(nameWidth, exercise.name.size());
  int solved = 0, points = 0, maxPoints = 0;
  const auto progressOf = [&](const ExerciseInfo& exercise) {
    const auto found = all.exercises.find(exercise.name);
    return found == all.exercises.end() ? Progress{} : found->second;
  };
  for (const ExerciseInfo& exercise : exercises) {
    const Progress progress = progressOf(exercise);
    say(lineOf(exercise, progress, nameWidth));
    solved += progress.solved ? 1 : 0;
    points += progress.points;
    maxPoints += progress.tested ? progress.maxPoints : exercise.points();
  }
  say(fmt::format("{} of {} exercises solved, {} of {} points in the last tests", solved, exercises.size(),
                  points, maxPoints));
  say();
  if (const ExerciseInfo* next = nextOf(exercises, all))
    sayNextStep(*next, progressOf(*next));
  else
    say("All exercises are solved.");
  say("\nAll commands: scripts/rex --help");
  return ExitCode::kFull;
}

}  // namespace rex::cli
