// `rex search`: methods of chapter 9 against test functions, in one table.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/exit_code.h"
#include "base/join.h"
#include "base/rng.h"
#include "cli/json_internal.h"
#include "cli/methods/methods_room_internal.h"
#include "cli/option_value_internal.h"
#include "cli/shared_options_internal.h"
#include "cli/terminal.h"
#include "optim/annealing.h"
#include "optim/bayesian_search.h"
#include "optim/cma_search.h"
#include "optim/distribution_search.h"
#include "optim/evolution_strategy.h"
#include "optim/hill_climbing.h"
#include "optim/one_plus_one_cma.h"
#include "optim/simplex_search.h"
#include "optim/test_functions.h"

namespace rex::cli {
namespace {

// What a method gets for one run. All begin by drawing a start, and so at the same one.
struct Task {
  const TestFunction& function;
  int dimension;
  long maxEvaluations;

  [[nodiscard]] Eigen::VectorXd start(Rng& rng) const {
    return rng.uniformVector(dimension, function.low, function.high);
  }
};

struct Method {
  std::string_view name, title;
  SearchResult (*search)(const Task& task, Rng& rng);
  long mostEvaluations = std::numeric_limits<long>::max();  // with more it would take too long
};

constexpr Method kMethods[] = {
    {"cma", "CMA-ES, restarted with twice as many samples",
     [](const Task& task, Rng& rng) -> SearchResult {
       const auto everywhere = [&](double number) {
         return Eigen::VectorXd::Constant(task.dimension, number);
       };
       return minimizeByRestarts(
           batched(task.function.value), everywhere(task.function.low), everywhere(task.function.high),
           everywhere(task.function.deviation), rng,
           {.limits = {.target = task.function.target, .maxEvaluations = task.maxEvaluations}});
     }},
    {"one-plus-one", "(1+1)-CMA-ES",
     [](const Task& task, Rng& rng) {
       return minimizeByOnePlusOne(task.function.value, task.start(rng), task.function.deviation, rng,
                                   {.maxEvaluations = task.maxEvaluations, .target = task.function.target});
     }},
    {"evolution", "(mu, lambda) evolution strategy",
     [](const Task& task, Rng& rng) {
       return minimizeByEvolution(batched(task.function.value), task.start(rng), task.function.deviation, rng,
                                  {.target = task.function.target, .maxEvaluations = task.maxEvaluations});
     }},
    {"distribution", "estimation of distribution",
     [](const Task& task, Rng& rng) {
       return minimizeByDistribution(batched(task.function.value), task.start(rng), task.function.deviation,
                                     rng,
                                     {.maxEvaluations = task.maxEvaluations, .target = task.function.target});
     }},
    {"simplex", "downhill simplex of Nelder and Mead",
     [](const Task& task, Rng& rng) {
       return minimizeBySimplex(task.function.value, task.start(rng),
                                {.step = task.function.deviation,
                                 .maxEvaluations = task.maxEvaluations,
                                 .target = task.function.target});
     }},
    {"annealing", "simulated annealing",
     [](const Task& task, Rng& rng) -> SearchResult {
       return minimizeByAnnealing(task.function.value, task.start(rng), rng,
                                  {.deviation = 0.1 * task.function.deviation,
                                   .lastTemperature = 0.1 * task.function.target,
                                   .maxEvaluations = task.maxEvaluations,
                                   .target = task.function.target});
     }},
    {"climbing", "random steps downhill",
     [](const Task& task, Rng& rng) {
       return climbByChance(task.function.value, task.start(rng), rng,
                            {.step = task.function.deviation,
                             .maxEvaluations = task.maxEvaluations,
                             .target = task.function.target});
     }},
    {"bayes", "Bayesian optimisation with a Gaussian process",
     [](const Task& task, Rng& rng) -> SearchResult {
       // It needs a box, which should not leave out the minimum: starts lie on one side of it.
       const double high = task.function.high, low = std::min(task.function.low, -high);
       return minimizeByBayes(task.function.value, Eigen::VectorXd::Constant(task.dimension, low),
                              Eigen::VectorXd::Constant(task.dimension, high), rng,
                              {.maxEvaluations = task.maxEvaluations, .target = task.function.target});
     },
     300},
};

struct SearchOptions {
  std::vector<std::string> methods{}, functions{};  ///< empty: all
  int dimension = 5, seeds = 10;
  std::uint64_t seed = 0;
  double maxEvaluations = 1e5;
  bool showsBest = false, json = false;
};

// The ones named, in the order of the table, all if none is. Throws UsageError for a name that is not there.
template <class One>
std::vector<const One*> chosen(const char* option, const std::vector<std::string>& names, const One* first,
                               const One* last) {
  std::vector<std::string> known;
  for (const One* one = first; one != last; ++one) known.emplace_back(one->name);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError({.what = option,
                        .found = "'" + harmless(name) + "'",
                        .wanted = join(known, ", "),
                        .nearest = nearestNames(name, known)});
  std::vector<const One*> found;
  for (const One* one = first; one != last; ++one)
    if (names.empty() || std::find(names.begin(), names.end(), one->name) != names.end())
      found.push_back(one);
  return found;
}

// Of one method on one function.
struct Cell {
  int successes = 0;
  double evaluations = 0;       // of the successes
  std::vector<double> bests{};  // of each run
  int runs = 0;
  // As on slide 9:32: the mean of the successful runs, divided by their share.
  [[nodiscard]] double perSuccess() const { return evaluations * runs / (double(successes) * successes); }
  [[nodiscard]] double best() const { return *std::ranges::min_element(bests); }
  [[nodiscard]] double median() const {
    std::vector<double> sorted = bests;
    std::ranges::sort(sorted);
    return (sorted[sorted.size() / 2] + sorted[(sorted.size() - 1) / 2]) / 2;
  }
};

Cell measured(const Method& method, const TestFunction& function, const SearchOptions& options) {
  Cell cell;
  for (int i = 0; i < options.seeds; ++i) {
    Rng rng(options.seed + static_cast<std::uint64_t>(i));
    const SearchResult result =
        method.search({function, options.dimension, static_cast<long>(options.maxEvaluations)}, rng);
    ++cell.runs;
    cell.bests.push_back(result.value);
    if (result.status != SearchStatus::kTargetReached) continue;
    ++cell.successes;
    cell.evaluations += static_cast<double>(result.evaluations);
  }
  return cell;
}

std::string textOf(const Cell& cell, bool showsBest) {
  if (showsBest) return std::isfinite(cell.median()) ? fmt::format("{:.3g}", cell.median()) : "-";
  if (cell.successes == 0) return "-";
  if (cell.successes == cell.runs) return fmt::format("{:.0f}", cell.perSuccess());
  return fmt::format("{:.0f} ({}/{})", cell.perSuccess(), cell.successes, cell.runs);
}

ExitCode search(const SearchOptions& options) {
  auto methods = chosen("--method", options.methods, std::begin(kMethods), std::end(kMethods));
  std::erase_if(methods, [&](const Method* method) {
    if (!(options.maxEvaluations > static_cast<double>(method->mostEvaluations))) return false;
    if (!options.methods.empty())
      requireBetween(fmt::format("--max-evaluations of {}", method->name).c_str(), options.maxEvaluations, 10,
                     static_cast<double>(method->mostEvaluations));
    note(fmt::format("{} is left out: it is compared with --max-evaluations up to {}", method->name,
                     method->mostEvaluations));
    return true;
  });
  const auto all = testFunctions();
  const auto functions = chosen("--function", options.functions, all.data(), all.data() + all.size());
  int least = 1;
  for (const TestFunction* function : functions) least = std::max(least, function->leastDimension);
  requireBetween("--dim", options.dimension, least, 100);
  requireBetween("--seeds", options.seeds, 1, 1000);
  requireBetween("--max-evaluations", options.maxEvaluations, 10, 1e8);

  Json rows = Json::array();
  std::string head = fmt::format("{:<18}", "");
  for (const Method* method : methods) head += fmt::format("{:>16}", method->name);
  if (!options.json) say(head);
  bool isAnySolved = false;
  for (const TestFunction* function : functions) {
    std::string line = fmt::format("{:<18}", function->name);
    for (const Method* method : methods) {
      const Cell cell = measured(*method, *function, options);
      isAnySolved |= cell.successes > 0;
      line += fmt::format("{:>16}", textOf(cell, options.showsBest));
      rows.push_back({{"function", function->name},
                      {"method", method->name},
                      {"runs", cell.runs},
                      {"successes", cell.successes},
                      {"evaluations_per_success", cell.successes > 0 ? Json(cell.perSuccess()) : Json()},
                      {"best", std::isfinite(cell.best()) ? Json(cell.best()) : Json()},
                      {"median", std::isfinite(cell.median()) ? Json(cell.median()) : Json()}});
    }
    if (!options.json) say(line);
  }
  if (options.json) {
    say(dump(Json{{"dimension", options.dimension}, {"cells", std::move(rows)}}));
  } else if (options.showsBest) {
    say(wrap(
        fmt::format("The best value found in {} dimensions with {:.0f} evaluations, the median of {} runs.",
                    options.dimension, options.maxEvaluations, options.seeds),
        0, 0));
  } else {
    say(wrap(
        fmt::format("Evaluations per success in {} dimensions, {} runs each, and how many reached the target "
                    "unless all did.",
                    options.dimension, options.seeds),
        0, 0));
  }
  return isAnySolved ? ExitCode::kFull : ExitCode::kBelow;
}

}  // namespace

void addSearch(CLI::App* command, Action& action) {
  const auto options = std::make_shared<SearchOptions>();
  std::string methods;
  for (const Method& method : kMethods) methods += fmt::format("  {:<14} {}\n", method.name, method.title);
  command->footer(
      "Examples:\n  scripts/rex search --seeds 3\n"
      "  scripts/rex search --function rosenbrock,rastrigin --method cma,simplex --dim 8 --json\n"
      "  scripts/rex search --best --max-evaluations 80 --dim 3\n\n"
      "Methods:\n" +
      methods +
      "\nFunctions are those of `rex cma`, with their starts, step sizes and targets. Exit code 1: nothing\n"
      "reached a target. bayes is for expensive functions: it is compared if each run has at most 300\n"
      "evaluations, and searches a box around the minimum instead of going from a start.");
  command->add_option("--function", options->functions, "functions, separated by commas (default: all)")
      ->type_name("NAMES")
      ->delimiter(',');
  command->add_option("--method", options->methods, "methods, separated by commas (default: all)")
      ->type_name("NAMES")
      ->delimiter(',');
  command->add_option("--dim", options->dimension, "dimension of the functions (default: 5)")->type_name("N");
  command->add_option("--max-evaluations", options->maxEvaluations, "limit for one run (default: 1e5)")
      ->type_name("COUNT");
  command->add_flag("--best", options->showsBest, "show the best values, the median of the runs");
  addSeed(command, options->seed, "seed of the first run (default: 0)");
  command->add_option("--seeds", options->seeds, "number of runs, each with its own seed (default: 10)")
      ->type_name("COUNT");
  command->add_flag("--json", options->json, "print JSON");
  command->callback([&action, options] { action = [options](const Project&) { return search(*options); }; });
}

}  // namespace rex::cli
