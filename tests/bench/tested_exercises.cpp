#include "bench/tested_exercises.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "base/process.h"
#include "support/paths.h"

namespace rex::bench {

namespace fs = std::filesystem;

std::vector<std::string> TestedExercises::names() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(sourcePath("exercises")))
    if (fs::exists(entry.path() / "solution.cpp")) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

TestedExercises::TestedExercises() {
  fs::create_directory_symlink(sourcePath("exercises"), folder_.path() / "exercises");
  fs::create_directory_symlink(ownFolder(), folder_.path() / "build");
}

double TestedExercises::seconds(const std::string& name, File file) {
  std::vector<std::string> command = {REX_OF_TREE, folder_.path(), "test", name, "-o", folder_.path() / name};
  if (file == File::kSolution)
    command.emplace_back("--solution");
  else
    command.insert(command.end(), {"--main", sourcePath("exercises") / name / "main.cpp"});
  const auto start = std::chrono::steady_clock::now();
  const ProcessResult tested = runProcess(command, {.timeout = 300});
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (tested.exitCode != 0 && tested.exitCode != 1)
    throw std::runtime_error("rex test " + name + ": " + tested.error);
  double& best = fastest_[file].try_emplace(name, taken).first->second;
  best = std::min(best, taken);
  return taken;
}

double TestedExercises::median(File file) {
  std::vector<double> times;
  for (const std::string& name : names()) {
    if (!fastest_[file].contains(name)) static_cast<void>(seconds(name, file));
    times.push_back(fastest_[file].at(name));
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace rex::bench
