#include "bench/graded_class.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/process.h"
#include "base/text_file.h"
#include "submission/regions.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kFiles = 16;
const fs::path kExercise = sourcePath("exercises/01-kinematics");

// The exercise's mistakes in the order of their names.
std::vector<submission::WrongVariant> mistakes(const std::string& solution) {
  const fs::path wrong = kExercise / "wrong.cpp";
  std::vector<submission::WrongVariant> all =
      submission::readVariants(solution, "solution.cpp", rex::readTextFile(wrong), wrong.string());
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return all;
}

}  // namespace

GradedClass::GradedClass() {
  fs::create_directory_symlink(sourcePath("exercises"), folder_.path() / "exercises");
  fs::create_directory_symlink(ownFolder(), folder_.path() / "build");
  const std::string solution = rex::readTextFile(kExercise / "solution.cpp");
  const std::vector<submission::WrongVariant> mistaken = mistakes(solution);
  for (int k = 0; k < kFiles; ++k) {
    const std::string number = std::to_string(k);
    const fs::path folder = folder_.path() / "handed-in" / ("student" + number) / "01-kinematics";
    fs::create_directories(folder);
    const std::string text = k % 2 == 0 ? solution : mistaken.at(static_cast<std::size_t>(k / 2)).source;
    rex::writeTextFile(folder / "main.cpp", text + "// " + number + "\n");
  }
}

double GradedClass::cpuSecondsPerFile() const {
  const fs::path results = folder_.path() / "results";
  fs::remove_all(results);
  const ProcessResult graded =
      runProcess({REX_OF_TREE, folder_.path().string(), "grade", (folder_.path() / "handed-in").string(),
                  "--out", results.string()},
                 {.timeout = 600});
  if (graded.exitCode != 0) throw std::runtime_error("rex grade: " + graded.output + graded.error);
  for (int k = 0; k < kFiles; ++k)
    if (!fs::exists(results / ("student" + std::to_string(k)) / "01-kinematics" / "results.json"))
      throw std::runtime_error("rex grade leaves student" + std::to_string(k) + " without a grade");
  return graded.cpuSeconds / kFiles;
}

}  // namespace rex::bench
