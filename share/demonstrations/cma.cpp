// Chapter 9: CMA-ES finds its way through a curved valley. Each generation draws samples (dots) from an
// ellipse (two deviations) that adapts to them; it stretches along the valley. Sliders change samples and
// first deviation. A table counts the evaluations that it needs for test functions in ten dimensions; where
// there are many local minima, larger populations and restarts help.
// Slides: 9:30, 9:31
// Formula: x_i ~ N(m, σ² C); m ← Σ w_i x_i over the better half; σ and C from the paths of m
// Try: The ellipse of samples stretches along a valley and finds its end. With 4 samples it wanders.
#include <cstdio>

#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "optim/cma_es.h"
#include "optim/cma_search.h"
#include "optim/test_functions.h"
#include "render/picture.h"

using namespace rex;

// Runs that differ in the seed. Evaluations per success: the mean of the successes, divided by their share
// (9:32).
void count(const TestFunction& function, int lambda, int restarts, std::uint64_t seed, int runs) {
  const auto everywhere = [](double number) { return Eigen::VectorXd::Constant(10, number); };
  double evaluations = 0, successes = 0;
  for (int i = 0; i < runs; ++i) {
    Rng rng(seed + static_cast<std::uint64_t>(i));
    const SearchResult result =
        minimizeByRestarts(batched(function.value), everywhere(function.low), everywhere(function.high),
                           everywhere(function.deviation), rng,
                           {.first = {.lambda = lambda},
                            .limits = {.target = function.target, .maxEvaluations = 10'000'000},
                            .maxRestarts = restarts});
    std::printf("%-18s %7d %9d %5d %12ld %12.5g  %s\n", std::string(function.name).c_str(), lambda, restarts,
                static_cast<int>(seed) + i, result.evaluations, result.value, toString(result.status));
    if (result.status == SearchStatus::kTargetReached)
      ++successes, evaluations += static_cast<double>(result.evaluations);
  }
  std::printf("%g of %d reached the target", successes, runs);
  if (successes > 0)
    std::printf(", %.0f evaluations per success", evaluations * runs / (successes * successes));
  std::printf("\n");
  std::fflush(stdout);
}

int main(int argc, char** argv) {
  const std::uint64_t seed = argc > 1 ? std::stoull(argv[1]) : 0;
  const int runs = argc > 2 ? std::stoi(argv[2]) : 3;
  LiveView view("cma");
  view.lookFrom({0, -0.25, 1});
  const auto height = [](double x, double y) {
    return std::pow(1 - x, 2) + 100 * std::pow(y - x * x, 2);
  };                           // Rosenbrock
  std::vector<LineSet> rings;  // where it is 0.3, 1, 3, ...: cells of which one corner is above and one below
  for (const double level : {0.3, 1., 3., 10., 30., 100., 300., 1000.}) {
    LineSet ring{.color = {0.55f, 0.6f, 0.66f}, .width = 1.5};
    const double d = 0.05;
    for (double x = -2; x < 2; x += d)
      for (double y = -1; y < 3; y += d) {
        std::vector<Eigen::Vector3d> cut;
        const Eigen::Vector2d corners[] = {{x, y}, {x + d, y}, {x + d, y + d}, {x, y + d}, {x, y}};
        for (int k = 0; k < 4; ++k) {
          const Eigen::Vector2d &p = corners[k], &q = corners[k + 1];
          const double a = height(p.x(), p.y()) - level, b = height(q.x(), q.y()) - level;
          if ((a < 0) == (b < 0)) continue;
          const Eigen::Vector2d m = p + a / (a - b) * (q - p);
          cut.push_back({m.x(), m.y(), 0});
        }
        if (cut.size() >= 2) ring.segments.push_back({cut[0], cut[1]});
      }
    rings.push_back(ring);
  }
  std::optional<CmaEs> search;
  Eigen::MatrixXd X;
  Eigen::Vector2d last(-1, -1);
  std::vector<Eigen::Vector3d> way;
  Rng rng(seed);
  for (int t = 0; t < 330 || view.isWatched(); ++t) {
    const double samples = std::round(view.slider("samples", 4, 60, 12)),
                 deviation = view.slider("first deviation", 0.05, 1, 0.3);
    const double pace = view.slider("generations a second", 0.5, 15, 5);
    if (view.button("from the start") || last != Eigen::Vector2d(samples, deviation)) {
      last = {samples, deviation}, way = {{-1.5, 2.5, 0.02}};
      search.emplace(Eigen::Vector2d(-1.5, 2.5), Eigen::Vector2d::Constant(deviation),
                     CmaOptions{.lambda = static_cast<int>(samples)});
      X.resize(2, search->lambda()), search->sample(X, rng);
    }
    if (std::fmod(t * pace / 30, 1) < pace / 30 && search->sigma() > 1e-6) {
      Eigen::VectorXd values(X.cols());
      for (int i = 0; i < X.cols(); ++i) values[i] = height(X(0, i), X(1, i));
      search->update(X, values);
      view.plot("log10 of the best value", search->generation(), std::log10(values.minCoeff() + 1e-12),
                "generation");
      view.plot("log10 of sigma", search->generation(), std::log10(search->sigma()), "generation");
      search->sample(X, rng);
      way.push_back({search->mean()[0], search->mean()[1], 0.02});
    }
    Picture picture{.ground = {.visible = false}};
    picture.lineSets = rings;
    Eigen::Matrix3d flat = 1e-6 * Eigen::Matrix3d::Identity();
    flat.topLeftCorner<2, 2>() = search->sigma() * search->sigma() * search->covariance();
    picture.ellipsoids.push_back(covarianceEllipsoid(way.back(), flat, 2));
    PointSet dots{.color = kDeadReckoningColor, .size = 8};
    for (const auto& x : X.colwise())
      if (x.cwiseAbs().maxCoeff() < 4) dots.points.push_back({x[0], x[1], 0.04});
    if (!dots.points.empty()) picture.pointSets.push_back(dots);
    if (way.size() > 1) picture.polylines.push_back({.points = way, .color = kEstimateColor, .width = 3});
    picture.pointSets.push_back({.points = {{1, 1, 0.01}}, .color = kLandmarkColor, .size = 16});
    picture.polylines.push_back(
        {.points = {{-2.2, -1.2, 0}, {2.2, -1.2, 0}, {2.2, 3.2, 0}, {-2.2, 3.2, 0}, {-2.2, -1.2, 0}},
         .color = kTruthColor});
    picture.captions.push_back({.text = "generation " + std::to_string(search->generation()), .scale = 1.5});
    view.show(picture);
  }
  std::printf("function            lambda  restarts  seed  evaluations         best  ended by\n");
  for (const TestFunction& function : testFunctions()) count(function, 0, 0, seed, runs);
  count(testFunction("rastrigin"), 200, 0, seed, runs);
  count(testFunction("rastrigin"), 0, 9, seed, runs);
}
