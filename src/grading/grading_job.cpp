#include "grading/grading_job.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace rex::grading {

void declareOptions(CLI::App& app, GradingJob& job) {
  app.add_option("--worker", job.worker, "the student's worker program; without it no check is run");
  app.add_option("--part", job.parts,
                 "a part of the exercise with a worker of its own, WORKER.PART (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--control", job.control, "a worker without a student's code, to measure the machine by");
  app.add_option("--results", job.results, "result file; its fields about the submission are kept");
  app.add_option("--check", job.checks, "run only this check (repeatable)")->allow_extra_args(false);
  app.add_option("--pass", job.pass, "1: leave hidden checks out, 2: run them and keep the other results")
      ->check(CLI::Range(0, 2));
  app.add_option("--seed", job.seed, "seed of all random numbers");
  app.add_option("--cpu-seconds", job.limits.cpuSeconds, "CPU time of one check")->check(CLI::PositiveNumber);
  app.add_option("--wall-seconds", job.limits.wallSeconds, "seconds to wait for one check; 0: 2 x CPU + 2")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--memory", job.limits.memory, "bytes of memory of one check")->check(CLI::PositiveNumber);
  app.add_option("--output", job.limits.output, "bytes printed by one check")->check(CLI::PositiveNumber);
  app.add_flag("--sanitized", job.limits.sanitized, "the worker limits its memory itself");
  app.add_option("--level", job.sandbox.level, "sandbox level of workers")->check(CLI::Range(0, 3));
  app.add_option("--sandbox", job.sandbox.launcher, "the program rex-sandbox, for levels above 0");
  app.add_option("--library", job.libraries, "a library that the worker loads (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--temporary", job.temporaryFolder, "where workers get their working folders");
  app.add_option("--evidence", job.evidence,
                 "folder for pictures and replays of visible checks that do not hold");
  app.add_option("--secret", job.secret,
                 "file with the secret of the course, for the seeds of hidden checks");
  app.add_option("--mistakes", job.mistakes, "file with the known mistakes, which visible checks ask about");
  app.add_option("--sketches", job.sketches, "where to write sketches of the answers in visible checks");
  app.add_option("--jobs", job.jobs, "checks to run at once")->check(CLI::Range(1, 1024));
}

std::vector<std::string> toArguments(const GradingJob& job) {
  std::vector<std::string> arguments;
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {option, value});
  };
  add("--worker", job.worker.string());
  for (const std::string& part : job.parts) add("--part", part);
  add("--control", job.control.string());
  add("--results", job.results.string());
  for (const std::string& check : job.checks) add("--check", check);
  add("--pass", fmt::format("{}", static_cast<int>(job.pass)));
  add("--seed", fmt::format("{}", job.seed));
  add("--cpu-seconds", fmt::format("{}", job.limits.cpuSeconds));
  add("--wall-seconds", fmt::format("{}", job.limits.wallSeconds));
  add("--memory", fmt::format("{}", job.limits.memory));
  add("--output", fmt::format("{}", job.limits.output));
  if (job.limits.sanitized) arguments.emplace_back("--sanitized");
  add("--level", fmt::format("{}", numberOf(job.sandbox.level)));
  add("--sandbox", job.sandbox.launcher.string());
  for (const std::filesystem::path& library : job.libraries) add("--library", library.string());
  add("--temporary", job.temporaryFolder.string());
  add("--evidence", job.evidence.string());
  add("--secret", job.secret.string());
  add("--mistakes", job.mistakes.string());
  add("--sketches", job.sketches.string());
  add("--jobs", fmt::format("{}", job.jobs));
  return arguments;
}

std::filesystem::path workerProgram(const std::string& part, const GradingJob& job) {
  const bool isOwn = std::find(job.parts.begin(), job.parts.end(), part) != job.parts.end();
  return isOwn ? std::filesystem::path(job.worker.string() + "." + part) : job.worker;
}

}  // namespace rex::grading
