#include "show.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "course/car_pictures.h"
#include "course/car_simulator.h"
#include "course/car_view.h"
#include "estimation/consistency.h"
#include "estimation/ekf_slam.h"
#include "estimation/kalman_filter.h"

using namespace rex;

namespace {

using Poses = std::vector<Eigen::Vector3d>;

const Color kFilter = kEstimateColor, kSmoother = kScanColor, kSoft{0.35f, 0.6f, 0.85f},
            kSoftest{0.75f, 0.35f, 0.6f};

CarOptions optionsOf(const CarSetup& car) {
  CarOptions options;
  options.tau = car.tau;
  options.wheelbase = car.wheelbase;
  options.dynamicsNoise = car.dynamicsNoise;
  options.observationNoise = car.observationNoise;
  options.bearingNoise = car.bearingNoise;
  options.rangeBearing = car.rangeBearing;
  return options;
}

Poses meansOf(const std::vector<Belief>& beliefs) {
  Poses poses;
  for (const Belief& belief : beliefs) poses.emplace_back(belief.mean.head(3));
  return poses;
}

// The ellipse of two entries of a belief, from entry i on.
PlanarGaussian planar(const Belief& belief, Eigen::Index i) {
  return {belief.mean.segment(i, 2), belief.covariance.block(i, i, 2, 2)};
}

void addEllipses(Figure& figure, const std::string& label, const std::vector<Belief>& beliefs,
                 std::size_t every, const Color& color) {
  for (std::size_t t = every; t < beliefs.size(); t += every) {
    const PlanarGaussian xy = planar(beliefs[t], 0);
    figure.ellipses.push_back({t == every ? label : "", xy.mean, xy.covariance, 2, color});
  }
}

Figure overTime(const std::string& title, const std::string& yLabel) {
  Figure figure{.title = title, .xLabel = "time [s]", .yLabel = yLabel};
  figure.width = 900;
  figure.height = 460;
  return figure;
}

Series curve(const std::string& label, const std::vector<double>& y, const Color& color, double size = 1.5,
             bool dashed = false) {
  Series series{.label = label};
  series.y = y;
  series.size = size;
  series.dashed = dashed;
  series.color = color;
  return series;
}

// Two standard deviations of entry i of each belief, to both sides.
Band deviationBand(const std::string& label, const std::vector<Belief>& beliefs, Eigen::Index i,
                   const Color& color) {
  Band band{.label = label};
  for (const Belief& belief : beliefs) {
    band.high.push_back(2 * std::sqrt(belief.covariance(i, i)));
    band.low.push_back(-band.high.back());
  }
  band.color = color;
  return band;
}

std::vector<double> errorsOf(const std::vector<Belief>& beliefs, const Poses& states, Eigen::Index i) {
  std::vector<double> errors;
  for (std::size_t t = 0; t < beliefs.size(); ++t) errors.push_back(beliefs[t].mean[i] - states[t][i]);
  return errors;
}

// The library's smoother, on the same beliefs.
std::vector<Belief> libraryHindsight(const CarSetup& car, const RecordedDrive& drive,
                                     const std::vector<Belief>& run) {
  std::vector<Gaussian> forward;
  std::vector<LinearModel> transitions;
  for (const Belief& belief : run) forward.push_back({belief.mean, belief.covariance});
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    const Eigen::MatrixXd A = stepByState(car, run[t].mean, drive.controls[t]);
    const Eigen::VectorXd next = stepped(car, run[t].mean, drive.controls[t]);
    transitions.push_back({A, next - A * run[t].mean, stepNoise(car)});
  }
  std::vector<Belief> smooth;
  for (const Gaussian& belief : smoothed(forward, transitions))
    smooth.push_back({belief.mean, belief.covariance});
  return smooth;
}

