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

// A mistake of wrong/, the k-th in the order of their names.
std::string mistaken(const std::string& solution, int k) {
  std::vector<fs::path> wrong;
  for (const fs::directory_entry& entry : fs::directory_iterator(kExercise / "wrong"))
    if (entry.path().extension() == ".cpp") wrong.push_back(entry.path());
  std::sort(wrong.begin(), wrong.end());
  const fs::path file = wrong.at(static_cast<std::size_t>(k));
  return grading::composeVariant(solution, "solution.cpp", rex::readTextFile(file), file.string()).source;
}

}  // namespace

GradedClass::GradedClass() {
  fs::create_directory_symlink(sourcePath("exercises"), folder_.path() / "exercises");
  fs::create_directory_symlink(ownFolder(), folder_.path() / "build");
  const std::string solution = rex::readTextFile(kExercise / "solution.cpp");
  for (int k = 0; k < kFiles; ++k) {
    const std::string number = std::to_string(k);
    const fs::path folder = folder_.path() / "handed-in" / ("student" + number) / "01-kinematics";
    fs::create_directories(folder);
    const std::string text = k % 2 == 0 ? solution : mistaken(solution, k / 2);
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
