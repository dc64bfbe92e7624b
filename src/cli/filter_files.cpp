#include "cli/filter_files.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/option_value_internal.h"
#include "cli/project.h"
#include "course/car_figure.h"
#include "course/car_pictures.h"
#include "course/plot.h"
#include "grading/text_file.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFrames = 150, kRate = 15;

Eigen::Matrix3Xd meansOf(const FilterRun& run) {
  Eigen::Matrix3Xd means(3, run.steps());
  for (Eigen::Index t = 0; t < means.cols(); ++t) means.col(t) = run.poses[static_cast<std::size_t>(t)].mean;
  return means;
}

// Up to a step, from the start on; of very many steps some thousand.
Eigen::Matrix2Xd wayOf(const Eigen::Matrix3Xd& poses, int step) {
  const int stride = 1 + step / 2000;
  Eigen::Matrix2Xd way = Eigen::Matrix2Xd::Zero(2, step / stride + 2);
  for (Eigen::Index i = 1; i < way.cols(); ++i)
    way.col(i) = poses.col(std::min(static_cast<int>(i - 1) * stride, step)).head<2>();
  way.rightCols<1>() = poses.col(step).head<2>();
  return way;
}

PlanarGaussian positionOf(const Gaussian& pose) {
  return {pose.mean.head<2>(), pose.covariance.topLeftCorner<2, 2>()};
}

void complete(CarView& view, const FilterRun& run, const Eigen::Matrix3Xd& means, int step,
              const std::string& caption) {
  view.car = run.truth.col(step);
  view.estimate = means.col(step);
  view.poseBeliefs = {positionOf(run.poses[static_cast<std::size_t>(step)])};
  view.ways = {{"dead reckoning", wayOf(run.deadReckoning, step), kDeadReckoningColor, true},
               {"true way", wayOf(run.truth, step), kTruthColor},
               {"estimate", wayOf(means, step), kEstimateColor}};
  view.caption = caption;
}

Figure errorFigure(const FilterRun& run, int number, const std::string& title, double tau) {
  constexpr const char* kLabels[] = {"error of x [m]", "error of y [m]", "error of the heading [rad]"};
  const Eigen::Matrix3Xd errors = run.errors();
  Series error{.label = "error", .color = kEstimateColor};
  Band band{.label = "2 sigma", .color = kEstimateColor};
  const int stride = 1 + run.steps() / 4000;
  for (int t = 0; t < run.steps(); t += stride) {
    const double variance = run.poses[static_cast<std::size_t>(t)].covariance(number, number);
    const double bound = 2 * std::sqrt(std::max(variance, 0.));
    error.x.push_back((t + 1) * tau);
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

Figure neesFigure(const FilterStatistics& statistics, const std::string& title, double tau) {
  const auto [lower, upper] = statistics.stepBand;
  const double end = static_cast<double>(statistics.stepNees.size()) * tau;
  Series nees{.label = fmt::format("mean of {} runs", statistics.runs.size()), .color = kEstimateColor};
  const std::size_t stride = 1 + statistics.stepNees.size() / 4000;
  for (std::size_t t = 0; t < statistics.stepNees.size(); t += stride) {
    nees.x.push_back(static_cast<double>(t + 1) * tau);
    nees.y.push_back(statistics.stepNees[t]);
  }
  return {.title = title,
          .xLabel = "time [s]",
          .yLabel = "NEES [1]",
          .legend = Legend::kOutside,
          .series = {nees},
          .horizontalLines = {{.at = 3, .label = "consistent"}},
          .bands = {{.label = "95 %",
                     .x = {0, end},
                     .low = {lower, lower},
                     .high = {upper, upper},
                     .color = kLandmarkColor}}};
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

std::vector<int> filmedSteps(int steps) {
  const int frames = std::min(steps, kMostFrames);
  std::vector<int> filmed;
  for (int i = 0; i < frames; ++i)
    filmed.push_back(frames < 2 ? 0 : static_cast<int>(static_cast<long>(i) * (steps - 1) / (frames - 1)));
  return filmed;
}

void makeFilterFolder(const fs::path& folder) {
  const auto refuse = [&](const std::string& found, const std::string& wanted) {
    throw UsageError({.what = "-o " + harmless(folder.string()), .found = found, .wanted = wanted});
  };
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem || !fs::is_directory(folder)) refuse(problem ? problem.message() : "a file", "a folder");
  if (!std::ofstream(folder / "filter.csv", std::ios::app))
    refuse(std::strerror(errno), "a folder to write to");
  for (const char* name : {"filter.mp4", "filter_sheet.png"}) fs::remove(folder / name, problem);
}

std::string csvOf(const FilterRun& run, double tau) {
  fmt::memory_buffer table;
  const auto out = std::back_inserter(table);
  fmt::format_to(out,
                 "time,x,y,heading,x_estimate,y_estimate,heading_estimate,"
                 "var_x,cov_xy,cov_xh,var_y,cov_yh,var_h,x_reckoned,y_reckoned,heading_reckoned,"
                 "nees,nis,innovations,seen\n");
  for (int t = 0; t < run.steps(); ++t) {
    const auto i = static_cast<std::size_t>(t);
    fmt::format_to(out, "{}", (t + 1) * tau);
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
                                          const FilterStatistics& statistics, std::vector<CarView> views) {
  const double tau = CarOptions().tau;
  std::vector<fs::path> files = {"filter.csv"};
  grading::writeTextFile(options.out / files.back(), csvOf(run, tau));
  const Eigen::Matrix3Xd means = meansOf(run);
  const std::vector<int> steps = filmedSteps(run.steps());
  for (std::size_t i = 0; i < views.size(); ++i)
    complete(views[i], run, means, steps[i], fmt::format("{}, {} s", options.filter, (steps[i] + 1) * tau));
  const std::string title = fmt::format("{}, seed {}", options.filter, run.seed);
  const std::vector<std::pair<const char*, Figure>> figures = {
      {"error_x", errorFigure(run, 0, title, tau)},
      {"error_y", errorFigure(run, 1, title, tau)},
      {"error_heading", errorFigure(run, 2, title, tau)},
      {"nees", neesFigure(statistics, options.filter, tau)},
      {"map", mapFigure(views.back(), run)}};
  for (const auto& [name, figure] : figures) {
    plot((options.out / name).string(), figure);
    files.push_back(fmt::format("{}.png", name));
  }
  if (!options.noFilm) {
    writeFilm(views, (options.out / "filter").string(), {.rate = kRate, .step = tau});
    const bool isVideo = fs::exists(options.out / "filter.mp4");
    files.emplace_back(isVideo ? "filter.mp4" : "filter");
    files.emplace_back("filter_sheet.png");
  }
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(shown(options.out / file));
  return names;
}

}  // namespace rex::cli
