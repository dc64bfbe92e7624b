#include "cli/project.h"

#include <cstdlib>

#include "base/error.h"
#include "base/folders.h"
#include "base/sha256.h"
#include "base/text.h"
#include "cli/build_on_demand.h"
#include "cli/out_folder.h"

namespace rex::cli {

namespace fs = std::filesystem;

namespace {

fs::path courseAround(const fs::path& folder) {
  std::error_code unreadable;
  for (fs::path place = folder;; place = place.parent_path()) {
    if (fs::exists(place / kCourseFile, unreadable)) return place;
    if (place == place.parent_path()) return folder;
  }
}

}  // namespace

Project findProject() {
  if (!isInstalled()) return {.root = homeFolder(), .build = ownFolder()};
  return {.root = courseAround(fs::current_path()), .build = ownFolder(), .installed = homeFolder()};
}

Project findProjectOfInstructor() {
  Project project = findProject();
  if (!project.installed.empty() && !fs::exists(project.root / kCourseFile)) project.root = project.installed;
  return project;
}

std::vector<std::string> Project::exerciseNames() const {
  std::vector<std::string> names = submission::exerciseNames(files() / "exercises");
  if (!installed.empty())
    std::erase_if(names, [&](const std::string& one) { return !fs::is_directory(root / "exercises" / one); });
  return names;
}

ExerciseInfo Project::read(const std::string& name) const {
  ExerciseInfo exercise = submission::readExerciseInfo(shown(files() / "exercises" / name));
  exercise.folder = shown(root / "exercises" / name);
  return exercise;
}

std::vector<ExerciseInfo> Project::exercises() const {
  std::vector<ExerciseInfo> all;
  for (const std::string& name : exerciseNames()) all.push_back(read(name));
  return all;
}

std::string Project::exerciseName(std::string_view name) const {
  while (name.ends_with('/')) name.remove_suffix(1);
  // Accepts what a shell makes of a completed path.
  if (name.ends_with("/main.cpp")) name.remove_suffix(std::string_view("/main.cpp").size());
  for (const std::string_view folder : {"./", "exercises/"})
    if (name.starts_with(folder)) name.remove_prefix(folder.size());
  std::vector<ExerciseInfo> known;
  std::vector<std::string> fitting;
  for (std::string& one : exerciseNames()) {
    if (lowerCase(one).find(lowerCase(name)) != one.npos) fitting.push_back(one);
    known.emplace_back().name = std::move(one);
  }
  if (known.empty() && !installed.empty())
    throw UsageError({.what = "there are no exercises here",
                      .where = {root.string()},
                      .wanted = "a course folder; `rex init course` makes one"});
  // Shorter parts would be numbers of other exercises.
  constexpr std::size_t kShortestPart = 3;
  if (fitting.size() == 1 && name.size() >= kShortestPart) return fitting.front();
  return submission::findExercise(known, name).name;
}

ExerciseInfo Project::exercise(std::string_view name) const { return read(exerciseName(name)); }

fs::path Project::buildFolder(const ExerciseInfo& exercise) const {
  return build / "exercises" / exercise.name;
}

bool Project::isBuilt(const std::string& exercise) const {
  return installed.empty() || fs::exists(build / "exercises" / exercise / "build.json");
}

fs::path Project::workPlace(const std::string& name) const {
  if (!installed.empty()) return temporaryFolder();
  const fs::path folder = build / name;
  fs::create_directories(folder);
  return folder;
}

fs::path Project::outFolder(const ExerciseInfo& exercise, bool solution) const {
  return root / "out" / (exercise.name + (solution ? "-solution" : ""));
}

std::string shown(const fs::path& path) {
  const std::string relative = fs::proximate(path).string();
  return relative.starts_with("..") ? path.lexically_normal().string() : relative;
}

fs::path prefixFile(const Project& project) {
  if (project.installed.empty()) return {};
  const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
  fs::path folder = cache != nullptr ? fs::path(cache) : fs::path(home == nullptr ? "" : home) / ".cache";
  if (!folder.is_absolute()) folder = project.root / ".rex";
  constexpr std::size_t kDigits = 12;
  return folder / "rex" / sha256(REX_VERSION + project.installed.string()).substr(0, kDigits) / "prefix.h";
}

submission::Toolchain prepare(const Project& project, const ExerciseInfo& exercise) {
  bringUpToDate(project, {exercise.name + "_ready"}, "the grader of " + exercise.name);
  submission::Toolchain toolchain = submission::readToolchain(project.buildFolder(exercise) / "build.json");
  if (!project.installed.empty()) toolchain.prefix = prefixFile(project);
  return toolchain;
}

}  // namespace rex::cli
