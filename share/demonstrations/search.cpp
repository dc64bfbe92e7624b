// Chapter 9: Search without derivatives. Dots are the points that a method has tried, from blue over time to
// orange; the best is green. Buttons change method and function. A table counts the evaluations that all
// methods need for all functions in five dimensions (mean of the successful runs, divided by their share:
// slide 9:32), and what they find with 80 evaluations, which is where Bayesian optimisation pays.
// Slides: 9:22 to 9:28, 6:29
// Formula: min_x f(x) from values of f alone
// Try: Eight methods on one function. Press "next function" until rastrigin: most miss the minimum.
#include <cstdio>
#include <limits>

#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "optim/bayesian_search.h"
#include "optim/cma_search.h"
#include "optim/simplex_search.h"
#include "optim/stochastic_search.h"
#include "optim/test_functions.h"
#include "render/picture.h"

using namespace rex;

// All methods begin by drawing a start, and so at the same one.
SearchResult search(const std::string& method, const TestFunction& function, const Objective& f,
                    int dimension, long most, Rng& rng) {
  const auto everywhere = [&](double number) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(dimension, number);
  };
  const double target = function.target, deviation = function.deviation;
  if (method == "cma")  // restarted with twice as many samples
    return minimizeByRestarts(batched(f), everywhere(function.low), everywhere(function.high),
                              everywhere(deviation), rng,
                              {.limits = {.target = target, .maxEvaluations = most}});
  if (method == "bayes") {
    // It needs a box, which should not leave out the minimum: starts lie on one side of it.
    const double low = std::min(function.low, -function.high);
    return minimizeByBayes(f, everywhere(low), everywhere(function.high), rng,
                           {.maxEvaluations = most, .target = target});
  }
  const Eigen::VectorXd start = rng.uniformVector(dimension, function.low, function.high);
  if (method == "one-plus-one")
    return minimizeByOnePlusOne(f, start, deviation, rng, {.maxEvaluations = most, .target = target});
  if (method == "evolution")
    return minimizeByEvolution(batched(f), start, deviation, rng, {.target = target, .maxEvaluations = most});
  if (method == "distribution")
    return minimizeByDistribution(batched(f), start, deviation, rng,
                                  {.maxEvaluations = most, .target = target});
  if (method == "simplex")
    return minimizeBySimplex(f, start, {.step = deviation, .maxEvaluations = most, .target = target});
  if (method == "annealing")
    return minimizeByAnnealing(f, start, rng,
                               {.deviation = 0.1 * deviation,
                                .lastTemperature = 0.1 * target,
                                .maxEvaluations = most,
                                .target = target});
  return climbByChance(f, start, rng, {.step = deviation, .maxEvaluations = most, .target = target});
}

const std::vector<std::string> kMethods{"cma",     "one-plus-one", "evolution", "distribution",
                                        "simplex", "annealing",    "climbing",  "bayes"};

// Evaluations per success, or the median of the best values.
void printTable(std::uint64_t seed, int runs, int dimension, long most, bool isOfValues) {
  std::printf("%-18s", "");
  for (const std::string& method : kMethods)
    if (method != "bayes" || most <= 300) std::printf("%16s", method.c_str());
  for (const TestFunction& function : testFunctions()) {
    std::printf("\n%-18s", std::string(function.name).c_str());
    for (const std::string& method : kMethods) {
      if (method == "bayes" && most > 300) continue;  // its model would take too long
      double evaluations = 0, successes = 0;
      std::vector<double> bests;
      for (int i = 0; i < runs; ++i) {
        Rng rng(seed + static_cast<std::uint64_t>(i));
        const SearchResult result = search(method, function, function.value, dimension, most, rng);
        bests.push_back(result.value);
        if (result.status == SearchStatus::kTargetReached)
          ++successes, evaluations += static_cast<double>(result.evaluations);
      }
      std::sort(bests.begin(), bests.end());
      char text[32] = "-";
      if (isOfValues && std::isfinite(bests[bests.size() / 2]))
        std::snprintf(text, sizeof text, "%.3g",
                      (bests[bests.size() / 2] + bests[(bests.size() - 1) / 2]) / 2);
      else if (!isOfValues && successes > 0)
        std::snprintf(text, sizeof text, successes < runs ? "%.0f (%g/%d)" : "%.0f",
                      evaluations * runs / (successes * successes), successes, runs);
      std::printf("%16s", text);
      std::fflush(stdout);
    }
  }
  std::printf("\n%s in %d dimensions, %d runs with at most %ld evaluations\n\n",
              isOfValues ? "best value (median)" : "evaluations per success", dimension, runs, most);
}

int main(int argc, char** argv) {
  std::uint64_t seed = argc > 1 ? std::stoull(argv[1]) : 0;
  const int runs = argc > 2 ? std::stoi(argv[2]) : 3;
  LiveView view("search");
  view.lookFrom({0, -0.25, 1});
  const std::span<const TestFunction> functions = testFunctions();
  std::size_t which = 3, method = 0;  // the valley of Rosenbrock
  std::vector<Eigen::Vector2d> tried;
  std::vector<double> bests;
  std::size_t shown = 0;
  for (std::size_t run = 0; run < kMethods.size() || view.isWatched();) {
    const long most = std::lround(view.slider("evaluations", 20, 300, 200));
    if (view.button("next function")) which = (which + 1) % functions.size(), tried.clear();
    if (view.button("next method")) method = (method + 1) % kMethods.size(), tried.clear();
    if (view.button("another seed")) ++seed, tried.clear();
    const TestFunction& function = functions[which];
    const double size = std::max(std::abs(function.low), std::abs(function.high)), scale = 3 / size;
    if (tried.empty()) {
      shown = 0, bests.clear();
      Rng rng(seed);
      (void)search(
          kMethods[method], function,
          [&](const VectorArg& x) {
            tried.emplace_back(x[0], x[1]);
            bests.push_back(std::min(bests.empty() ? 1e300 : bests.back(), function.value(x)));
            return function.value(x);
          },
          2, most, rng);
    }
    shown = std::min(shown + 5, tried.size());
    Picture picture{.ground = {.visible = false}};
    PointSet dots[] = {{.color = kEstimateColor, .size = 7}, {.color = kDeadReckoningColor, .size = 7}};
    for (std::size_t i = 0; i < shown; ++i)
      if (const Eigen::Vector2d p = scale * tried[i]; p.cwiseAbs().maxCoeff() < 4)
        dots[2 * i / tried.size()].points.emplace_back(p[0], p[1], 0.02);
    for (const PointSet& one : dots)
      if (!one.points.empty()) picture.pointSets.push_back(one);
    picture.pointSets.push_back({.points = {scale * function.minimizer * Eigen::Vector3d(1, 1, 0)},
                                 .color = kLandmarkColor,
                                 .size = 14});
    picture.polylines.push_back(
        {.points = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {-4, -4, 0}}, .color = kTruthColor});
    picture.captions.push_back({.text = kMethods[method] + " on " + std::string(function.name) + ", " +
                                        std::to_string(shown) + " evaluations",
                                .scale = 1.5});
    view.plot("log10 of the best: " + kMethods[method], static_cast<double>(shown),
              std::log10(bests[shown - 1] + 1e-12), "evaluations");
    view.show(picture);
    if (shown < tried.size()) continue;
    ++run;
    if (!view.isWatched()) method = (method + 1) % kMethods.size(), tried.clear();
  }
  printTable(seed, runs, 5, 100'000, false);
  printTable(seed, runs, 3, 80, true);
}
