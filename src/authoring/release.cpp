#include "authoring/release.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "authoring/secrets.h"
#include "base/error.h"
#include "base/folders.h"
#include "base/text_file.h"
#include "submission/regions.h"
#include "submission/student_files.h"
#include "submission/submission.h"

namespace rex::authoring {
namespace {

namespace fs = std::filesystem;
using fs::path;

// What students get from the root; exercises are treated separately. Everything else stays behind.
constexpr const char* kReleased[] = {
    "CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", ".clang-format", ".editorconfig",
    ".gitignore",     ".gitattributes",    ".vscode",   "share",   "src",           "data",
    "scripts"};

/// Copies what students get from the root, as far as git knows it.
class Copier {
 public:
  explicit Copier(const path& root)
      : root_(root), known_(knownFiles(root, [] {
          std::vector<std::string> places(std::begin(kReleased), std::end(kReleased));
          places.emplace_back("exercises");
          return places;
        }())) {}

  void copy(const path& from, const path& to) const {
    if (fs::is_directory(from)) {
      fs::create_directories(to);
      for (const auto& entry : fs::directory_iterator(from)) copy(entry.path(), to / entry.path().filename());
    } else if (fs::is_regular_file(from) && isKnown(from)) {
      fs::copy_file(from, to);
    }
  }

 private:
  // Without a history, everything but the backups of `rex reset`.
  bool isKnown(const path& file) const {
    if (!known_) return !file.filename().string().starts_with("main.backup-");
    return known_->contains(file.lexically_relative(root_).generic_string());
  }

  path root_;
  std::optional<std::set<std::string>> known_;
};

// The released files of an exercise that differ from those in its folder, by name.
std::map<std::string, std::string> madeFiles(const path& exercise) {
  std::map<std::string, std::string> made;
  const path solution = exercise / "solution.cpp", check = exercise / "check.cpp";
  // Twice: the second one is for `rex reset`.
  for (const char* name : {"main.cpp", "starter.cpp"})
    if (fs::exists(solution))
      made[name] = submission::stripSolution(readTextFile(solution), solution.string());
  if (fs::exists(check)) made["check.cpp"] = submission::stripHidden(readTextFile(check), check.string());
  return made;
}

void releaseExercise(const Copier& copier, const path& from, const path& to) {
  fs::create_directories(to);
  const std::map<std::string, std::string> made = madeFiles(from);
  for (const auto& [name, text] : made) writeTextFile(to / name, text);
  for (const auto& entry : fs::directory_iterator(from)) {
    const path name = entry.path().filename();
    if (!submission::isForLecturers(name) && !made.contains(name.string()))
      copier.copy(entry.path(), to / name);
  }
}

// The tests of rex itself and the notes stay behind, and so do the commands for them and the lines that
// mention either.
void leaveOutTheTests(const path& target) {
  constexpr auto kLeftOut = std::to_array<std::string_view>(
      {"scripts/test", "scripts/gallery", "scripts/fuzz", "scripts/check-replay", "scripts/check-site",
       "scripts/check-site.html", "scripts/slurm-selftest", "scripts/grading", "scripts/grading-campaign",
       "scripts/contact-table", "`notes/`", "`tests/`", "tests/gallery", "tests/contact"});
  for (const std::string_view name : kLeftOut) fs::remove_all(target / name);
  for (const char* document :
       {"README.md", "share/doc/architecture.md", "share/doc/benchmarks.md", "share/doc/cluster.md",
        "share/doc/contributing.md", "share/doc/decisions.md", "share/doc/gallery.md"}) {
    if (!fs::exists(target / document)) continue;
    std::istringstream lines(readTextFile(target / document));
    std::string kept;
    for (std::string line; std::getline(lines, line);)
      if (std::none_of(kLeftOut.begin(), kLeftOut.end(),
                       [&](std::string_view name) { return line.find(name) != std::string::npos; }))
        kept += line + '\n';
    writeTextFile(target / document, kept);
  }
}

bool isEmptyOrMissing(const path& folder) {
  return !fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder));
}

void writeTree(const std::vector<path>& exercises, const path& root, const path& target) {
  const Copier copier(root);
  fs::create_directories(target / "exercises");
  // The target may lie inside the root, so only the listed files are walked.
  for (const char* name : kReleased)
    if (fs::exists(root / name)) copier.copy(root / name, target / name);
  leaveOutTheTests(target);
  for (const path& exercise : exercises)
    releaseExercise(copier, exercise, target / "exercises" / exercise.filename());
  for (const auto& entry : fs::directory_iterator(root / "exercises"))
    if (entry.is_regular_file()) copier.copy(entry.path(), target / "exercises" / entry.path().filename());
}

std::vector<path> exercisesOf(const path& root) {
  std::vector<path> exercises;
  for (const auto& entry : fs::directory_iterator(root / "exercises"))
    if (entry.is_directory()) exercises.push_back(entry.path());
  std::sort(exercises.begin(), exercises.end());
  return exercises;
}

Error unwritten(const path& target, const fs::filesystem_error& error) {
  return Error({.what = "cannot write the student release",
                .where = {(error.path1().empty() ? target : error.path1()).string()},
                .found = error.code().message()});
}

}  // namespace

std::vector<Secret> secretsOfCourse(const path& root, const path& courseSecret) {
  std::vector<Secret> secrets = collectSecrets(exercisesOf(root), root);
  if (!courseSecret.empty()) secrets.push_back(courseSecretIn(courseSecret));
  return secrets;
}

void requireNoSolutionText(const path& exercise) {
  std::map<std::string, std::string> released = madeFiles(exercise);
  for (const auto& entry : fs::directory_iterator(exercise)) {
    const path name = entry.path().filename();
    if (name == "README.md" || name == "exercise.toml" || name == "show.cpp" || name.extension() == ".h" ||
        name == submission::knownMistakesFile({}))
      released[name.string()] = readTextFile(entry.path());
  }
  const PrivateFolder folder(fs::temp_directory_path());
  for (const auto& [name, text] : released) writeTextFile(folder.path() / name, text);
  const LeakScan scan = scanForLeaks(folder.path(), collectSecrets({exercise}, exercise));
  if (scan.leaks.empty()) return;
  const Leak& first = scan.leaks.front();
  throw Error({.what = toString(first)});
}

Release writeStudentRelease(const path& root, const path& target, const path& courseSecret,
                            const std::vector<std::string>& only) {
  try {
    if (!isEmptyOrMissing(target))
      throw UsageError(
          {.what = "will not overwrite", .where = {target.string()}, .wanted = "an empty or new folder"});
  } catch (const fs::filesystem_error& error) {
    throw unwritten(target, error);
  }
  try {
    std::vector<path> exercises = exercisesOf(root);
    if (!only.empty())
      std::erase_if(exercises, [&](const path& exercise) {
        return std::find(only.begin(), only.end(), exercise.filename()) == only.end();
      });
    Release release{.exercises = static_cast<int>(exercises.size()),
                    .scan = {},
                    .secrets = secretsOfCourse(root, courseSecret)};
    writeTree(exercises, root, target);
    release.scan = scanForLeaks(target, release.secrets, root / "src");
    if (!release.scan.leaks.empty()) fs::remove_all(target);
    return release;
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove_all(target, ignored);
    throw unwritten(target, error);
  } catch (...) {
    fs::remove_all(target);
    throw;
  }
}

}  // namespace rex::authoring