// The squared error relative to the covariance, averaged over runs of a filter that assumes `believed`.
std::vector<double> meanSquaredErrors(const Belief& start, const CarSetup& believed, int runs) {
  constexpr int kSteps = 100;
  std::vector<double> means(kSteps, 0);
  for (int i = 0; i < runs; ++i) {
    const RecordedDrive drive =
        recordDrive(static_cast<std::uint64_t>(i), {}, landmarksAround(3), kSteps, {0.1, 0.2}, 1e3);
    Belief belief = start;
    belief.mean += std::sqrt(0.1) * Rng(static_cast<std::uint64_t>(i)).normalVector(3);
    for (std::size_t t = 0; t < kSteps; ++t) {
      belief = tracked(believed, belief, drive.controls[t], drive.landmarks, allSeen(drive, t));
      const Eigen::VectorXd error = belief.mean - drive.states[t + 1];
      means[t] += error.dot(solveMatrix(belief.covariance, error).col(0)) / runs;
    }
  }
  return means;
}

// The joint beliefs after each step, and which landmark is which in them.
struct Mapping {
  std::vector<Belief> joints{{Eigen::Vector3d::Zero(), 1e-6 * Eigen::Matrix3d::Identity()}};
  std::vector<int> names;
};

CarView viewAt(const RecordedDrive& drive, const Mapping& mapping, std::size_t t) {
  const Belief& joint = mapping.joints[t];
  CarView view;
  view.car = drive.states[t];
  view.estimate = joint.mean.head(3);
  view.landmarks = drive.landmarks;
  view.poseBeliefs = {planar(joint, 0)};
  for (Eigen::Index i = 3; i < joint.mean.size(); i += 2) view.landmarkBeliefs.push_back(planar(joint, i));
  const auto count = static_cast<Eigen::Index>(t) + 1;
  view.paths = {{.name = "true path", .points = pathPoints(drive.states).leftCols(count)},
                {.name = "estimate",
                 .points = pathPoints(meansOf(mapping.joints)).leftCols(count),
                 .color = kEstimateColor}};
  return view;
}

// The standard deviation of each landmark from its first sighting on [m].
Figure deviationsOf(const Mapping& mapping) {
  Figure figure =
      overTime("Standard deviation of each landmark, from its first sighting on", "standard deviation [m]");
  figure.legend = Legend::kNone;
  const Eigen::Index n = mapping.joints.back().mean.size();
  for (Eigen::Index i = 3; i < n; i += 2) {
    Series series{.size = 2};
    for (std::size_t t = 0; t < mapping.joints.size(); ++t) {
      const Eigen::MatrixXd& S = mapping.joints[t].covariance;
      if (S.rows() <= i) continue;
      series.add(static_cast<double>(t), std::sqrt(0.5 * (S(i, i) + S(i + 1, i + 1))));
    }
    figure.series.push_back(series);
  }
  return figure;
}

Figure correlationsOf(const Belief& joint) {
  const Eigen::Index n = joint.mean.size();
  HeatMap map{.xRange = {0, static_cast<double>(n)},
              .yRange = {0, static_cast<double>(n)},
              .values = joint.covariance};
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      map.values(i, k) /= std::sqrt(joint.covariance(i, i) * joint.covariance(k, k));
  Figure figure{.title = "Correlations of car and landmarks at the end",
                .xLabel = "entry of the state [1]",
                .yLabel = "entry of the state [1]",
                .colorLabel = "correlation [1]",
                .equalAxes = true,
                .colorRange = AxisRange{-1, 1}};
  figure.heatMap = map;
  figure.width = figure.height = 640;
  return figure;
}

// Kalman SLAM of a drive whose landmarks have names.
Mapping mapped(const CarSetup& car, const RecordedDrive& drive) {
  Mapping mapping;
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    Belief joint = jointPredicted(car, mapping.joints.back(), drive.controls[t]);
    for (const LandmarkObservation& seen : drive.seen[t]) {
      const auto known = std::find(mapping.names.begin(), mapping.names.end(), seen.landmark);
      if (known == mapping.names.end()) {
        joint = withLandmark(car, joint, seen.y);
        mapping.names.push_back(seen.landmark);
      } else {
        joint = jointCorrected(car, joint, static_cast<int>(known - mapping.names.begin()), seen.y);
      }
    }
    mapping.joints.push_back(joint);
  }
  return mapping;
}

