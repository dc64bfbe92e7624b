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
#include "base/exit_code.h"
#include "grading/failing_call.h"
#include "grading/grown_answers.h"
#include "grading/hostile_answers.h"
#include "grading/results.h"
#include "grading/unknown_check.h"

namespace rex::grading {
namespace {

struct Arguments {
  GradingJob job{};
  std::uint64_t signature = 0;
  std::int64_t hostileAnswers = 0;
  bool lies = false;
  bool grown = false;
  std::filesystem::path failingCall{};
  bool list = false;
};

void declareOptions(CLI::App& app, Arguments& arguments) {
  declareOptions(app, arguments.job);
  app.add_option(
      "--hostile", arguments.hostileAnswers,
      "give each check this many hostile answers of each kind, made from the answers of a worker that "
      "is right, and print the outcomes");
  app.add_flag(
      "--lies", arguments.lies,
      "print the points that a check gives if zeros, constants, the last answer, the question itself or what "
      "follows from the first answer replace the answers of a worker that is right");
  app.add_flag("--grown", arguments.grown,
               "make the answers of a worker that is right huge, tiny or longer, and print what that gains");
  app.add_option("--failing-call", arguments.failingCall,
                 "write the call with which the only check fails, for a worker in a debugger, and print the "
                 "name of the function");
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
                    {"group", info.group == Group::kVisible ? "visible" : "hidden"}});
  fmt::print("{}\n", list.dump(2));
}

ExitCode gradeAndSave(const Arguments& arguments, const std::vector<RunnableCheck>& checks,
                      const CallLayouts& layouts) {
  const std::filesystem::path& results = arguments.job.results;
  const bool prepared = !results.empty() && std::filesystem::exists(results);
  const GradeResult start = prepared ? loadResult(results) : GradeResult{};
  const auto save = [&](const GradeResult& soFar) {
    if (!results.empty()) saveResult(soFar, results);
  };
  const GradeResult result = grade(start, checks, arguments.job, arguments.signature, save, layouts);
  if (result.outcome == Outcome::kGraderError) return ExitCode::kGraderFault;
  return result.outcome == Outcome::kPass ? ExitCode::kFull : ExitCode::kBelow;
}

// Returns kBelow if a hostile answer got a point, took too long or ended the process that judged it.
ExitCode attack(const Arguments& arguments, const std::vector<RunnableCheck>& checks,
                const CallLayouts& layouts) {
  std::int64_t answers = 0, runs = 0, unjudged = 0, faults = 0;
  double slowest = 0;
  for (const HostileOutcome& one :
       giveHostileAnswers(checks, arguments.job, arguments.signature, layouts, arguments.hostileAnswers)) {
    answers += one.answers, runs += one.runs, unjudged += one.unjudged;
    slowest = std::max(slowest, one.mostSeconds);
    // Answers to other questions, or in another order or number, are sometimes right by chance.
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
  return faults == 0 ? ExitCode::kFull : ExitCode::kBelow;
}

// Prints the lies for which a check gives points: part, check, lie and points, separated by tabs.
ExitCode lie(const Arguments& arguments, const std::vector<RunnableCheck>& checks,
             const CallLayouts& layouts) {
  const std::vector<FalseAnswerOutcome> outcomes =
      runAdversarially(checks, arguments.job, arguments.signature, layouts);
  if (outcomes.empty()) throw std::logic_error("there are no checks");
  int points = 0;
  for (const FalseAnswerOutcome& one : outcomes) {
    points += one.points;
    if (one.points > 0) fmt::print("{}\t{}\t{}\t{}\n", one.part, one.check, toString(one.lie), one.points);
  }
  fmt::print("{} checks, {} points for lies\n", checks.size(), points);
  return ExitCode::kFull;
}

// Returns kBelow if size gained something.
ExitCode growAnswers(const Arguments& arguments, const std::vector<RunnableCheck>& checks,
                     const CallLayouts& layouts) {
  int changed = 0, faults = 0;
  double slowest = 0;
  for (const GrownOutcome& one : giveGrownAnswers(checks, arguments.job, arguments.signature, layouts)) {
    changed += one.changed ? 1 : 0;
    slowest = std::max(slowest, one.seconds);
    const bool gains = one.points > one.plainPoints, isSlow = one.seconds > kJudgingSeconds;
    if (one.grew.empty() && !gains && !isSlow) continue;
    ++faults;
    fmt::print("FAULT {} by {} of {}: ", one.check, toString(one.growth), one.function);
    if (!one.grew.empty()) fmt::print("it grew {}; ", one.grew);
    fmt::print("{} points, {} if only wrong, {:.1f} s\n", one.points, one.plainPoints, one.seconds);
  }
  fmt::print("{} changes, at most {:.1f} s, {} faults\n", changed, slowest, faults);
  if (changed == 0) throw std::logic_error("no answer has a number");
  return faults == 0 ? ExitCode::kFull : ExitCode::kBelow;
}

// Returns kFull, and writes nothing, if the check passes.
ExitCode findFailingCall(const Arguments& arguments, const std::vector<RunnableCheck>& checks) {
  if (checks.size() != 1) throw std::logic_error("a failing call is that of one check");
  const std::string function =
      writeFailingCall(checks.front(), arguments.job, arguments.signature, arguments.failingCall);
  if (function.empty()) return ExitCode::kFull;
  fmt::print("{}\n", function);
  return ExitCode::kBelow;
}

ExitCode complain(const std::string& message, ExitCode code) {
  fmt::print(stderr, "grader: {}\n", message);
  return code;
}

ExitCode run(int argc, const char* const* argv, std::vector<RunnableCheck> checks, std::uint64_t signature,
             const CallLayouts& layouts) {
  CLI::App app("Grades one submission of an exercise.", "grader");
  Arguments arguments;
  arguments.signature = signature;
  declareOptions(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return ExitCode::kFull;
  } catch (const CLI::ParseError& error) {
    return complain(error.what(), ExitCode::kUsage);
  }
  try {
    requireUniqueIds(checks);
    if (arguments.list) {
      printList(checks);
      return ExitCode::kFull;
    }
    checks = select(checks, arguments.job.checks);
  } catch (const Error& error) {
    return complain(error.what(), ExitCode::kUsage);
  } catch (const std::exception& error) {
    return complain(error.what(), ExitCode::kGraderFault);
  }
  try {
    if (arguments.hostileAnswers > 0) return attack(arguments, checks, layouts);
    if (arguments.grown) return growAnswers(arguments, checks, layouts);
    if (arguments.lies) return lie(arguments, checks, layouts);
    if (!arguments.failingCall.empty()) return findFailingCall(arguments, checks);
    return gradeAndSave(arguments, checks, layouts);
  } catch (const std::exception& error) {
    return complain(error.what(), ExitCode::kGraderFault);
  }
}

}  // namespace

int runGrader(int argc, const char* const* argv, std::vector<RunnableCheck> checks, std::uint64_t signature,
              const CallLayouts& layouts) {
  return numberOf(run(argc, argv, std::move(checks), signature, layouts));
}

}  // namespace rex::grading
