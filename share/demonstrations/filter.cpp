// Chapter 7: Filters and what they believe. A filter follows a car among landmarks (pale car; ellipse or
// dots: its belief); SLAM filters find the landmarks themselves. The squared error in the metric of the
// covariance (NEES) is 3 on average if the filter is right about its own errors, and far more if it trusts
// its sensors too much. Sliders change the noises and what the filter believes about them. A table compares
// all filters.
// Slides: 7:22, 7:28, 7:36 to 7:40
// Formula: NEES = (x - x^)ᵀ Σ⁻¹ (x - x^), on average dim x
// Try: A filter follows a car; its squared error in units of its covariance (NEES) should be 3 on average.
// Set "believed noise / true noise" to 0.3. "next filter" continues up to SLAM.
#include <cstdio>

#include "course/car_pictures.h"
#include "course/car_simulator.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/consistency.h"
#include "estimation/fast_slam.h"
#include "estimation/fast_slam_unknown_association.h"
#include "estimation/kalman_filter.h"
#include "estimation/landmark_sensor.h"
#include "estimation/particle_filter.h"
#include "geometry/rotation.h"
#include "render/picture.h"

using namespace rex;

const Gaussian kStart{.mean = Eigen::Vector3d::Zero(), .covariance = 1e-6 * Eigen::Matrix3d::Identity()};
const Eigen::Vector2d u(0.1, 0.2);  // speed and steering angle
constexpr int kSteps = 300, kParticles = 1000;

// All see all landmarks in each step.
struct Filter {
  CarSimulator car;  // as the filter believes it to be
  Rng rng;
  double nis = 0, numbers = 0;  // sum of squared innovations, and of how many numbers
  double effective = kParticles;

  Filter(const CarSimulator& believed, const Rng& random) : car(believed), rng(random) {}
  virtual ~Filter() = default;
  virtual void step(const Eigen::VectorXd& y) = 0;
  virtual Gaussian pose() const = 0;
  virtual std::vector<Gaussian> map() const { return {}; }
  virtual void draw(CarView&) const {}

  LandmarkSensor sensor() const {
    return {.W = std::pow(car.options().observationNoise, 2) * Eigen::Matrix2d::Identity()};
  }
  NonlinearModel motion() const {
    return {.g = [this](const Eigen::VectorXd& x) { return car.getMeanStateAfterStep(x, u); },
            .jacobian = [this](const Eigen::VectorXd& x) { return car.getStateJacobian(x, u); },
            .W = std::pow(car.options().dynamicsNoise, 2) * Eigen::Matrix3d::Identity()};
  }
  NonlinearModel sighting(const Eigen::VectorXd& y) const {
    return {.g = [this](const Eigen::VectorXd& x) { return car.getMeanObservationAtState(x); },
            .jacobian = [this](const Eigen::VectorXd& x) { return car.getObservationJacobianAtState(x); },
            .W = std::pow(car.options().observationNoise, 2) * Eigen::MatrixXd::Identity(y.size(), y.size())};
  }
  PoseTransition transition() const {
    return {
        .mean = [this](const Eigen::Vector3d& x) { return Eigen::Vector3d(car.getMeanStateAfterStep(x, u)); },
        .jacobian = [this](const Eigen::Vector3d& x) { return Eigen::Matrix3d(car.getStateJacobian(x, u)); },
        .noise = std::pow(car.options().dynamicsNoise, 2) * Eigen::Matrix3d::Identity()};
  }
};

template <bool kUnscented>
struct Kalman : Filter {
  Gaussian belief = kStart;
  using Filter::Filter;
  void step(const Eigen::VectorXd& y) override {
    belief = kUnscented ? unscentedPredict(belief, motion()) : extendedPredict(belief, motion());
    const KalmanUpdate update =
        kUnscented ? unscentedUpdate(belief, sighting(y), y) : extendedUpdate(belief, sighting(y), y);
    belief = update.belief;
    nis += update.squaredInnovation, numbers += static_cast<double>(y.size());
  }
  Gaussian pose() const override { return belief; }
};

struct ParticlesOnly : Filter {
  ParticleFilter filter;
  ParticlesOnly(const CarSimulator& car, const Rng& random)
      : Filter(car, random), filter(sampledParticles(kStart, kParticles, rng), {.threshold = 0.5}) {}
  void step(const Eigen::VectorXd& y) override {
    const ParticleStep done = filter.step(motionProposal(motion()), observationWeights(sighting(y), y), rng);
    effective = done.lost ? 0 : done.effectiveSize;
  }
  Gaussian pose() const override { return sampleMoments(filter.particles()); }
  void draw(CarView& view) const override {
    view.particles = filter.particles().states, view.weights = filter.particles().weights;
  }
};