// Resamples the same number of particles, in proportion to their weights.
std::vector<MapParticle> drawn(const std::vector<MapParticle>& particles, Rng& rng) {
  const double share = 1. / static_cast<double>(particles.size());
  std::vector<MapParticle> children;
  double sum = 0, next = rng.uniform() * share;
  for (const MapParticle& particle : particles)
    for (sum += particle.weight; next < sum && children.size() < particles.size(); next += share)
      children.push_back(particle);
  while (children.size() < particles.size()) children.push_back(particles.back());
  for (MapParticle& particle : children) particle.weight = share;
  return children;
}

// What the library's Kalman SLAM estimates.
Poses statesOfTheLibrary(const RecordedDrive& drive) {
  CarOptions options = optionsOf({});
  options.maxRange = drive.range;
  const auto model = CarSimulator::withoutPlaces(0, options);
  const double q = options.dynamicsNoise, w = options.observationNoise;
  EkfSlam slam({Eigen::Vector3d::Zero(), 1e-6 * Eigen::Matrix3d::Identity()},
               {.W = w * w * Eigen::Matrix2d::Identity()});
  Poses states{Eigen::Vector3d::Zero()};
  std::vector<int> names;
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    const Eigen::Vector2d u = drive.controls[t];
    slam.predict(
        {[&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return model.getMeanStateAfterStep(x, u); },
         [&](const Eigen::Vector3d& x) -> Eigen::Matrix3d { return model.getStateJacobian(x, u); },
         q* q* Eigen::Matrix3d::Identity()});
    for (const LandmarkObservation& seen : drive.seen[t]) {
      const auto known = std::find(names.begin(), names.end(), seen.landmark);
      slam.observe(static_cast<int>(known - names.begin()), seen.y);
      if (known == names.end()) names.push_back(seen.landmark);
    }
    states.emplace_back(slam.pose().mean);
  }
  return states;
}

// The last states and the maps of all particles.
Figure particleFigure(const RecordedDrive& drive, const std::vector<MapParticle>& particles) {
  CarView view;
  view.caption = "FastSLAM: 100 particles, each with its map";
  view.car = drive.states.back();
  view.landmarks = drive.landmarks;
  view.paths = {{.name = "true path", .points = pathPoints(drive.states)}};
  view.particles.resize(3, static_cast<Eigen::Index>(particles.size()));
  Series maps{.label = "landmarks in their maps", .style = SeriesStyle::kPoints};
  maps.marker = Marker::kDot;
  maps.size = 0.6;
  maps.color = kDeadReckoningColor;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    view.particles.col(static_cast<Eigen::Index>(k)) = particles[k].x;
    for (const Belief& landmark : particles[k].map) maps.add(landmark.mean[0], landmark.mean[1]);
  }
  Figure figure = carFigure(view);
  if (!maps.x.empty()) figure.series.push_back(maps);
  return figure;
}

// Prints how far J is from finite differences of f.
void compare(const std::string& name, const Eigen::MatrixXd& J, const VectorFunction& f,
             const Eigen::VectorXd& at) {
  const double worst = (J - numericJacobian(f, at)).cwiseAbs().maxCoeff();
  print(name + ": distance from finite differences, which should be 0", worst);
}

}  // namespace

RecordedDrive recordDrive(std::uint64_t seed, const CarSetup& car, const Eigen::MatrixXd& landmarks,
                          int steps, const Eigen::Vector2d& u, double range) {
  RecordedDrive drive{.range = range,
                      .landmarks = landmarks,
                      .controls = {},
                      .states = {Eigen::Vector3d::Zero()},
                      .seen = {}};
  CarOptions options = optionsOf(car);
  options.maxRange = range;
  CarSimulator simulator(seed, static_cast<int>(landmarks.cols()), options);
  simulator.setLandmarks(landmarks);
  for (int t = 0; t < steps; ++t) {
    simulator.step(u);
    drive.controls.push_back(u);
    drive.states.push_back(simulator.getState());
    const Eigen::VectorXd y = simulator.getRealNoisyObservation();
    drive.seen.emplace_back();
    for (const int i : simulator.getVisibleLandmarks()) drive.seen.back().push_back({i, y.segment(2 * i, 2)});
  }
  return drive;
}

Eigen::VectorXd allSeen(const RecordedDrive& drive, std::size_t t) {
  Eigen::VectorXd y(drive.landmarks.size());
  for (const LandmarkObservation& one : drive.seen[t]) y.segment(2 * one.landmark, 2) = one.y;
  return y;
}

