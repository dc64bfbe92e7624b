#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/exit_code.h"
#include "base/rng.h"
#include "cli/json_internal.h"
#include "cli/methods/learning_curves.h"
#include "cli/methods/methods_room_internal.h"
#include "cli/option_value_internal.h"
#include "cli/shared_options_internal.h"
#include "cli/terminal.h"
#include "cli/wrong_use_internal.h"
#include "optim/cma_search.h"
#include "optim/test_functions.h"

namespace rex::cli {
namespace {

struct CmaRunOptions {
  std::string function{};  ///< see testFunction()
  int dimension = 10;
  std::optional<double>
      deviation{};  ///< of the first samples; if empty, like box and target, the function's own
  std::optional<double> low{}, high{};
  std::optional<double> target{};
  int lambda = 0;  ///< 0: the default
  int restarts = 0;
  double maxEvaluations = 1e7;  ///< for each seed
  std::uint64_t seed = 0;
  int seeds = 1;
  bool json = false;
  std::filesystem::path out{};  ///< a folder for a figure; empty: none
};

constexpr double kMostNumbers = 1e7;  // in a generation: 80 MB

struct Run {
  std::uint64_t seed = 0;
  SearchResult result{};
  LearningCurve curve{};
  bool isSuccess() const { return result.status == SearchStatus::kTargetReached; }
};

// The options of the command line, completed by the defaults of the function.
struct Experiment {
  TestFunction function;
  Eigen::VectorXd low, high, deviations;
  RestartOptions search;
};

Experiment experimentOf(const CmaRunOptions& options) {
  const TestFunction& function = asWrongUse([&] { return testFunction(options.function); }, "--function: ");
  requireBetween("--dim", options.dimension, function.leastDimension, 1000);
  requireBetween("--seeds", options.seeds, 1, 10'000);
  requireBetween("--restarts", options.restarts, 0, 20);
  requireBetween("--max-evaluations", options.maxEvaluations, 1, 1e9);
  if (options.lambda != 0) requireBetween("--lambda", options.lambda, 2, kMostNumbers / options.dimension);
  const double low = options.low.value_or(function.low), high = options.high.value_or(function.high);
  const double deviation = options.deviation.value_or(function.deviation);
  requireBetween("--sigma", deviation, 1e-12, 1e12);
  requireBetween("--x0-low", low, -1e12, 1e12);
  requireBetween("--x0-high", high, low, 1e12);
  const double target = options.target.value_or(function.target);
  requireBetween("--target", target, -1e300, 1e300);
  const auto everywhere = [&](double number) { return Eigen::VectorXd::Constant(options.dimension, number); };
  return {function,
          everywhere(low),
          everywhere(high),
          everywhere(deviation),
          {.first = {.lambda = options.lambda},
           .limits = {.target = target, .maxEvaluations = static_cast<long>(options.maxEvaluations)},
           .maxRestarts = options.restarts}};
}

// The learning curve is long, so it is kept only if it will be drawn.
Run runOf(const Experiment& experiment, std::uint64_t seed, bool keepsCurve) {
  Run run{.seed = seed};
  const BatchObjective f = batched(experiment.function.value);
  double best = std::numeric_limits<double>::infinity(), evaluations = 0;
  const BatchObjective watched = [&](const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> values) {
    f(X, values);
    if (!keepsCurve) return;
    best = std::min(best, values.minCoeff());
    evaluations += static_cast<double>(X.cols());
    run.curve.evaluations.push_back(evaluations);
    run.curve.values.push_back(best);
  };
  Rng rng(seed);
  run.result = minimizeByRestarts(watched, experiment.low, experiment.high, experiment.deviations, rng,
                                  experiment.search);
  return run;
}

// Mean evaluations of successful runs, divided by their share, as on slide 9:32; infinite if none succeeded.
double evaluationsPerSuccess(const std::vector<Run>& runs) {
  double spent = 0, successes = 0;
  for (const Run& run : runs) {
    if (!run.isSuccess()) continue;
    spent += static_cast<double>(run.result.evaluations);
    ++successes;
  }
  return successes > 0 ? spent * static_cast<double>(runs.size()) / (successes * successes)
                       : std::numeric_limits<double>::infinity();
}

std::string jsonOf(const std::vector<Run>& runs) {
  Json list = Json::array();
  for (const Run& run : runs)
    list.push_back({{"seed", run.seed},
                    {"evaluations", run.result.evaluations},
                    {"best", std::isfinite(run.result.value) ? Json(run.result.value) : Json()},
                    {"success", run.isSuccess()},
                    {"status", nameOf(run.result.status)}});
  const double perSuccess = evaluationsPerSuccess(runs);
  return dump(Json{{"runs", std::move(list)},
                   {"evaluations_per_success", std::isfinite(perSuccess) ? Json(perSuccess) : Json()}});
}

std::string tableOf(const std::vector<Run>& runs) {
  std::string text = fmt::format("{:>8} {:>12} {:>12}  {}", "seed", "evaluations", "best", "ended by");
  for (const Run& run : runs)
    text += fmt::format("\n{:>8} {:>12} {:>12.5g}  {}", run.seed, run.result.evaluations, run.result.value,
                        nameOf(run.result.status));
  const auto successes = std::ranges::count_if(runs, &Run::isSuccess);
  text += fmt::format("\n{} of {} reached the target", successes, runs.size());
  if (successes > 0) text += fmt::format(", {:.0f} evaluations per success", evaluationsPerSuccess(runs));
  return text;
}

void makeFolder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem)
    throw UsageError(
        {.what = "-o " + harmless(folder.string()), .found = problem.message(), .wanted = "a folder"});
}

// Counts the evaluations that CMA-ES needs for a test function. kBelow if no seed reaches the target.
ExitCode cma(const CmaRunOptions& options) {
  const Experiment experiment = experimentOf(options);
  if (!options.out.empty()) makeFolder(options.out);
  std::vector<Run> runs;
  for (int i = 0; i < options.seeds; ++i)
    runs.push_back(runOf(experiment, options.seed + static_cast<std::uint64_t>(i), !options.out.empty()));
  say(options.json ? jsonOf(runs) : tableOf(runs));
  if (!options.out.empty()) {
    std::vector<LearningCurve> curves;
    for (Run& run : runs)
      if (!run.curve.values.empty()) curves.push_back(std::move(run.curve));
    if (curves.empty()) throw UsageError({.what = "-o", .found = "no evaluations to draw"});
    const std::filesystem::path file = options.out / "learning-curve.png";
    const std::string title = fmt::format("CMA-ES: {} in {} dimensions, {} runs", experiment.function.name,
                                          options.dimension, runs.size());
    asWrongUse([&] {
      writeFigure(figureOf(curves, experiment.search.limits.target, title), file);
      return 0;
    });
    if (!options.json) say(file.string());
  }
  return std::ranges::any_of(runs, &Run::isSuccess) ? ExitCode::kFull : ExitCode::kBelow;
}

}  // namespace

