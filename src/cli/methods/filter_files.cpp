#include "cli/methods/filter_files.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/text_file.h"
#include "cli/project.h"
#include "course/car_figure.h"
#include "course/car_pictures.h"
#include "course/plot.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kTau = CarOptions().tau;
constexpr int kMostFrames = 150, kRate = 15;

// Number of steps between frames.
int filmStride(int steps) { return (steps + kMostFrames - 1) / kMostFrames; }

// Poses at the times 0, 1, ..., one per column.
struct Ways {
  Eigen::Matrix3Xd truth, estimate, deadReckoning;
};

Ways waysOf(const FilterRun& run) {
  const auto fromStart = [](const Eigen::Matrix3Xd& poses) {
    Eigen::Matrix3Xd way = Eigen::Matrix3Xd::Zero(3, poses.cols() + 1);
    way.rightCols(poses.cols()) = poses;
    return way;
  };
  Eigen::Matrix3Xd means(3, run.steps());
  for (Eigen::Index t = 0; t < means.cols(); ++t) means.col(t) = run.poses[static_cast<std::size_t>(t)].mean;
  return {fromStart(run.truth), fromStart(means), fromStart(run.deadReckoning)};
}

// Positions up to a time; of very many only some thousand.
Eigen::Matrix2Xd pointsOf(const Eigen::Matrix3Xd& poses, int time) {
  const int stride = 1 + time / 2000;
  Eigen::Matrix2Xd points(2, time / stride + 2);
  for (Eigen::Index i = 0; i + 1 < points.cols(); ++i) points.col(i) = poses.col(i * stride).head<2>();
  points.rightCols<1>() = poses.col(time).head<2>();
  return points;
}

PlanarGaussian positionOf(const Gaussian& pose) {
  return {pose.mean.head<2>(), pose.covariance.topLeftCorner<2, 2>()};
}

// Adds what is known only after the run: paths and caption.
void complete(CarView& view, const FilterRun& run, const Ways& ways, int time, const std::string& name) {
  constexpr Color kLightTruth{0.45f, 0.48f, 0.54f};
  view.car = ways.truth.col(time);
  view.estimate = ways.estimate.col(time);
  if (time > 0) view.poseBeliefs = {positionOf(run.poses[static_cast<std::size_t>(time - 1)])};
  view.ways = {
      {"dead reckoning", pointsOf(ways.deadReckoning, time), kDeadReckoningColor, true},
      {.name = "true way", .points = pointsOf(ways.truth, time), .color = kLightTruth, .width = 5},
      {.name = "estimate", .points = pointsOf(ways.estimate, time), .color = kEstimateColor, .width = 2}};
  view.caption = fmt::format("{}, {:g} s", name, time * kTau);
}

Figure errorFigure(const FilterRun& run, int number, const std::string& title) {
  constexpr const char* kLabels[] = {"error in x [m]", "error in y [m]", "heading error [rad]"};
  const Eigen::Matrix3Xd errors = run.errors();
  Series error{.label = "error", .color = kEstimateColor};
  Band band{.label = "2 sigma", .color = kEstimateColor};
  const int stride = 1 + run.steps() / 4000;
  for (int t = 0; t < run.steps(); t += stride) {
    const double variance = run.poses[static_cast<std::size_t>(t)].covariance(number, number);
    const double bound = 2 * std::sqrt(std::max(variance, 0.));
    error.x.push_back((t + 1) * kTau);
    error.y.push_back(errors(number, t));
    band.low.push_back(-bound);
    band.high.push_back(bound);
  }
  band.x = error.x;
  return {.title = title,
          .xLabel = "time [s]",
          .yLabel = kLabels[number],
          .legend = Legend::kOutside,
          .series = {error},
          .bands = {band}};
}