Eigen::MatrixXd landmarksAround(int count) {
  Eigen::MatrixXd landmarks(2, count);
  const double radius = 2 / std::tan(0.2);
  for (int i = 0; i < count; ++i) {
    const double angle = 6.2832 * (i + 0.35) / count - 1.57, r = radius + (i % 2 == 0 ? 4.5 : -3.5);
    landmarks.col(i) << r * std::cos(angle), radius + r * std::sin(angle);
  }
  return landmarks;
}

void showDerivatives() {
  const CarSetup car, polar{.rangeBearing = true};
  const Eigen::Vector3d x(2, 1, 0.7);
  const Eigen::Vector2d u(0.5, 0.2), l(5, -3);
  compare(
      "A", stepByState(car, x, u), [&](const Eigen::VectorXd& at) { return stepped(car, at, u); }, x);
  compare(
      "B", stepByControl(car, x, u), [&](const Eigen::VectorXd& at) { return stepped(car, x, at); }, u);
  for (const CarSetup& by : {car, polar}) {
    const std::string sensor = by.rangeBearing ? ", distance and bearing" : ", ahead and left";
    compare(
        "C" + sensor, viewByState(by, x, l), [&](const Eigen::VectorXd& at) { return view(by, at, l); }, x);
    compare(
        "D" + sensor, viewByLandmark(by, x, l), [&](const Eigen::VectorXd& at) { return view(by, x, at); },
        l);
  }
}

void showSteps(const CarSetup& car, const RecordedDrive& drive) {
  Poses states{Eigen::Vector3d::Zero()};
  for (const Eigen::Vector2d& u : drive.controls) states.push_back(stepped(car, states.back(), u));
  CarView overview;
  overview.landmarks = drive.landmarks;
  overview.paths = {{.name = "true path", .points = pathPoints(drive.states)},
                    {"without noise", pathPoints(states), kEstimateColor, true}};
  Figure above = carFigure(overview);
  above.title = "Where the controls lead without noise, with your step";
  plot("steps", above);
}

void showTracking(const RecordedDrive& drive, const std::vector<Belief>& run,
                  const std::vector<Belief>& blind) {
  CarView overview;
  overview.landmarks = drive.landmarks;
  overview.paths = {{.name = "true path", .points = pathPoints(drive.states)},
                    {.name = "filter", .points = pathPoints(meansOf(run)), .color = kFilter},
                    {"without observations", pathPoints(meansOf(blind)), kDeadReckoningColor, true}};
  Figure above = carFigure(overview);
  above.title = "A circle among two landmarks";
  addEllipses(above, "filter, 2 sigma", run, 6, kFilter);
  addEllipses(above, "without observations", blind, 20, kDeadReckoningColor);
  plot("tracking", above);
}

void showConsistency(const Belief& start) {
  constexpr int kRuns = 50;
  CarSetup proud, timid;
  proud.dynamicsNoise /= 5;
  timid.dynamicsNoise = std::sqrt(timid.dynamicsNoise);
  timid.observationNoise = std::sqrt(timid.observationNoise);
  const ConsistencyBand band = consistencyBand(kRuns, 3);
  Figure figure =
      overTime("Is the filter consistent? Mean of 50 runs", "squared error relative to the covariance [1]");
  figure.logY = true;
  figure.bands = {{.label = "95 %",
                   .x = {0, 99},
                   .low = {band.lower, band.lower},
                   .high = {band.upper, band.upper},
                   .color = kSoft}};
  figure.series = {
      curve("a fifth of the noise assumed", meanSquaredErrors(start, proud, kRuns), kDeadReckoningColor),
      curve("yours", meanSquaredErrors(start, {}, kRuns), kFilter, 2.5),
      curve("sigma instead of its square", meanSquaredErrors(start, timid, kRuns), kLandmarkColor)};
  plot("consistency", figure);
}

