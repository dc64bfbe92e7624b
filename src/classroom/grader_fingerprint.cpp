#include "classroom/grader_fingerprint.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/join.h"
#include "base/sha256.h"
#include "base/text_file.h"
#include "submission/submission.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

// All files below the folder, in the same order on every machine.
std::vector<fs::path> filesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code missing;  // missing folders are skipped, as the compiler does
  for (const auto& entry : fs::recursive_directory_iterator(folder, missing))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// Functions in headers are compiled into the student's program, so no library reveals their changes. The
// folder of the exercise itself holds what students and instructors write; its version covers that.
std::string headersOf(const std::vector<std::string>& flags) {
  std::string text;
  for (std::size_t i = 0; i + 1 < flags.size(); ++i)
    if (flags[i] == "-isystem")
      for (const fs::path& file : filesBelow(flags[i + 1]))
        if (file.extension() == ".h") text += fmt::format("{}\n{}\n", file.string(), readTextFile(file));
  return text;
}

// The program cannot change while it runs, even if a new one takes its name.
const std::string& hashOfRunningProgram() {
  static const std::string hash = sha256(readTextFile("/proc/self/exe"));
  return hash;
}

}  // namespace

std::string graderFingerprint(const Toolchain& toolchain, const ExerciseInfo& exercise,
                              const fs::path& launcher) {
  std::string text = fmt::format(
      "{}\n{}\n{}\n{}\n{}\n{}\n", REX_VERSION, exerciseVersion(exercise.definition), toolchain.compiler,
      join(toolchain.flags, "\n"), join(toolchain.linkFlags, "\n"), sha256(headersOf(toolchain.flags)));
  std::vector<fs::path> files = toolchain.libraries;
  files.insert(files.end(), {toolchain.grader, toolchain.workerObject});
  for (const fs::path& file : files) text += sha256(readTextFile(file)) + "\n";
  text += hashOfRunningProgram() + "\n";
  if (fs::exists(launcher)) text += sha256(readTextFile(launcher)) + "\n";
  return sha256(text);
}

}  // namespace rex::grading
