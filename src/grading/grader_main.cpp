#include "grading/grader_main.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "grading/hidden_seed.h"
#include "grading/result_file.h"
#include "grading/unknown_check.h"

namespace rex::grading {
namespace {

struct Arguments {
  GradeOptions grade{};
  std::filesystem::path results{};
  std::vector<std::string> only{};
  std::filesystem::path secret{};
  bool list = false;
};

void declareOptions(CLI::App& app, Arguments& arguments) {
  WorkerLimits& limits = arguments.grade.limits;
  app.add_option("--worker", arguments.grade.worker,
                 "the student's worker program; none: all checks are not run");
  app.add_option("--results", arguments.results, "result file; its fields about the submission are kept");
  app.add_option("--check", arguments.only, "run only this check (repeatable)");
  app.add_option("--seed", arguments.grade.seed, "seed of all random numbers");
  app.add_option("--cpu-seconds", limits.cpuSeconds, "CPU time of one check")->check(CLI::PositiveNumber);
  app.add_option("--memory-mb", limits.memoryMegabytes, "memory of one check")->check(CLI::PositiveNumber);
  app.add_flag("--sanitized", limits.sanitized, "the worker limits its memory itself");
  app.add_option("--output-mb", limits.outputMegabytes, "printed by one check")->check(CLI::PositiveNumber);
  app.add_option("--temporary", arguments.grade.temporaryFolder, "where workers get their working folders");
  app.add_option("--level", arguments.grade.sandbox.level, "sandbox level of workers")
      ->check(CLI::Range(0, 3));
  app.add_option("--sandbox", arguments.grade.sandbox.launcher,
                 "the program rex-sandbox, for levels above 0");
  app.add_option("--library", arguments.grade.libraries, "a library that the worker loads (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--evidence", arguments.grade.evidence,
                 "folder for pictures and replays of visible checks that do not hold");
  app.add_option("--secret", arguments.secret,
                 "file with the secret of the course, for the seeds of hidden checks");
  app.add_option("--jobs", arguments.grade.jobs, "checks at once")->check(CLI::Range(1, 1024));
  app.add_flag("--list", arguments.list, "print the checks as JSON");
}

std::vector<RunnableCheck> select(const std::vector<RunnableCheck>& checks,
                                  const std::vector<std::string>& only) {
  std::vector<std::string> ids;
  for (const RunnableCheck& check : checks) ids.push_back(check.info.id);
  for (const std::string& id : only) {
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) throw unknownCheck(id, ids);
  }
  std::vector<RunnableCheck> selected;
  for (const RunnableCheck& check : checks) {
    if (only.empty() || std::find(only.begin(), only.end(), check.info.id) != only.end())
      selected.push_back(check);
  }
  return selected;
}

void requireUniqueIds(const std::vector<RunnableCheck>& checks) {
  std::set<std::string> seen;
  for (const RunnableCheck& check : checks) {
    if (!seen.insert(check.info.id).second)
      throw std::logic_error("two checks have the id '" + check.info.id + "'");
  }
}

void printList(const std::vector<RunnableCheck>& checks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [info, run] : checks)
    list.push_back({{"id", info.id},
                    {"part", info.part},
                    {"title", info.title},
                    {"points", info.points},
                    {"group", info.group == Group::visible ? "visible" : "hidden"}});
  fmt::print("{}\n", list.dump(2));
}

int gradeAndSave(const Arguments& arguments, const std::vector<RunnableCheck>& checks) {
  GradeOptions options = arguments.grade;
  if (!arguments.secret.empty()) options.secret = readCourseSecret(arguments.secret);
  const bool prepared = !arguments.results.empty() && std::filesystem::exists(arguments.results);
  const GradeResult start = prepared ? loadResult(arguments.results) : GradeResult{};
  const GradeResult result = grade(start, checks, options, [&](const GradeResult& soFar) {
    if (!arguments.results.empty()) saveResult(soFar, arguments.results);
  });
  if (result.outcome == Outcome::graderError) return kGraderFault;
  return result.outcome == Outcome::pass ? kFullScore : kBelowFullScore;
}

int complain(const std::string& message, int exitCode) {
  fmt::print(stderr, "grader: {}\n", message);
  return exitCode;
}

}  // namespace

int runGrader(int argc, const char* const* argv, std::vector<RunnableCheck> checks, std::uint64_t signature) {
  CLI::App app("Grades one submission of an exercise.", "grader");
  Arguments arguments;
  arguments.grade.signature = signature;
  declareOptions(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return kFullScore;
  } catch (const CLI::ParseError& error) {
    return complain(error.what(), kUsage);
  }
  try {
    requireUniqueIds(checks);
    if (arguments.list) {
      printList(checks);
      return kFullScore;
    }
    checks = select(checks, arguments.only);
  } catch (const Error& error) {
    return complain(error.what(), kUsage);
  } catch (const std::exception& error) {
    return complain(error.what(), kGraderFault);
  }
  try {
    return gradeAndSave(arguments, checks);
  } catch (const std::exception& error) {
    return complain(error.what(), kGraderFault);
  }
}

}  // namespace rex::grading
