#include "grading/release.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "grading/regions.h"
#include "grading/text_file.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;
using fs::path;

// What students get from the root; exercises are treated apart. Everything else stays behind.
constexpr const char* kReleased[] = {
    "CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", ".clang-format", ".editorconfig",
    ".gitignore",     ".gitattributes",    "share",     "src",     "data",          "scripts"};

void copyTree(const path& from, const path& to) {
  if (fs::is_directory(from)) {
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from))
      copyTree(entry.path(), to / entry.path().filename());
  } else if (fs::is_regular_file(from)) {
    fs::copy_file(from, to);
  }
}

// The files of an exercise that differ from what lies in its folder, by name.
std::map<std::string, std::string> madeFiles(const path& exercise) {
  std::map<std::string, std::string> made;
  const path solution = exercise / "solution.cpp", check = exercise / "check.cpp";
  // Twice: the second one is for `rex reset`.
  for (const char* name : {"main.cpp", "starter.cpp"})
    if (fs::exists(solution)) made[name] = stripSolution(readTextFile(solution), solution.string());
  if (fs::exists(check)) made["check.cpp"] = stripHidden(readTextFile(check), check.string());
  return made;
}

void releaseExercise(const path& from, const path& to) {
  fs::create_directories(to);
  const std::map<std::string, std::string> made = madeFiles(from);
  for (const auto& [name, text] : made) writeTextFile(to / name, text);
  for (const auto& entry : fs::directory_iterator(from)) {
    const path name = entry.path().filename();
    if (name != "solution.cpp" && name != "wrong" && !made.contains(name.string()))
      copyTree(entry.path(), to / name);
  }
}

// A text without its white space, and the line each character came from: layout hides no leak.
struct Squeezed {
  explicit Squeezed(const std::string& text) {
    int line = 1;
    for (const char c : text) {
      if (c == '\n') ++line;
      if (std::isspace(static_cast<unsigned char>(c))) continue;
      letters += c;
      lines.push_back(line);
    }
  }
  std::string letters;
  std::vector<int> lines;
};

std::vector<std::string> secretsOf(const path& exercise) {
  const path solution = exercise / "solution.cpp";
  if (!fs::exists(solution)) return {};
  return secretLines(readTextFile(solution), solution.string());
}

void requireAbsent(const std::vector<std::string>& secrets, const std::string& text, const path& file) {
  const Squeezed released(text);
  for (const std::string& secret : secrets) {
    const std::size_t at = released.letters.find(Squeezed(secret).letters);
    if (at == std::string::npos) continue;
    throw Error({.what = "a line of the solution would reach students",
                 .where = {file.string(), released.lines[at]},
                 .found = "'" + secret + "'"});
  }
}

// No file of the release may hold a line of any solution. The library stays aside: it holds the same formulas
// on purpose, where students may read them. What the template of an exercise shows is public too.
void requireCleanRelease(const std::vector<path>& exercises, const path& root, const path& target) {
  std::vector<std::string> secrets;
  for (const path& exercise : exercises)
    for (const std::string& secret : secretsOf(exercise)) secrets.push_back(secret);
  const path shown = root / "share/template/solution.cpp";
  if (fs::exists(shown)) {
    const Squeezed open(readTextFile(shown));
    std::erase_if(secrets, [&](const std::string& secret) {
      return open.letters.find(Squeezed(secret).letters) != std::string::npos;
    });
  }
  for (const auto& entry : fs::recursive_directory_iterator(target)) {
    const path name = entry.path().lexically_relative(target);
    if (!entry.is_regular_file() || *name.begin() == "src") continue;
    requireAbsent(secrets, readTextFile(entry.path()), root / name);
  }
}

// The tests of rex itself stay behind, so the commands for them do too, and the lines that name either.
void leaveOutTheTests(const path& target) {
  constexpr auto kLeftOut = std::to_array<std::string_view>(
      {"scripts/test", "scripts/gallery", "scripts/fuzz", "scripts/check-replay", "scripts/slurm-selftest",
       "scripts/grading", "scripts/grading-campaign", "`tests/`", "tests/gallery"});
  for (const std::string_view name : kLeftOut) fs::remove_all(target / name);
  for (const char* document : {"README.md", "share/doc/architecture.md", "share/doc/gallery.md"}) {
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
  fs::create_directories(target / "exercises");
  // The target may lie inside the root; so nothing but the list is walked.
  for (const char* name : kReleased)
    if (fs::exists(root / name)) copyTree(root / name, target / name);
  leaveOutTheTests(target);
  for (const path& exercise : exercises)
    releaseExercise(exercise, target / "exercises" / exercise.filename());
  for (const auto& entry : fs::directory_iterator(root / "exercises"))
    if (entry.is_regular_file()) fs::copy_file(entry.path(), target / "exercises" / entry.path().filename());
}

}  // namespace

void requireNoSolutionText(const path& exercise) {
  const std::vector<std::string> secrets = secretsOf(exercise);
  std::map<std::string, std::string> released = madeFiles(exercise);
  for (const char* name : {"README.md", "exercise.h", "exercise.toml"})
    if (fs::exists(exercise / name)) released[name] = readTextFile(exercise / name);
  for (const auto& [name, text] : released) requireAbsent(secrets, text, exercise / name);
}

void writeStudentRelease(const path& root, const path& target) {
  if (!isEmptyOrMissing(target))
    throw UsageError(
        {.what = "will not overwrite", .where = {target.string()}, .wanted = "an empty or new folder"});
  std::vector<path> exercises;
  for (const auto& entry : fs::directory_iterator(root / "exercises"))
    if (entry.is_directory()) exercises.push_back(entry.path());
  std::sort(exercises.begin(), exercises.end());
  try {
    writeTree(exercises, root, target);
    requireCleanRelease(exercises, root, target);
  } catch (...) {
    fs::remove_all(target);
    throw;
  }
}

}  // namespace rex::grading