// The axis is logarithmic if the NEES of an overconfident filter would make the band too thin to see.
Figure neesFigure(const FilterStatistics& statistics, const std::string& title) {
  const auto [lower, upper] = statistics.stepBand;
  const double end = static_cast<double>(statistics.stepNees.size()) * kTau;
  Figure figure{.title = title,
                .xLabel = "time [s]",
                .yLabel = "NEES [1]",
                .legend = Legend::kOutside,
                .horizontalLines = {{.at = 3, .label = "consistent"}},
                .bands = {{.label = "95 %",
                           .x = {0, end},
                           .low = {lower, lower},
                           .high = {upper, upper},
                           .color = kLandmarkColor}}};
  Series nees{.label = fmt::format("mean of {} runs", statistics.runs.size()), .color = kEstimateColor};
  const std::size_t stride = 1 + statistics.stepNees.size() / 4000;
  for (std::size_t t = 0; t < statistics.stepNees.size(); t += stride) {
    if (!(statistics.stepNees[t] > 0)) continue;  // the covariances were singular
    nees.x.push_back(static_cast<double>(t + 1) * kTau);
    nees.y.push_back(statistics.stepNees[t]);
    figure.logY |= nees.y.back() > 6 * upper;
  }
  if (!nees.x.empty()) figure.series = {std::move(nees)};
  return figure;
}

// The end of the run, with ellipses on the way.
Figure mapFigure(CarView view, const FilterRun& run) {
  constexpr int kEllipses = 12;
  const int stride = std::max(run.steps() / kEllipses, 1);
  for (int t = stride - 1; t + 1 < run.steps(); t += stride)
    view.poseBeliefs.push_back(positionOf(run.poses[static_cast<std::size_t>(t)]));
  view.sightings.resize(2, 0);
  return figureOf(view);
}

}  // namespace

bool isFilmed(int step, int steps) { return step % filmStride(steps) == 0; }

std::string csvOf(const FilterRun& run) {
  fmt::memory_buffer table;
  const auto out = std::back_inserter(table);
  fmt::format_to(out,
                 "time,x,y,heading,x_estimate,y_estimate,heading_estimate,"
                 "var_x,cov_xy,cov_xh,var_y,cov_yh,var_h,x_reckoned,y_reckoned,heading_reckoned,"
                 "nees,nis,innovations,seen\n");
  for (int t = 0; t < run.steps(); ++t) {
    const auto i = static_cast<std::size_t>(t);
    fmt::format_to(out, "{}", (t + 1) * kTau);
    const auto add = [&](const auto& numbers) {
      for (const double number : numbers) fmt::format_to(out, ",{}", number);
    };
    add(run.truth.col(t)), add(run.poses[i].mean);
    for (int row = 0; row < 3; ++row) add(run.poses[i].covariance.row(row).tail(3 - row));
    add(run.deadReckoning.col(t));
    fmt::format_to(out, ",{},{},{},{}\n", run.nees[i], run.updates[i].nis, run.updates[i].degrees,
                   run.seen[i].size());
  }
  return fmt::to_string(table);
}

std::vector<std::string> writeFilterFiles(const FilterOptions& options, const FilterRun& run,
                                          const FilterStatistics& statistics, ShownRun shownRun) {
  std::vector<fs::path> files = {"filter.csv"};
  writeTextFile(options.out / files.back(), csvOf(run));
  const Ways ways = waysOf(run);
  complete(shownRun.end, run, ways, run.steps(), options.filter);
  const std::string title = fmt::format("{}, seed {}", options.filter, run.seed);
  const std::vector<std::pair<const char*, Figure>> figures = {
      {"error_x", errorFigure(run, 0, title)},
      {"error_y", errorFigure(run, 1, title)},
      {"error_heading", errorFigure(run, 2, title)},
      {"nees", neesFigure(statistics, options.filter)},
      {"map", mapFigure(std::move(shownRun.end), run)}};
  for (const auto& [name, figure] : figures) {
    plot((options.out / name).string(), figure);
    files.emplace_back(fmt::format("{}.png", name));
  }
  if (!options.noFilm) {
    std::vector<CarView>& frames = shownRun.frames;
    frames.insert(frames.begin(), CarView{.landmarks = run.landmarks});
    const int stride = filmStride(run.steps());
    for (std::size_t i = 0; i < frames.size(); ++i)
      complete(frames[i], run, ways, static_cast<int>(i) * stride, options.filter);
    writeFilm(frames, (options.out / "filter").string(), {.rate = kRate, .step = stride * kTau});
    files.emplace_back(fs::exists(options.out / "filter.mp4") ? "filter.mp4" : "filter");
    files.emplace_back("filter_sheet.png");
  }
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(shown(options.out / file));
  return names;
}

}  // namespace rex::cli
