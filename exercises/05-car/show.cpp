#include "show.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "course/car_pictures.h"
#include "course/car_simulator.h"
#include "course/car_view.h"
#include "estimation/particle_filter.h"

using namespace rex;

namespace {

constexpr int kSteps = 300;

std::vector<double> errorsOf(const Eigen::MatrixXd& means, const Eigen::MatrixXd& truth) {
  std::vector<double> errors;
  for (int t = 0; t < kSteps; ++t) errors.push_back((means.col(t).head(2) - truth.col(t).head(2)).norm());
  return errors;
}

// The results of meanPose, a column for each step.
Eigen::MatrixXd meansOf(const std::vector<Cloud>& clouds) {
  Eigen::MatrixXd means(3, kSteps);
  for (int t = 0; t < kSteps; ++t) means.col(t) = meanPose(clouds[static_cast<std::size_t>(t)]);
  return means;
}

// The means of x and y, for particles of equal weight.
Eigen::MatrixXd plainMeans(const std::vector<Cloud>& clouds) {
  Eigen::MatrixXd means(2, kSteps);
  for (int t = 0; t < kSteps; ++t)
    means.col(t) = clouds[static_cast<std::size_t>(t)].states.topRows(2).rowwise().mean();
  return means;
}

std::vector<Cloud> filtered(const DriveLog& log, const CarWorld& world) {
  Rng rng(5);
  std::vector<Cloud> clouds = {{Eigen::MatrixXd::Zero(3, 100), Eigen::VectorXd::Constant(100, 0.01)}};
  for (std::size_t i = 0; i < log.controls.size(); ++i)
    clouds.push_back(filterStep(clouds.back(), log.controls[i], log.observations[i], world, rng));
  clouds.erase(clouds.begin());
  return clouds;
}

Eigen::MatrixXd meansOfTheLibrary(const DriveLog& log, const CarWorld& world) {
  const CarSimulator map(world.landmarks, CarOptions{});
  const NonlinearModel transition{
      .g = [&](const Eigen::VectorXd& x) { return map.getMeanStateAfterStep(x, log.controls[0]); },
      .W = std::pow(world.dynamicsNoise, 2) * Eigen::Matrix3d::Identity()};
  const NonlinearModel observation{
      .g = [&](const Eigen::VectorXd& x) { return map.getMeanObservationAtState(x); },
      .W = std::pow(world.observationNoise, 2) * Eigen::Matrix4d::Identity()};
  Rng rng(7);
  ParticleFilter library({Eigen::MatrixXd::Zero(3, 100), Eigen::VectorXd::Constant(100, 0.01)});
  Eigen::MatrixXd means(3, kSteps);
  for (int t = 0; t < kSteps; ++t) {
    const LogLikelihood weigh =
        observationWeights(observation, log.observations[static_cast<std::size_t>(t)]);
    std::ignore = library.step(motionProposal(transition), weigh, rng);
    means.col(t) = sampleMoments(library.particles()).mean;
  }
  return means;
}

// The clouds of every 60th step on one map.
void plotMap(const std::string& name, const std::string& title, const std::vector<Cloud>& clouds,
             const std::vector<DrawnPath>& paths, const CarWorld& world) {
  Eigen::Matrix3Xd particles(3, 500);
  std::vector<double> steps;
  for (int k = 0; k < 5; ++k) {
    particles.middleCols(100 * k, 100) = clouds[static_cast<std::size_t>(60 * k + 59)].states;
    steps.insert(steps.end(), 100, 60 * k + 60);
  }
  Figure map =
      carFigure({.landmarks = world.landmarks, .particles = particles, .paths = paths, .caption = title});
  for (Series& series : map.series)
    if (series.label == "particles") series.values = steps;
  map.colorLabel = "step";
  map.colorRange = AxisRange{0, kSteps};
  map.legend = Legend::kBottomLeft;
  map.xRange = AxisRange{-14, 20};
  map.yRange = AxisRange{-3, 25};
  plot(name, map);
}

void film(const std::string& name, const std::string& caption, const std::vector<Cloud>& clouds,
          const std::vector<DrawnPath>& paths, const CarWorld& world, const Eigen::MatrixXd& truth) {
  std::vector<CarView> views;
  for (int t = 0; t < kSteps; t += 3) {
    CarView view{.car = truth.col(t),
                 .landmarks = world.landmarks,
                 .particles = clouds[static_cast<std::size_t>(t)].states,
                 .paths = paths,
                 .caption = caption + ", step " + std::to_string(t)};
    for (DrawnPath& path : view.paths) path.points.conservativeResize(2, t + 1);
    views.push_back(view);
  }
  writeFilm(carFilm(views, 3), name, {.view = kFromAbove, .speed = 30});
}

}  // namespace

Corridor corridorOfFourDoors() {
  Corridor corridor{.doors = Eigen::VectorXd::Zero(20)};
  for (const int door : {2, 5, 6, 13}) corridor.doors[door] = 1;
  return corridor;
}

