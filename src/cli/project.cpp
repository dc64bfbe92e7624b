#include "cli/project.h"

#include "cli/build_on_demand.h"

namespace rex::cli {

namespace fs = std::filesystem;

std::vector<ExerciseInfo> Project::exercises() const {
  return grading::listExercises(shown(root / "exercises"));
}

ExerciseInfo Project::exercise(std::string_view name) const {
  while (name.ends_with('/')) name.remove_suffix(1);
  // Accepts what a shell makes of a completed path.
  if (name.ends_with("/main.cpp")) name.remove_suffix(std::string_view("/main.cpp").size());
  for (const std::string_view folder : {"./", "exercises/"})
    if (name.starts_with(folder)) name.remove_prefix(folder.size());
  return grading::findExercise(exercises(), name);
}

fs::path Project::buildFolder(const ExerciseInfo& exercise) const {
  return build / "exercises" / exercise.name;
}

fs::path Project::outFolder(const ExerciseInfo& exercise, bool solution) const {
  return root / "out" / (exercise.name + (solution ? "-solution" : ""));
}

std::string shown(const fs::path& path) {
  const std::string relative = fs::proximate(path).string();
  return relative.starts_with("..") ? path.string() : relative;
}

grading::Toolchain prepare(const Project& project, const ExerciseInfo& exercise) {
  bringUpToDate(project, {exercise.name + "_ready"}, "the grader of " + exercise.name);
  return grading::readToolchain(project.buildFolder(exercise) / "build.json");
}

}  // namespace rex::cli
