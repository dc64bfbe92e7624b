#include "bench/panda_problems.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <time.h>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "planning/sphere_planner.h"
#include "support/sphere_problems.h"

namespace rex::bench {
namespace {

using Json = nlohmann::ordered_json;

double threadMicroseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

struct Outcome {
  std::string fault{};  ///< why it is not solved; empty: it is, and both paths are verified
  bool isFound = false, isVerified = false;
  double planning = 0, shortening = 0;  ///< microseconds
  double planned = 0, shortened = 0;    ///< lengths
};

// Times of problems that take long need no repetition.
constexpr double kLong = 2e4;

Outcome solve(const SphereRobot& robot, const SceneSpec& spec, const SphereProblem& problem,
              const PandaOptions& options) {
  const ExactJudge judge(spec, problem.obstacles);
  Outcome outcome;
  for (const bool isStart : {true, false}) {
    outcome.fault = judge.faultOf(isStart ? problem.start : problem.goal);
    if (!outcome.fault.empty()) {
      outcome.fault = fmt::format("{} is not free: {}", isStart ? "start" : "goal", outcome.fault);
      return outcome;
    }
  }
  PathResult plan;
  Eigen::MatrixXd shortened;
  outcome.planning = outcome.shortening = 1e300;
  for (int i = 0; i < options.repetitions && (i == 0 || outcome.planning < kLong); ++i) {
    const double begin = threadMicroseconds();
    const SphereWorld world(robot, problem.obstacles);
    plan = planSpheres(world, problem.start, problem.goal, {.firstPoint = options.seed});
    const double planned = threadMicroseconds();
    outcome.planning = std::min(outcome.planning, planned - begin);
    if (plan.status != PathStatus::kFound) break;
    shortened = shortenPath(world, plan.path);
    outcome.shortening = std::min(outcome.shortening, threadMicroseconds() - planned);
  }
  outcome.isFound = plan.status == PathStatus::kFound;
  outcome.fault = plan.message;
  if (!outcome.isFound) return outcome;
  const Space space = Space::box(robot.lowerLimits(), robot.upperLimits());
  outcome.planned = plan.length;
  outcome.shortened = pathLength(space, shortened);
  outcome.fault = judge.faultOf(plan.path, problem.start, problem.goal);
  if (outcome.fault.empty()) outcome.fault = judge.faultOf(shortened, problem.start, problem.goal);
  outcome.isVerified = outcome.fault.empty();
  return outcome;
}

// An Error of the planner, such as a start that only single precision takes for overlap, is an outcome, too.
Outcome outcomeOf(const SphereRobot& robot, const SceneSpec& spec, const SphereProblem& problem,
                  const PandaOptions& options) {
  try {
    return solve(robot, spec, problem, options);
  } catch (const Error& error) {
    return {.fault = error.what()};
  }
}

double mean(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number;
  return numbers.empty() ? 0 : sum / static_cast<double>(numbers.size());
}

// The smallest number that a share of all does not exceed; the median of an even count is the mean of both.
double quantile(std::vector<double> numbers, double share) {
  if (numbers.empty()) return 0;
  std::sort(numbers.begin(), numbers.end());
  const auto at = [&](double place) {
    return numbers[static_cast<std::size_t>(std::clamp(place, 0., static_cast<double>(numbers.size() - 1)))];
  };
  const double count = static_cast<double>(numbers.size());
  if (share == 0.5) return (at(std::floor((count - 1) / 2)) + at(std::ceil((count - 1) / 2))) / 2;
  return at(std::ceil(share * count) - 1);
}

struct Summary {
  std::string set;
  int problems = 0, solved = 0, found = 0, verified = 0;
  std::vector<double> planning{}, shortening{}, planned{}, shortened{};  ///< of the solved ones

