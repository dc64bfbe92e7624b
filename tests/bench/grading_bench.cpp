#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/graded_class.h"
#include "bench/row.h"
#include "bench/tested_exercises.h"
#include "bench/watched_exercise.h"
#include "grading/worker_process.h"
#include "interface.h"
#include "sandbox/probes.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::bench {
namespace {

namespace fs = std::filesystem;

// Wall seconds of one call to a real worker: two processes on one core take turns, so that neither's clock
// tells alone. The median of many short rows of calls.
double roundTrip() {
  constexpr int kRows = 200, kCalls = 100;
  using Clock = std::chrono::steady_clock;
  std::vector<double> rows;
  const grading::WorkerRun run = grading::runWithWorker(
      {.worker = buildPath("tests/sample/good")}, "", Student::signature(), [&](remote::Caller& caller) {
        const Student student(caller);
        const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(7, -1, 1);
        const Eigen::Vector3d target(0.1, 0.2, 0.3);
        for (int row = 0; row < kRows; ++row) {
          const auto start = Clock::now();
          for (int k = 0; k < kCalls; ++k)
            if (student.ikStep(q, target) != target)
              throw std::logic_error("the worker answers something else");
          rows.push_back(std::chrono::duration<double>(Clock::now() - start).count() / kCalls);
        }
      });
  if (run.failure) throw std::runtime_error(run.failure->message);
  std::nth_element(rows.begin(), rows.begin() + kRows / 2, rows.end());
  return rows[kRows / 2];
}

// Starting and ending a worker in the best sandbox that holds here.
Measurement sandboxStart() {
  const auto job = std::make_shared<grading::GradingJob>();
  const auto start = timedByWall([job] {
    const grading::WorkerRun run =
        grading::runWithWorker(*job, "", Student::signature(), [](remote::Caller&) {});
    if (run.failure) throw std::runtime_error(run.failure->message);
  });
  return [=] {
    if (job->worker.empty()) {
      const TemporaryFolder folder;
      const fs::path binary = ownFolder();
      sandbox::Sandbox best{.launcher = binary / "rex-sandbox"};
      best.level = sandbox::bestLevel(best.launcher, binary / "rex-sandbox-probe", folder.path()).level;
      *job = {.worker = binary / "tests/sample/good", .sandbox = best};
    }
    return start();
  };
}

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
        "test-" + name, [tested, name] { return tested->seconds(name, File::kSolution); }, kWorst, 3);
  add(
      "test-median", [tested] { return tested->median(File::kSolution); }, kMedian, 1);
  add(
      "untouched-median", [tested] { return tested->median(File::kUntouched); }, kUntouched, 1);
  return rows;
}

}  // namespace

std::vector<Row> gradingRows() {
  constexpr double kLimit = 8e-6, kLoopLimit = 4, kStartLimit = 20e-3;
  // Made by the first measurement.
  const auto loop = [watched = std::make_shared<std::unique_ptr<WatchedExercise>>()]() -> WatchedExercise& {
    if (!*watched) *watched = std::make_unique<WatchedExercise>();
    return **watched;
  };
  std::vector<Row> rows = {{.name = "call-round-trip",
                            .ours = roundTrip,
                            .peerName = "limit",
                            .peer = [] { return kLimit; },
                            .target = 1,
                            .unit = "us"},
                           {.name = "save-to-verdict",  // wall seconds: only a quiet machine tells
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
                           {.name = "sandbox-start",
                            .ours = sandboxStart(),
                            .peerName = "limit",
                            .peer = [] { return kStartLimit; },
                            .target = 1,
                            .unit = "ms"},
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