void addCma(CLI::App* command, Action& action) {
  const auto options = std::make_shared<CmaRunOptions>();
  command->footer(
      "Examples:\n  scripts/rex cma --function ackley --dim 20 --seeds 20 -o curve\n"
      "  scripts/rex cma --function rastrigin --dim 10 --lambda 200 --seeds 10 --json\n"
      "  scripts/rex cma --function rastrigin --dim 10 --restarts 9\n\n"
      "Functions: sphere, ellipsoid, cigar, rosenbrock, ackley, griewank, rastrigin, rotated-rastrigin and\n"
      "schwefel. Their minimum is 0. Unless given, starts, step sizes and targets are those of slide 9:32.\n"
      "Exit code 1: no run reached the target.");
  command->add_option("--function", options->function, "what to minimise")->type_name("NAME")->required();
  command->add_option("--dim", options->dimension, "dimension of the function (default: 10)")->type_name("N");
  command->add_option("--sigma", options->deviation, "standard deviation of the first samples")
      ->type_name("NUMBER");
  command->add_option("--x0-low", options->low, "runs start between this ...")->type_name("NUMBER");
  command->add_option("--x0-high", options->high, "... and this, in all coordinates")->type_name("NUMBER");
  command->add_option("--lambda", options->lambda, "samples per generation (default: 4 + 3 ln n)")
      ->type_name("COUNT");
  command->add_option("--target", options->target, "value at which a run is done")->type_name("NUMBER");
  command
      ->add_option("--restarts", options->restarts,
                   "restart up to this often, with twice the samples (default: 0)")
      ->type_name("COUNT");
  command->add_option("--max-evaluations", options->maxEvaluations, "limit for one run (default: 1e7)")
      ->type_name("COUNT");
  addSeed(command, options->seed, "seed of the first run (default: 0)");
  command->add_option("--seeds", options->seeds, "number of runs, each with its own seed (default: 1)")
      ->type_name("COUNT");
  command->add_option("-o,--out", options->out, "draw the learning curves into this folder")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "print JSON");
  command->callback([&action, options] { action = [options](const Project&) { return cma(*options); }; });
}

}  // namespace rex::cli
