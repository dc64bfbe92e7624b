#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/graded_class.h"
#include "bench/row.h"
#include "bench/tested_exercises.h"
#include "bench/watched_exercise.h"

namespace rex::bench {
namespace {

// `rex test` of each reference solution, against the most that one may take; then the medians of all
// exercises.
std::vector<Row> testRows() {
  using File = TestedExercises::File;
  constexpr double kWorst = 4, kMedian = 3, kUntouched = 2;
  const auto tested = std::make_shared<TestedExercises>();
  std::vector<Row> rows;
  const auto add = [&](const std::string& name, Measurement ours, double limit, int repetitions) {
    rows.push_back({.name = name,
                    .ours = std::move(ours),
                    .peerName = "limit",
                    .peer = [limit] { return limit; },
                    .target = 1,
                    .unit = "s",
                    .repetitions = repetitions});
  };
  for (const std::string& name : TestedExercises::names())
    add(
        "test-" + name, [tested, name] { return tested->seconds(name, File::kSolution); }, kWorst, 1);
  add(
      "test-median", [tested] { return tested->median(File::kSolution); }, kMedian, 1);
  add(
      "untouched-median", [tested] { return tested->median(File::kUntouched); }, kUntouched, 1);
  return rows;
}

}  // namespace

std::vector<Row> gradingRows() {
  constexpr double kLoopLimit = 4;
  // Made by the first measurement.
  const auto loop = [watched = std::make_shared<std::unique_ptr<WatchedExercise>>()]() -> WatchedExercise& {
    if (!*watched) *watched = std::make_unique<WatchedExercise>();
    return **watched;
  };
  std::vector<Row> rows = {{.name = "save-to-verdict",  // wall seconds: only a quiet machine tells
                            .ours = [loop] { return loop().saveToVerdict(); },
                            .peerName = "limit",
                            .peer = [] { return kLoopLimit; },
                            .target = 1,
                            .unit = "s",
                            .repetitions = 7,
                            .isMedian = true},
                           {.name = "test-one-exercise",
                            .ours = [loop] { return loop().testCpuSeconds(); },
                            .peerName = "limit",
                            .peer = [] { return kLoopLimit; },
                            .target = 1,
                            .unit = "s",
                            .repetitions = 5},
                           {.name = "grade-class",  // processor seconds of each file
                            .ours =
                                [made = std::make_shared<std::unique_ptr<GradedClass>>()] {
                                  if (!*made) *made = std::make_unique<GradedClass>();
                                  return (*made)->cpuSecondsPerFile();
                                },
                            .peerName = "limit",
                            .peer = [] { return kLoopLimit; },
                            .target = 1,
                            .unit = "s",
                            .repetitions = 3}};
  for (Row& row : testRows()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace rex::bench
