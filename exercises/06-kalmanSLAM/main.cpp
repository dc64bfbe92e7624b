#include <algorithm>
#include <cmath>
#include <numbers>

#include "drives.h"
#include "estimation/consistency.h"
#include "estimation/ekf_slam.h"
#include "estimation/smoother.h"
#include "exercise.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

Eigen::Vector3d stepped(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  // TODO: slide 4:48, for a step of tau seconds.
  notUsedYet(car, u);
  return x;
}

Eigen::MatrixXd stepByState(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3, 3);
  // TODO: what does a slightly different heading change?
  notUsedYet(car, x, u);
  return A;
}

Eigen::MatrixXd stepByControl(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3, 2);
  // TODO: 12.9.2 a.
  notUsedYet(car, x, u);
  return B;
}

Eigen::MatrixXd stepNoise(const CarSetup& car) {
  // TODO: the covariance of three independent numbers with that standard deviation.
  notUsedYet(car);
  return Eigen::MatrixXd::Zero(3, 3);
}

Eigen::Vector2d view(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  // TODO: l in the frame of the car; and if the car has the other sensor?
  notUsedYet(car, x, l);
  return Eigen::Vector2d::Zero();
}

Eigen::MatrixXd viewByState(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2, 3);
  // TODO: if the car moves, a landmark moves the other way; and if it turns?
  notUsedYet(car, x, l);
  return C;
}

Eigen::MatrixXd viewByLandmark(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(2, 2);
  // TODO: two columns of viewByState() are nearly this.
  notUsedYet(car, x, l);
  return D;
}

Eigen::MatrixXd viewNoise(const CarSetup& car) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(2, 2);
  // TODO: of both sensors.
  notUsedYet(car);
  return W;
}

Eigen::Vector2d viewGap(const CarSetup& car, const Eigen::Vector2d& y, const Eigen::Vector2d& expected) {
  Eigen::Vector2d gap = y - expected;
  // TODO: how far is it from a bearing of 3.1 to one of -3.1?
  notUsedYet(car);
  return gap;
}

Belief predicted(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u) {
  // TODO: the third line of the derivation on 7:27, with f(s, u) in place of A s + a.
  notUsedYet(car, u);
  return belief;
}

Belief corrected(const Belief& belief, const Eigen::VectorXd& gap, const Eigen::MatrixXd& C,
                 const Eigen::MatrixXd& W) {
  // TODO: the last lines of 7:27. What is K there, and what is y - C s - c here?
  notUsedYet(gap, C, W);
  return belief;
}

Belief tracked(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u,
               const Eigen::MatrixXd& landmarks, const Eigen::VectorXd& y) {
  // TODO: predict, stack the models of all landmarks, correct.
  notUsedYet(car, u, landmarks, y);
  return belief;
}

std::vector<Belief> hindsight(const CarSetup& car, const std::vector<Belief>& filtered,
                              const std::vector<Eigen::Vector2d>& controls) {
  std::vector<Belief> smooth = filtered;
  // TODO: from the end to the start. How are x(t) and x(t + 1) correlated before x(t + 1) is seen?
  notUsedYet(car, controls);
  return smooth;
}

Belief jointPredicted(const CarSetup& car, const Belief& joint, const Eigen::Vector2d& u) {
  Belief moved = joint;
  // TODO: what are f, A and Q of the whole state, in blocks?
  notUsedYet(car, u);
  return moved;
}

Belief jointCorrected(const CarSetup& car, const Belief& joint, int i, const Eigen::Vector2d& y) {
  // TODO: which columns of the Jacobian of a sighting are not zero?
  notUsedYet(car, i, y);
  return joint;
}

Belief withLandmark(const CarSetup& car, const Belief& joint, const Eigen::Vector2d& y) {
  const Eigen::Index n = joint.mean.size();
  Belief larger{Eigen::VectorXd::Zero(n + 2), Eigen::MatrixXd::Identity(n + 2, n + 2)};
  larger.mean.head(n) = joint.mean;
  larger.covariance.topLeftCorner(n, n) = joint.covariance;
  // TODO: l as a function of x and y, its two derivatives, and with them three blocks of the covariance.
  notUsedYet(car, y);
  return larger;
}

std::vector<int> assigned(const CarSetup& car, const Belief& joint, const std::vector<Eigen::Vector2d>& ys) {
  std::vector<int> names(ys.size(), kUnclear);
  // TODO: how far is each y from what each landmark would look like, in terms of its covariance?
  notUsedYet(car, joint);
  return names;
}

std::vector<MapParticle> weighed(const CarSetup& car, const std::vector<MapParticle>& particles,
                                 const std::vector<Sighting>& sightings) {
  std::vector<MapParticle> after = particles;
  // TODO: for each landmark of each particle a filter of two numbers, and weights from what it expects.
  notUsedYet(car, sightings);
  return after;
}

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

const Color kFilter = kEstimateColor, kSmoother = kScanColor, kSoft{0.35f, 0.6f, 0.85f},
            kSoftest{0.75f, 0.35f, 0.6f};