struct KalmanSlam : Filter {
  EkfSlam slam;
  KalmanSlam(const CarSimulator& car, const Rng& random) : Filter(car, random), slam(kStart, sensor()) {}
  void step(const Eigen::VectorXd& y) override {
    slam.predict(transition());
    for (int i = 0; i < car.countLandmarks(); ++i) {
      const LandmarkUpdate update = slam.observe(i, y.segment<2>(2 * i));
      nis += update.squaredInnovation, numbers += update.isNew ? 0 : 2;
    }
  }
  Gaussian pose() const override { return slam.pose(); }
  std::vector<Gaussian> map() const override {
    std::vector<Gaussian> all;
    for (int i = 0; i < slam.landmarks(); ++i) all.push_back(slam.landmark(i));
    return all;
  }
};

// Particles that carry maps.
template <class Slam>
struct ParticleSlam : Filter {
  Slam slam;
  ParticleSlam(const CarSimulator& car, const Rng& random, const Slam& empty)
      : Filter(car, random), slam(empty) {}
  void step(const Eigen::VectorXd& y) override {
    FastSlamStep done;
    if constexpr (std::is_same_v<Slam, FastSlam>) {
      std::vector<LandmarkSighting> seen;
      for (int i = 0; i < car.countLandmarks(); ++i) seen.push_back({i, y.segment<2>(2 * i)});
      done = slam.step(transition(), seen, rng);
    } else {  // it is not told which landmark is which
      std::vector<Eigen::Vector2d> seen;
      for (int i = 0; i < car.countLandmarks(); ++i) seen.push_back(y.segment<2>(2 * i));
      done = slam.step(transition(), seen, rng);
    }
    effective = done.lost ? 0 : done.effectiveSize;
  }
  Gaussian pose() const override {
    const Eigen::Vector3d mean = slam.meanPose();
    Eigen::Matrix3Xd errors = slam.poses().colwise() - mean;
    for (double& heading : errors.row(2)) heading = wrapAngle(heading);
    return {mean, errors * slam.weights().asDiagonal() * errors.transpose()};
  }
  std::vector<Gaussian> map() const override {
    std::vector<Gaussian> all;
    if constexpr (std::is_same_v<Slam, FastSlam>)
      for (int i = 0; i < slam.landmarks(); ++i) all.push_back(slam.landmark(i));
    else
      for (const MappedLandmark& one : slam.map()) all.push_back(one.position);
    return all;
  }
  void draw(CarView& view) const override { view.particles = slam.poses(), view.weights = slam.weights(); }
};

const std::vector<std::string> kNames{"ekf",       "ukf",         "particles",        "ekf-slam",
                                      "fast-slam", "fast-slam-2", "fast-slam-unnamed"};

std::unique_ptr<Filter> makeFilter(const std::string& name, const CarSimulator& car, const Rng& rng) {
  if (name == "ekf") return std::make_unique<Kalman<false>>(car, rng);
  if (name == "ukf") return std::make_unique<Kalman<true>>(car, rng);
  if (name == "particles") return std::make_unique<ParticlesOnly>(car, rng);
  auto slam = std::make_unique<KalmanSlam>(car, rng);
  if (name == "ekf-slam") return slam;
  const Eigen::Vector3d start = kStart.mean;
  if (name == "fast-slam-unnamed")
    return std::make_unique<ParticleSlam<FastSlamUnknownAssociation>>(
        car, rng,
        FastSlamUnknownAssociation(
            start, slam->sensor(),
            {.particles = kParticles, .isInView = [](const auto&, const auto&) { return true; }}));
  const FastSlamOptions options{.particles = kParticles, .observedProposal = name == "fast-slam-2"};
  return std::make_unique<ParticleSlam<FastSlam>>(car, rng, FastSlam(start, slam->sensor(), options));
}

// A car and its filter.
struct Run {
  CarSimulator car;
  std::unique_ptr<Filter> filter;
  Eigen::Vector3d reckoned{0, 0, 0}, error{0, 0, 0};
  std::optional<double> nees{};  // none where the covariance is singular
  Run(const std::string& name, std::uint64_t seed, const CarOptions& options, double trust)
      : car(seed, 5, options) {
    CarOptions believed = options;
    believed.observationNoise *= trust;
    filter = makeFilter(name, CarSimulator(car.getLandmarks(), believed), Rng(seed).split(7));
  }
  void step() {
    constexpr int kHeading[] = {2};
    car.step(u);
    filter->step(car.getRealNoisyObservation());
    reckoned = car.getMeanStateAfterStep(reckoned, u);
    const Gaussian pose = filter->pose();
    error = pose.mean - car.getState();
    error[2] = wrapAngle(error[2]);
    nees.reset();
    if (filter->effective >= 4 && pose.covariance.ldlt().isPositive())
      nees = estimationErrorSquared(pose, car.getState(), kHeading);
  }
};

