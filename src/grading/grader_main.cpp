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
#include "grading/hostile_answers.h"
#include "grading/result_file.h"
#include "grading/unknown_check.h"

namespace rex::grading {
namespace {

struct Arguments {
  GradeOptions grade{};
  std::filesystem::path results{};
  std::vector<std::string> only{};
  std::filesystem::path secret{};
  std::int64_t hostileAnswers = 0;
  bool lies = false;
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
  app.add_option(
      "--hostile", arguments.hostileAnswers,
      "give each check so many hostile answers of each kind, made of those of the worker, which is "
      "right; prints what came of it");
  app.add_flag(
      "--lies", arguments.lies,
      "print the points for zeros, constants, the last answer and what was asked, in the places of what "
      "the worker answers, which is right");
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

// Exit code 1 where a hostile answer got a point, took too long or ended the process that judged it.
int attack(const Arguments& arguments, const std::vector<RunnableCheck>& checks, const CallLayouts& layouts) {
  std::int64_t answers = 0, runs = 0, unjudged = 0, faults = 0;
  double slowest = 0;
  for (const HostileOutcome& one :
       giveHostileAnswers(checks, arguments.grade, layouts, arguments.hostileAnswers)) {
    answers += one.answers, runs += one.runs, unjudged += one.unjudged;
    slowest = std::max(slowest, one.mostSeconds);
    // Answers to other questions, in another order or number, now and then are right by chance.
    const bool getsPoints = one.runsWithPoints > (keepsNumbers(one.hostility) ? one.runs / 4 : 0);
    const bool isSlow = one.mostSeconds > kJudgingSeconds;
    if (one.unjudged > 0)
      fmt::print("{} by {}: {} of {} runs not judged: {}\n", one.check, toString(one.hostility), one.unjudged,
                 one.runs, one.exception);
    if (one.crash.empty() && !getsPoints && !isSlow) continue;
    ++faults;
    fmt::print("FAULT {} by {}: {} points, at most {:.1f} s, {}\n", one.check, toString(one.hostility),
               one.mostPoints, one.mostSeconds, one.crash.empty() ? "no crash" : one.crash);
  }
  fmt::print("{} answers in {} runs, {} not judged, at most {:.1f} s, {} faults\n", answers, runs, unjudged,
             slowest, faults);
  if (answers == 0) throw std::logic_error("no check asked anything");
  return faults == 0 ? kFullScore : kBelowFullScore;
}

// The points that each check gives for each lie, where it gives some: part, check, lie and points by tabs.
int lie(const Arguments& arguments, const std::vector<RunnableCheck>& checks, const CallLayouts& layouts) {
  const std::vector<LieOutcome> outcomes = tellLies(checks, arguments.grade, layouts);
  if (outcomes.empty()) throw std::logic_error("there are no checks");
  int points = 0;
  for (const LieOutcome& one : outcomes) {
    points += one.points;
    if (one.points > 0) fmt::print("{}\t{}\t{}\t{}\n", one.part, one.check, toString(one.lie), one.points);
  }
  fmt::print("{} checks, {} points for lies\n", checks.size(), points);
  return kFullScore;
}

int complain(const std::string& message, int exitCode) {
  fmt::print(stderr, "grader: {}\n", message);
  return exitCode;
}

}  // namespace

int runGrader(int argc, const char* const* argv, std::vector<RunnableCheck> checks, std::uint64_t signature,
              const CallLayouts& layouts) {
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
    if (arguments.hostileAnswers > 0) return attack(arguments, checks, layouts);
    if (arguments.lies) return lie(arguments, checks, layouts);
    return gradeAndSave(arguments, checks);
  } catch (const std::exception& error) {
    return complain(error.what(), kGraderFault);
  }
}

}  // namespace rex::grading