const Belief kStart{Eigen::Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()};

std::vector<Belief> filtered(const CarSetup& car, const Recorded& drive) {
  std::vector<Belief> run{kStart};
  for (std::size_t t = 0; t < drive.controls.size(); ++t)
    run.push_back(tracked(car, run.back(), drive.controls[t], drive.landmarks, stacked(drive, t)));
  return run;
}

void showTracking(const Library& library) {
  const CarSetup car;
  Eigen::Matrix2Xd landmarks(2, 2);
  landmarks << 9, -6, 4, 16;
  const Recorded drive = library.drive(5, car, landmarks, 120, {0.5, 0.2}, kAnywhere);
  const std::vector<Belief> run = filtered(car, drive), smooth = hindsight(car, run, drive.controls);
  std::vector<Belief> blind{kStart};
  for (const Eigen::Vector2d& u : drive.controls) blind.push_back(predicted(car, blind.back(), u));

  CarView view;
  view.landmarks = landmarks;
  view.ways = {wayOf("true way", drive.states, kTruthColor), wayOf("filter", meansOf(run), kFilter),
               wayOf("without seeing", meansOf(blind), kDeadReckoningColor, true)};
  Figure above = figureOf(view);
  above.title = "A circle among two landmarks";
  addEllipses(above, "filter, 2 sigma", run, 6, kFilter);
  addEllipses(above, "without seeing", blind, 20, kDeadReckoningColor);
  plot("tracking", above);

  Figure errors = overTime("Error of the estimate along x, and what it is said to be", "error in x [m]");
  errors.bands = {deviationBand("filter, 2 sigma", run, 0, kSoft),
                  deviationBand("smoother, 2 sigma", smooth, 0, kSoftest)};
  errors.series = {
      curve("filter", errorsOf(run, drive.states, 0), kFilter),
      curve("smoother", errorsOf(smooth, drive.states, 0), kSmoother, 2.5),
      curve("smoother of the library", errorsOf(libraryHindsight(library, car, drive, run), drive.states, 0),
            kTruthColor, 1, true)};
  plot("smoothing", errors);
}

// The squared error in terms of the covariance, averaged over runs of a filter that believes in `believed`.
std::vector<double> meanSquaredErrors(const Library& library, const CarSetup& believed, int runs) {
  constexpr int kSteps = 100;
  std::vector<double> means(kSteps, 0);
  for (int i = 0; i < runs; ++i) {
    const Recorded drive =
        library.drive(static_cast<std::uint64_t>(i), {}, places(3), kSteps, {0.1, 0.2}, kAnywhere);
    Belief belief = kStart;
    belief.mean += std::sqrt(0.1) * Rng(static_cast<std::uint64_t>(i)).normalVector(3);
    for (std::size_t t = 0; t < kSteps; ++t) {
      belief = tracked(believed, belief, drive.controls[t], drive.landmarks, stacked(drive, t));
      const Eigen::VectorXd error = belief.mean - drive.states[t + 1];
      means[t] += error.dot(solveMatrix(belief.covariance, error).col(0)) / runs;
    }
  }
  return means;
}

void showConsistency(const Library& library) {
  constexpr int kRuns = 50;
  CarSetup proud, timid;
  proud.dynamicsNoise /= 5;
  timid.dynamicsNoise = std::sqrt(timid.dynamicsNoise);
  timid.observationNoise = std::sqrt(timid.observationNoise);
  const ConsistencyBand band = consistencyBand(kRuns, 3);
  Figure figure =
      overTime("Is the filter as wrong as it says? Mean of 50 runs", "squared error by covariance [1]");
  figure.logY = true;
  figure.bands = {{.label = "95 %",
                   .x = {0, 99},
                   .low = {band.lower, band.lower},
                   .high = {band.upper, band.upper},
                   .color = kSoft}};
  figure.series = {
      curve("a fifth of the noise believed", meanSquaredErrors(library, proud, kRuns), kDeadReckoningColor),
      curve("yours", meanSquaredErrors(library, {}, kRuns), kFilter, 2.5),
      curve("sigma where its square belongs", meanSquaredErrors(library, timid, kRuns), kLandmarkColor)};
  plot("consistency", figure);
}

