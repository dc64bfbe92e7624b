#include "grading/grading_job.h"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rex::grading::grading_job_test {

GradingJob parsed(std::vector<std::string> arguments) {
  CLI::App app;
  GradingJob job;
  declareOptions(app, job);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
  app.parse(std::move(arguments));
  return job;
}

// No field may be lost on the way to a grader program: one that toArguments() forgets stays as it is by
// default.
TEST(GradingJob, ComesBackFromArguments) {
  const GradingJob job{.worker = "a worker",
                       .parts = {"a", "b"},
                       .control = "control",
                       .results = "results.json",
                       .checks = {"one", "two"},
                       .pass = Pass::kHidden,
                       .seed = 18446744073709551615u,
                       .limits = {.cpuSeconds = 0.1,
                                  .wallSeconds = 1. / 3,
                                  .memory = 3 * kMegabyte + 1,
                                  .output = 7,
                                  .sanitized = true},
                       .sandbox = {.level = sandbox::Level::kFiles, .launcher = "rex-sandbox"},
                       .libraries = {"a.so", "b.so"},
                       .temporaryFolder = "tmp",
                       .evidence = "checks",
                       .secret = "secret",
                       .mistakes = "known.tsv",
                       .sketches = "seen.tsv",
                       .jobs = 3};
  const GradingJob back = parsed(toArguments(job));
  EXPECT_EQ(back.worker, job.worker);
  EXPECT_EQ(back.parts, job.parts);
  EXPECT_EQ(back.control, job.control);
  EXPECT_EQ(back.results, job.results);
  EXPECT_EQ(back.checks, job.checks);
  EXPECT_EQ(back.pass, job.pass);
  EXPECT_EQ(back.seed, job.seed);
  EXPECT_EQ(back.limits.cpuSeconds, job.limits.cpuSeconds);
  EXPECT_EQ(back.limits.wallSeconds, job.limits.wallSeconds);
  EXPECT_EQ(back.limits.memory, job.limits.memory);
  EXPECT_EQ(back.limits.output, job.limits.output);
  EXPECT_EQ(back.limits.sanitized, job.limits.sanitized);
  EXPECT_EQ(back.sandbox.level, job.sandbox.level);
  EXPECT_EQ(back.sandbox.launcher, job.sandbox.launcher);
  EXPECT_EQ(back.libraries, job.libraries);
  EXPECT_EQ(back.temporaryFolder, job.temporaryFolder);
  EXPECT_EQ(back.evidence, job.evidence);
  EXPECT_EQ(back.secret, job.secret);
  EXPECT_EQ(back.mistakes, job.mistakes);
  EXPECT_EQ(back.sketches, job.sketches);
  EXPECT_EQ(back.jobs, job.jobs);
  EXPECT_EQ(toArguments(back), toArguments(job));
  EXPECT_EQ(toArguments(parsed(toArguments({}))), toArguments({}));
}

TEST(GradingJob, RefusesWhatIsNotALimit) {
  for (const char* option : {"--cpu-seconds", "--memory", "--output", "--jobs"})
    EXPECT_THROW(parsed({option, "0"}), CLI::ParseError) << option;
  EXPECT_THROW(parsed({"--level", "4"}), CLI::ParseError);
  EXPECT_THROW(parsed({"--pass", "3"}), CLI::ParseError);
  EXPECT_THROW(parsed({"--wall-seconds", "-1"}), CLI::ParseError);
}

// Another worker may allow more of the library, so it is never taken in place of a missing one.
TEST(WorkerOf, IsThatOfThePart) {
  const GradingJob job = {.worker = "no/such/worker", .parts = {"own"}};
  EXPECT_EQ(workerProgram("own", job), "no/such/worker.own");
  EXPECT_EQ(workerProgram("other", job), job.worker);
}

}  // namespace rex::grading::grading_job_test
