#include "grading/release.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "grading/regions.h"
#include "grading/text_file_internal.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;
using fs::path;
using internal::readTextFile;
using internal::writeTextFile;

// What students get from the root; exercises are treated apart. Everything else stays behind.
constexpr const char* kReleased[] = {
    "CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", ".clang-format", ".editorconfig",
    ".gitignore",     ".gitattributes",    ".vscode",   "share",   "src",           "data",
    "scripts"};

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
  if (fs::exists(solution)) made["main.cpp"] = stripSolution(readTextFile(solution), solution.string());
  if (fs::exists(check)) made["check.cpp"] = stripHidden(readTextFile(check), check.string());
  return made;
}

void releaseExercise(const path& from, const path& to) {
  requireNoSolutionText(from);
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

// The tests of rex itself stay behind, so the command for them does too, and the lines that name it.
void leaveOutTheTests(const path& target) {
  fs::remove(target / "scripts/test");
  if (!fs::exists(target / "README.md")) return;
  std::istringstream lines(readTextFile(target / "README.md"));
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (line.find("scripts/test") == std::string::npos) kept += line + '\n';
  writeTextFile(target / "README.md", kept);
}

bool isEmptyOrMissing(const path& folder) {
  return !fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder));
}

}  // namespace

void requireNoSolutionText(const path& exercise) {
  const path solution = exercise / "solution.cpp", readme = exercise / "README.md";
  if (!fs::exists(solution)) return;
  const std::vector<std::string> secrets = secretLines(readTextFile(solution), solution.string());
  std::map<std::string, std::string> released = madeFiles(exercise);
  if (fs::exists(readme)) released["README.md"] = readTextFile(readme);
  for (const auto& [name, text] : released) requireAbsent(secrets, text, exercise / name);
}

void writeStudentRelease(const path& root, const path& target) {
  if (!isEmptyOrMissing(target))
    throw Error(
        {.what = "will not overwrite", .where = {target.string()}, .wanted = "an empty or new folder"});
  std::vector<path> exercises;
  for (const auto& entry : fs::directory_iterator(root / "exercises"))
    if (entry.is_directory()) exercises.push_back(entry.path());
  std::sort(exercises.begin(), exercises.end());
  for (const path& exercise : exercises) requireNoSolutionText(exercise);

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

}  // namespace rex::grading
