#include "bench/watched_exercise.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "base/text_file.h"
#include "submission/regions.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kName = "01-kinematics";
constexpr const char* kMistake = "palms_in_same_direction";  // which one check catches

// As old as the graders, or older: they are not built anew.
void copyExercise(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const char* file : {"exercise.toml", "exercise.h", "check.cpp"}) {
    fs::copy_file(from / file, to / file);
    fs::last_write_time(to / file, fs::last_write_time(from / file));
  }
}

std::string nearlyRight(const fs::path& exercise) {
  const fs::path solution = exercise / "solution.cpp", wrong = exercise / "wrong.cpp";
  for (const submission::WrongVariant& variant : submission::readVariants(
           rex::readTextFile(solution), solution.string(), rex::readTextFile(wrong), wrong.string()))
    if (variant.name == kMistake) return variant.source;
  throw std::runtime_error(wrong.string() + " has no variant " + kMistake);
}

}  // namespace

WatchedExercise::WatchedExercise()
    : main_(folder_.path() / "exercises" / kName / "main.cpp"),
      results_(folder_.path() / "out" / kName / "results.json"),
      source_(nearlyRight(sourcePath("exercises") / kName)) {
  copyExercise(sourcePath("exercises") / kName, main_.parent_path());
  fs::create_directory_symlink(ownFolder(), folder_.path() / "build");
  save();
  rex_.emplace(std::vector<std::string>{REX_OF_TREE, folder_.path().string(), "watch", kName});
  waitForNewResult();
}

double WatchedExercise::saveToVerdict() {
  // It begins to wait a moment after the last verdict.
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  fs::remove(results_);
  const auto start = Clock::now();
  save();
  waitForNewResult();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double WatchedExercise::testCpuSeconds() const {
  const ProcessResult tested =
      runProcess({REX_OF_TREE, folder_.path().string(), "test", kName}, {.timeout = 300});
  if (tested.exitCode != 1) throw std::runtime_error("rex test: " + tested.error);
  return tested.cpuSeconds;
}

void WatchedExercise::save() {
  rex::replaceTextFile(main_, source_ + "// " + std::to_string(++saves_) + "\n", "the student's file");
}

void WatchedExercise::waitForNewResult() {
  const auto deadline = Clock::now() + std::chrono::seconds(120);
  while (!fs::exists(results_)) {
    if (Clock::now() > deadline) throw std::runtime_error("a save leads to no verdict");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace rex::bench