void showMap(const Library& library) {
  const CarSetup car;
  const Recorded drive = library.drive(11, car, places(8), 90, {1, 0.2}, 9);
  const Mapping mapping = mapped(car, drive);
  std::vector<CarView> views;
  for (std::size_t t = 0; t < mapping.joints.size(); ++t) {
    views.push_back(viewAt(drive, mapping, t));
    views.back().caption = "Kalman SLAM: " + std::to_string(t) + " s";
  }
  writeFilm(views, "slam", {.rate = 10});
  for (const std::size_t t : {std::size_t{45}, mapping.joints.size() - 1}) {
    views[t].caption = "Car, map and beliefs after " + std::to_string(t) + " s";
    plot(t == 45 ? "map_before" : "map_after", figureOf(views[t]));
  }
  plot("deviations", deviationsOf(mapping));
  plot("correlations", correlationsOf(mapping.joints.back()));

  const Poses states = library.slam(drive);
  std::vector<double> yours, theirs;
  for (std::size_t t = 0; t < states.size(); ++t) {
    yours.push_back((mapping.joints[t].mean.head(2) - drive.states[t].head(2)).norm());
    theirs.push_back((states[t] - drive.states[t]).head(2).norm());
  }
  Figure figure = overTime("How far the estimate is from the car", "position error [m]");
  figure.series = {curve("yours", yours, kFilter, 3), curve("the library's", theirs, kTruthColor, 1, true)};
  plot("slam_error", figure);
}

void showNames(const Library& library) {
  const CarSetup car;
  const Recorded drive = library.drive(3, car, places(7), 80, {1, 0.2}, 14);
  Belief joint = Mapping().joints[0];
  std::vector<double> inMap, seenSoFar;
  std::vector<bool> wasSeen(7);
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    joint = jointPredicted(car, joint, drive.controls[t]);
    std::vector<Eigen::Vector2d> ys;
    for (const Sighting& seen : drive.seen[t]) {
      ys.push_back(seen.y);
      wasSeen[static_cast<std::size_t>(seen.landmark)] = true;
    }
    const std::vector<int> names = assigned(car, joint, ys);
    for (std::size_t k = 0; k < ys.size(); ++k) {
      if (names[k] >= 0) joint = jointCorrected(car, joint, names[k], ys[k]);
      if (names[k] == kNewLandmark) joint = withLandmark(car, joint, ys[k]);
    }
    inMap.push_back(static_cast<double>((joint.mean.size() - 3) / 2));
    seenSoFar.push_back(static_cast<double>(std::count(wasSeen.begin(), wasSeen.end(), true)));
  }
  Figure figure = overTime("Landmarks without names", "number of landmarks [1]");
  figure.yRange = AxisRange{0, 10};
  figure.series = {curve("seen so far", seenSoFar, kSoft, 5), curve("in the map", inMap, kFilter, 1.5)};
  plot("names", figure);
}

void showParticles(const Library& library) {
  const CarSetup car;
  const Recorded drive = library.drive(4, car, places(6), 45, {1, 0.2}, 12);
  constexpr std::size_t kParticles = 100;
  Rng rng(6);
  std::vector<int> names;
  std::vector<MapParticle> particles(kParticles, {Eigen::Vector3d::Zero(), 1. / kParticles, {}});
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    for (MapParticle& particle : particles)
      particle.x = stepped(car, particle.x, drive.controls[t]) + car.dynamicsNoise * rng.normalVector(3);
    std::vector<Sighting> seen;
    for (const Sighting& one : drive.seen[t]) {
      const auto known = std::find(names.begin(), names.end(), one.landmark);
      seen.push_back({static_cast<int>(known - names.begin()), one.y});
      if (known == names.end()) names.push_back(one.landmark);
    }
    particles = weighed(car, particles, seen);
    particles = drawn(particles, rng);
  }
  plot("particles", particleFigure(drive, particles));
}

}  // namespace

int main() {
  Library library;
  library.drive = [](std::uint64_t seed, const CarSetup& car, const Eigen::Matrix2Xd& landmarks, int steps,
                     const Eigen::Vector2d& u, double range) {
    Recorded drive{optionsOf(car), landmarks, {}, {Eigen::Vector3d::Zero()}, {}};
    drive.options.maxRange = range;
    CarSimulator simulator(seed, static_cast<int>(landmarks.cols()), drive.options);
    simulator.setLandmarks(landmarks);
    for (int t = 0; t < steps; ++t) {
      simulator.step(u);
      drive.controls.push_back(u);
      drive.states.push_back(simulator.getState());
      const Eigen::VectorXd y = simulator.getRealNoisyObservation();
      drive.seen.emplace_back();
      for (const int i : simulator.getVisibleLandmarks())
        drive.seen.back().push_back({i, y.segment(2 * i, 2)});
    }
    return drive;
  };
  library.smooth = [](const std::vector<Gaussian>& filtered, const std::vector<LinearModel>& transitions) {
    return smoothed(filtered, transitions);
  };
  library.slam = [](const Recorded& drive) {
    const auto model = CarSimulator::withoutPlaces(0, drive.options);
    const double q = drive.options.dynamicsNoise, w = drive.options.observationNoise;
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
      for (const Sighting& seen : drive.seen[t]) {
        const auto known = std::find(names.begin(), names.end(), seen.landmark);
        slam.observe(static_cast<int>(known - names.begin()), seen.y);
        if (known == names.end()) names.push_back(seen.landmark);
      }
      states.emplace_back(slam.pose().mean);
    }
    return states;
  };
  showTracking(library);
  showConsistency(library);
  showMap(library);
  showNames(library);
  showParticles(library);
}