void showSmoothing(const RecordedDrive& drive, const std::vector<Belief>& run,
                   const std::vector<Belief>& smooth) {
  Figure errors = overTime("Error of the estimate along x, and its predicted range", "error in x [m]");
  errors.bands = {deviationBand("filter, 2 sigma", run, 0, kSoft),
                  deviationBand("smoother, 2 sigma", smooth, 0, kSoftest)};
  errors.series = {curve("filter", errorsOf(run, drive.states, 0), kFilter),
                   curve("smoother", errorsOf(smooth, drive.states, 0), kSmoother, 2.5),
                   curve("smoother of the library",
                         errorsOf(libraryHindsight({}, drive, run), drive.states, 0), kTruthColor, 1, true)};
  plot("smoothing", errors);
}

void showMap(const RecordedDrive& drive) {
  const CarSetup car;
  const Mapping mapping = mapped(car, drive);
  std::vector<CarView> views;
  for (std::size_t t = 0; t < mapping.joints.size(); ++t) {
    views.push_back(viewAt(drive, mapping, t));
    views.back().caption = "Kalman SLAM: " + std::to_string(t) + " s";
  }
  writeFilm(carFilm(views), "slam", {.view = kFromAbove, .speed = 10});
  for (const std::size_t t : {std::size_t{45}, mapping.joints.size() - 1}) {
    views[t].caption = "Car, map and beliefs after " + std::to_string(t) + " s";
    plot(t == 45 ? "map_before" : "map_after", carFigure(views[t]));
  }
  plot("deviations", deviationsOf(mapping));
  plot("correlations", correlationsOf(mapping.joints.back()));

  const Poses states = statesOfTheLibrary(drive);
  std::vector<double> yours, theirs;
  for (std::size_t t = 0; t < states.size(); ++t) {
    yours.push_back((mapping.joints[t].mean.head(2) - drive.states[t].head(2)).norm());
    theirs.push_back((states[t] - drive.states[t]).head(2).norm());
  }
  Figure figure = overTime("Distance of the estimate from the car", "position error [m]");
  figure.series = {curve("yours", yours, kFilter, 3), curve("the library's", theirs, kTruthColor, 1, true)};
  plot("slam_error", figure);
}

void showNames(const RecordedDrive& drive) {
  const CarSetup car;
  Belief joint = Mapping().joints[0];
  std::vector<double> inMap, seenSoFar;
  std::vector<bool> wasSeen(static_cast<std::size_t>(drive.landmarks.cols()));
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    joint = jointPredicted(car, joint, drive.controls[t]);
    std::vector<Eigen::Vector2d> ys;
    for (const LandmarkObservation& seen : drive.seen[t]) {
      ys.push_back(seen.y);
      wasSeen[static_cast<std::size_t>(seen.landmark)] = true;
    }
    const std::vector<int> names = assigned(car, joint, ys);
    for (std::size_t j = 0; j < ys.size(); ++j) {
      if (names[j] >= 0) joint = jointCorrected(car, joint, names[j], ys[j]);
      if (names[j] == kNewLandmark) joint = withLandmark(car, joint, ys[j]);
    }
    inMap.push_back(static_cast<double>((joint.mean.size() - 3) / 2));
    seenSoFar.push_back(static_cast<double>(std::count(wasSeen.begin(), wasSeen.end(), true)));
  }
  Figure figure = overTime("Landmarks without names", "number of landmarks [1]");
  figure.yRange = AxisRange{0, 10};
  figure.series = {curve("seen so far", seenSoFar, kSoft, 5), curve("in the map", inMap, kFilter, 1.5)};
  plot("names", figure);
}

void showParticles(const RecordedDrive& drive) {
  const CarSetup car;
  constexpr std::size_t kParticles = 100;
  Rng rng(6);
  std::vector<int> names;
  std::vector<MapParticle> cloud(kParticles, {Eigen::Vector3d::Zero(), 1. / kParticles, {}});
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    for (MapParticle& one : cloud)
      one.x = stepped(car, one.x, drive.controls[t]) + car.dynamicsNoise * rng.normalVector(3);
    std::vector<LandmarkObservation> seen;
    for (const LandmarkObservation& named : drive.seen[t]) {
      const auto known = std::find(names.begin(), names.end(), named.landmark);
      seen.push_back({static_cast<int>(known - names.begin()), named.y});
      if (known == names.end()) names.push_back(named.landmark);
    }
    cloud = weighed(car, cloud, seen);
    cloud = drawn(cloud, rng);
  }
  plot("particles", particleFigure(drive, cloud));
}