  void add(const Outcome& outcome) {
    ++problems;
    found += outcome.isFound;
    verified += outcome.isVerified;
    if (!outcome.isVerified) return;
    ++solved;
    planning.push_back(outcome.planning);
    shortening.push_back(outcome.shortening);
    planned.push_back(outcome.planned);
    shortened.push_back(outcome.shortened);
  }
};

constexpr const char* kHead =
    "{:<24} {:>8} {:>7} {:>6} {:>9}  {:>8} {:>8} {:>8}  {:>8} {:>8} {:>8}  {:>7} {:>9}\n";

std::string tableHead() {
  return fmt::format("times in us; lengths in rad, means; found paths are judged by exact distances\n") +
         fmt::format(kHead, "set", "problems", "solved", "found", "verified", "median", "mean", "p95",
                     "shorten", "mean", "p95", "planned", "shortened");
}

std::string line(const Summary& summary) {
  const auto time = [](double microseconds) { return fmt::format("{:.1f}", microseconds); };
  const auto length = [](const std::vector<double>& lengths) { return fmt::format("{:.2f}", mean(lengths)); };
  return fmt::format(kHead, summary.set, summary.problems, summary.solved, summary.found, summary.verified,
                     time(quantile(summary.planning, .5)), time(mean(summary.planning)),
                     time(quantile(summary.planning, .95)), time(quantile(summary.shortening, .5)),
                     time(mean(summary.shortening)), time(quantile(summary.shortening, .95)),
                     length(summary.planned), length(summary.shortened));
}

Json jsonOf(const Summary& summary) {
  return {{"set", summary.set},
          {"problems", summary.problems},
          {"solved", summary.solved},
          {"found", summary.found},
          {"verified", summary.verified},
          {"median_us", quantile(summary.planning, .5)},
          {"mean_us", mean(summary.planning)},
          {"p95_us", quantile(summary.planning, .95)},
          {"shortening_median_us", quantile(summary.shortening, .5)},
          {"shortening_mean_us", mean(summary.shortening)},
          {"shortening_p95_us", quantile(summary.shortening, .95)},
          {"length_planned", mean(summary.planned)},
          {"length_shortened", mean(summary.shortened)}};
}

std::filesystem::path urdfOf(const PandaOptions& options) {
  if (!options.urdf.empty()) return options.urdf;
  const auto folder = std::filesystem::weakly_canonical(options.problems);
  return folder.parent_path() / "urdf" / "panda_spherized.urdf";
}

}  // namespace

void runPandaProblems(const PandaOptions& options) {
  // Before the robot, which is sought beside them.
  static_cast<void>(sphereProblemFiles(options.problems));
  const SceneSpec spec = readSphereRobot(urdfOf(options), options.srdf);
  const SphereRobot robot(compile(spec));
  Summary all{.set = "all"};
  std::vector<Summary> sets;
  std::vector<std::pair<std::string, std::string>> faults;
  for (const SphereProblem& problem : readSphereProblems(options.problems, robot.nq())) {
    if (sets.empty() || sets.back().set != problem.set) sets.push_back({.set = problem.set});
    const Outcome outcome = outcomeOf(robot, spec, problem, options);
    sets.back().add(outcome);
    all.add(outcome);
    if (!outcome.isVerified) faults.emplace_back(problem.name, outcome.fault);
  }
  if (!options.asJson) {
    fmt::print("{}", tableHead());
    for (const Summary& set : sets) fmt::print("{}", line(set));
    fmt::print("{}", line(all));
    for (const auto& [name, fault] : faults) fmt::print("not solved: {}: {}\n", name, fault);
    return;
  }
  Json json = jsonOf(all);
  json.erase("set");
  json["lanes"] = 2 * cpuLanes();
  json["seed"] = options.seed;
  json["repetitions"] = options.repetitions;
  json["sets"] = Json::array();
  for (const Summary& set : sets) json["sets"].push_back(jsonOf(set));
  json["not_solved"] = Json::array();
  for (const auto& [name, fault] : faults) json["not_solved"].push_back({{"problem", name}, {"why", fault}});
  fmt::print("{}\n", json.dump(2));
}

}  // namespace rex::bench