// Prints a row about runs that differ only in the seed. Returns the mean NEES in each step.
std::vector<double> judge(const std::string& name, std::uint64_t seed, int runs, double trust, bool prints) {
  std::vector<double> nees(kSteps), regular(kSteps);
  double position = 0, heading = 0, reckoned = 0, nis = 0, numbers = 0, places = 0, found = 0;
  for (int i = 0; i < runs; ++i) {
    Run run(name, seed + static_cast<std::uint64_t>(i), {}, trust);
    for (int t = 0; t < kSteps; ++t) {
      run.step();
      position += run.error.head<2>().squaredNorm(), heading += run.error[2] * run.error[2];
      reckoned += (run.reckoned - run.car.getState()).head<2>().squaredNorm();
      if (run.nees) nees[t] += *run.nees, ++regular[t];
    }
    nis += run.filter->nis, numbers += run.filter->numbers;
    for (const Gaussian& one : run.filter->map()) {
      const Eigen::Vector2d place = one.mean;
      places += (run.car.getLandmarks().colwise() - place).colwise().squaredNorm().minCoeff(), ++found;
    }
  }
  double mean = 0, inside = 0, count = 0;
  const ConsistencyBand band = consistencyBand(runs, 3);
  for (int t = 0; t < kSteps; ++t) {
    mean += nees[t], count += regular[t];
    nees[t] /= std::max(1., regular[t]);
    inside += regular[t] == runs && nees[t] >= band.lower && nees[t] <= band.upper;
  }
  if (!prints) return nees;
  const double all = 1. * kSteps * runs;
  std::printf("%-18s %5g %9.4g %8.4g %13.4g %8.4g %8.1f", name.c_str(), trust, std::sqrt(position / all),
              std::sqrt(heading / all), std::sqrt(reckoned / all), mean / count, 100 * inside / kSteps);
  numbers > 0 ? std::printf(" %8.4g", nis / numbers) : std::printf(" %8s", "");
  if (found > 0) std::printf(" %8.4g", std::sqrt(places / found));
  std::printf("\n");
  std::fflush(stdout);
  return nees;
}

int main(int argc, char** argv) {
  std::uint64_t seed = argc > 1 ? std::stoull(argv[1]) : 0;
  const int runs = argc > 2 ? std::stoi(argv[2]) : 10;
  LiveView view("filter");
  view.lookFrom({0, -0.6, 1});
  const ConsistencyBand band = consistencyBand(runs, 3);
  const std::vector<double> right = judge("ekf", seed, runs, 1, false),
                            trusting = judge("ekf", seed, runs, 0.3, false);
  std::optional<Run> run;
  std::size_t which = 0;
  int step = 0;
  for (int t = 0; t < kSteps || view.isWatched(); ++t) {
    const CarOptions options{.dynamicsNoise = view.slider("noise of the motion", 0.001, 0.2, 0.03),
                             .observationNoise = view.slider("noise of landmarks [m]", 0.05, 3, 0.5)};
    const double trust = view.slider("believed noise / true noise", 0.1, 3, 1);
    if (view.button("next filter")) which = (which + 1) % kNames.size(), run.reset();
    if (view.button("from the start") || step == kSteps) run.reset();
    if (!run) run.emplace(kNames[which], seed, options, trust), step = 0;
    run->step(), ++step;
    const Gaussian pose = run->filter->pose();
    CarView seen{.car = run->car.getState(),
                 .estimate = Eigen::Vector3d(pose.mean),
                 .landmarks = run->car.getLandmarks(),
                 .poseBeliefs = {{pose.mean.head<2>(), pose.covariance.topLeftCorner<2, 2>()}},
                 .caption = kNames[which]};
    for (const Gaussian& one : run->filter->map())
      seen.landmarkBeliefs.push_back({one.mean.head<2>(), one.covariance});
    run->filter->draw(seen);
    view.plot("error [m]", step, run->error.head<2>().norm(), "step");
    view.plot("two deviations [m]", step, 2 * std::sqrt(pose.covariance.topLeftCorner<2, 2>().trace()),
              "step");
    view.plot("NEES, mean of the runs", step, right[step - 1], "step");
    view.plot("NEES, noise assumed 0.3 of it", step, trusting[step - 1], "step");
    view.plot("95 % are above", step, band.lower, "step");
    view.plot("95 % are below", step, band.upper, "step");
    view.show(carPicture(seen));
  }
  std::printf("%d runs; consistent: NEES 3, its mean in the band in 95 %% of the steps, NIS 1\n", runs);
  std::printf(
      "filter             trust error [m]    [rad]  odometry [m]     NEES  in band      NIS  map [m]\n");
  for (const std::string& name : kNames) judge(name, seed, runs, 1, true);
  judge("ekf", seed, runs, 0.3, true);
}