Walk recordWalk(const Corridor& corridor) {
  Rng rng(2);
  Walk walk{.ways = std::vector<int>(11, 1), .seen = {}, .cells = {}};
  int cell = 2;
  for (std::size_t t = 0; t <= walk.ways.size(); ++t) {
    walk.cells.push_back(cell);
    walk.seen.push_back(rng.uniform() < (corridor.doors[cell] > 0 ? 1 - corridor.misses : corridor.alarms));
    const double chance = rng.uniform();
    cell += chance < corridor.slips ? 0 : chance < 1 - corridor.leaps ? 1 : 2;
  }
  return walk;
}

void showCorridor(const std::vector<Eigen::VectorXd>& beliefs, const std::vector<Eigen::VectorXd>& hindsight,
                  const Walk& walk, const Corridor& corridor) {
  const auto listed = [](const Eigen::VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  Figure cells{.title = "Where is the robot?", .xLabel = "cell", .yLabel = "probability"};
  for (const std::size_t t : {std::size_t{0}, std::size_t{3}, beliefs.size() - 1})
    cells.series.push_back(
        {.label = "step " + std::to_string(t) + ", robot in cell " + std::to_string(walk.cells[t]),
         .y = listed(beliefs[t]),
         .style = SeriesStyle::kLinesPoints});
  cells.series.push_back({.label = "doors",
                          .y = listed(0.1 * corridor.doors),
                          .dashed = true,
                          .color = Color{0.55f, 0.55f, 0.55f}});
  plot("corridor", cells);
  Series filter{.label = "observations so far", .y = {}}, all{.label = "all observations", .y = {}};
  for (std::size_t t = 0; t < beliefs.size() && t < hindsight.size(); ++t) {
    filter.y.push_back(beliefs[t][walk.cells[t]]);
    all.y.push_back(hindsight[t][walk.cells[t]]);
  }
  plot("hindsight", {.title = "Probability of the cell in which the robot is",
                     .xLabel = "step",
                     .yLabel = "probability",
                     .series = {filter, all}});
}

RecordedDrive recordDrive(const CarWorld& world, const Eigen::Vector2d& u) {
  CarSimulator car(9, static_cast<int>(world.landmarks.cols()),
                   {.observationNoise = world.observationNoise,
                    .rangeBearing = world.rangeBearing,
                    .bearingNoise = world.bearingNoise});
  car.setLandmarks(world.landmarks);
  RecordedDrive drive;
  drive.truth.resize(3, kSteps);
  for (int t = 0; t < kSteps; ++t) {
    car.step(u);
    drive.truth.col(t) = car.getState();
    drive.log.controls.push_back(u);
    drive.log.observations.push_back(car.getRealNoisyObservation());
  }
  return drive;
}

void showDeadReckoning(const std::vector<Cloud>& blind, const RecordedDrive& drive, const CarWorld& world) {
  const std::vector<DrawnPath> paths = {
      {.name = "car", .points = drive.truth.topRows(2), .color = kTruthColor},
      {.name = "mean of the particles", .points = plainMeans(blind), .color = kDeadReckoningColor}};
  plotMap("dead_reckoning", "Dead reckoning: the particles of every 60th step", blind, paths, world);
  film("dead_reckoning", "dead reckoning", blind, paths, world, drive.truth);
}

void showLikelihood(int step, const RecordedDrive& drive, const CarWorld& world) {
  const Eigen::Vector3d car = drive.truth.col(step);
  const Eigen::VectorXd& y = drive.log.observations[static_cast<std::size_t>(step)];
  // One particle in the middle of each cell, with the heading of the car.
  constexpr int kCells = 160;
  const double size = 0.05, low = -0.5 * size * kCells;
  Eigen::MatrixXd particles(3, kCells * kCells);
  for (int i = 0; i < particles.cols(); ++i) {
    const Eigen::Vector3d offset(i / kCells + 0.5, i % kCells + 0.5, 0);
    particles.col(i) = car + size * offset + Eigen::Vector3d(low, low, 0);
  }
  const Eigen::VectorXd weights = weightsOf(logLikelihoods(particles, y, world));
  const double most = std::max(weights.maxCoeff(), 1e-300);
  plot("likelihood",
       planeFigure({.title = "Where the car could be, given what it sees in step " + std::to_string(step),
                    .colorLabel = "weight / largest weight",
                    .colorRange = AxisRange{0, 1},
                    .series = {dots(
                        car, {.label = "car", .marker = Marker::kCross, .size = 2, .color = kTruthColor})},
                    .heatMap = HeatMap{.xRange = {car[0] + low, car[0] - low},
                                       .yRange = {car[1] + low, car[1] - low},
                                       .values = weights.reshaped(kCells, kCells) / most}}));
}

void showChildren(const Eigen::VectorXd& weights, int count) {
  Rng rng(2);
  const int draws = 1000;
  // Rows: the weights, the mean number of children, and the least number of children.
  Eigen::MatrixXd table(3, weights.size());
  table << weights.transpose(), Eigen::MatrixXd::Zero(1, weights.size()),
      Eigen::MatrixXd::Constant(1, weights.size(), count);
  for (int i = 0; i < draws; ++i) {
    Eigen::RowVectorXd children = Eigen::RowVectorXd::Zero(weights.size());
    for (const int parent : resampledParents(weights, count, rng)) children[parent] += 1;
    table.row(1) += children / draws;
    table.row(2) = table.row(2).cwiseMin(children);
  }
  print("weights; " + std::to_string(count) +
            " times as many children on average; at least the integer part of that",
        table);
  print("effective size of these weights", effectiveSize(weights));
}

void showFilter(const std::vector<Cloud>& clouds, const std::vector<Cloud>& blind, const RecordedDrive& drive,
                const CarWorld& world) {
  const Eigen::MatrixXd reckoned = plainMeans(blind), means = meansOf(clouds);
  const DrawnPath car{.name = "car", .points = drive.truth.topRows(2), .color = kTruthColor};
  plotMap("filter", "Particle filter: the particles of every 60th step", clouds,
          {car, {.name = "mean of the particles", .points = means.topRows(2), .color = kEstimateColor}},
          world);
  film("filter", "particle filter", clouds,
       {car, {.name = "dead reckoning", .points = reckoned, .color = kDeadReckoningColor}}, world,
       drive.truth);
  const auto errors = [&](const std::string& label, const Eigen::MatrixXd& of, const Color& color) -> Series {
    return {.label = label, .y = errorsOf(of, drive.truth), .color = color};
  };
  Figure figure{.title = "Distance of the mean of the particles from the car",
                .xLabel = "step",
                .yLabel = "position error [m]",
                .series = {errors("dead reckoning", reckoned, kDeadReckoningColor),
                           errors("your filter", means, kEstimateColor),
                           errors("the library's filter", meansOfTheLibrary(drive.log, world), kTruthColor)}};
  figure.series[2].dashed = true;
  plot("error", figure);
}

void showAssumptions(const RecordedDrive& drive, const CarWorld& world) {
  Figure errors{
      .title = "The filter with a wrong assumed noise", .xLabel = "step", .yLabel = "position error [m]"};
  Figure sizes{.title = "How many of 100 particles count",
               .xLabel = "step",
               .yLabel = "effective size",
               .logY = true,
               .legend = Legend::kOutside};
  Figure weights{.title = "Weights, sorted in each step, on average over all steps",
                 .xLabel = "rank of the particle",
                 .yLabel = "weight",
                 .logY = true,
                 .yRange = AxisRange{1e-8, 2}};
  for (const double factor : {10., 1., 0.1}) {
    CarWorld guessed = world;
    guessed.observationNoise *= factor;
    const std::string label = factor > 1 ? "10 sigma" : factor < 1 ? "sigma / 10" : "sigma";
    const std::vector<Cloud> clouds = filtered(drive.log, guessed);
    std::vector<double> size, sorted(100, 1e-9);
    for (const Cloud& cloud : clouds) {
      size.push_back(effectiveSize(cloud.weights));
      Eigen::VectorXd ordered = cloud.weights;
      std::sort(ordered.begin(), ordered.end(), std::greater<>());
      for (Eigen::Index i = 0; i < std::min<Eigen::Index>(100, ordered.size()); ++i)
        sorted[static_cast<std::size_t>(i)] += ordered[i] / kSteps;
    }
    errors.series.push_back({.label = label, .y = errorsOf(meansOf(clouds), drive.truth)});
    sizes.series.push_back({.label = label, .y = size});
    weights.series.push_back({.label = label, .y = sorted, .style = SeriesStyle::kLinesPoints, .size = 0.7});
  }
  plot("assumed", errors);
  plot("effective_size", sizes);
  plot("weights", weights);
}

void showBearings(const RecordedDrive& drive, const CarWorld& world) {
  Rng rng(3);
  Cloud cloud{Eigen::MatrixXd::Zero(3, 2000), Eigen::VectorXd::Constant(2000, 1. / 2000)};
  for (auto x : cloud.states.colwise())
    x += Eigen::Vector3d(rng.uniform(-2, 2), rng.uniform(-2, 2),
                         rng.uniform(-std::numbers::pi, std::numbers::pi));
  std::vector<CarView> views;
  for (int t = 0; t < 12; ++t) {
    const auto i = static_cast<std::size_t>(t);
    views.push_back({.car = t == 0 ? drive.log.start : Eigen::Vector3d(drive.truth.col(t - 1)),
                     .estimate = meanPose(cloud),
                     .landmarks = world.landmarks,
                     .particles = cloud.states,
                     .weights = cloud.weights,
                     .caption = "distances and bearings, step " + std::to_string(t)});
    cloud = filterStep(cloud, drive.log.controls[i], drive.log.observations[i], world, rng);
  }
  writeFilm(carFilm(views), "bearings", {.view = kFromAbove, .speed = 2});
}
