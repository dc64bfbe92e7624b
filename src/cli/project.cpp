#include "cli/project.h"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "base/process.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// Whether the grader is missing or older than what it is made of.
bool isStale(const fs::path& product, const fs::path& folder) {
  std::error_code missing;
  const auto built = fs::last_write_time(product, missing);
  if (missing) return true;
  for (const char* source : {"check.cpp", "exercise.h"}) {
    const auto edited = fs::last_write_time(folder / source, missing);
    if (!missing && edited > built) return true;
  }
  return false;
}

std::string lastLines(const std::string& text, std::size_t size) {
  if (text.size() <= size) return text;
  return text.substr(text.find('\n', text.size() - size) + 1);
}

void buildGrader(const Project& project, const ExerciseInfo& exercise) {
  note(fmt::format("building the grader of {} ...", exercise.name));
  const ProcessResult built =
      runProcess({"cmake", "--build", project.build.string(), "--target", exercise.name + "_grader",
                  exercise.name + "_worker", "rex_student"},
                 {.timeout = 3600});
  if (built.ok()) return;
  throw std::runtime_error(fmt::format("the grader of {} does not build:\n{}{}", exercise.name,
                                       lastLines(built.output, 4000), lastLines(built.error, 2000)));
}

}  // namespace

std::vector<ExerciseInfo> Project::exercises() const {
  return grading::listExercises(shown(root / "exercises"));
}

ExerciseInfo Project::exercise(std::string_view name) const {
  while (name.ends_with('/')) name.remove_suffix(1);
  // What completing a path in a shell gives.
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
  const fs::path description = project.buildFolder(exercise) / "build.json";
  if (!fs::exists(description) || isStale(project.buildFolder(exercise) / "grader", exercise.folder))
    buildGrader(project, exercise);
  return grading::readToolchain(description);
}

}  // namespace rex::cli
