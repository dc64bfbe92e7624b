#include <algorithm>
#include <cmath>
#include <numbers>

#include "course/car_figure.h"
#include "course/car_pictures.h"
#include "course/car_simulator.h"
#include "estimation/particle_filter.h"
#include "exercise.h"

using namespace rex;

Eigen::Vector3d carStep(const Eigen::Vector3d& x, const Eigen::Vector2d& u, const CarWorld& world) {
  // <solution carStep>
  const double way = world.tau * u[0];
  return {x[0] + way * std::cos(x[2]), x[1] + way * std::sin(x[2]),
          x[2] + way / world.wheelbase * std::tan(u[1])};
  // <todo>
  //| // TODO: slide 4:48, with a dot over the theta of its third line.
  //| static_cast<void>(u);
  //| return x;
  // </solution>
}

Eigen::MatrixXd moved(const Eigen::MatrixXd& states, const Eigen::Vector2d& u, const CarWorld& world,
                      Rng& rng) {
  Eigen::MatrixXd next = states;
  // <solution moved>
  for (Eigen::Index i = 0; i < states.cols(); ++i)
    next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise * rng.normalVector(3);
  // <todo>
  //| // TODO: each column one step on. rng.normal() is one number of standard deviation 1, and
  //| // rng.normalVector(3) are three.
  // </solution>
  return next;
}

Eigen::VectorXd viewFrom(const Eigen::Vector3d& x, const CarWorld& world) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * world.landmarks.cols());
  // <solution viewFrom>
  const double c = std::cos(x[2]), s = std::sin(x[2]);
  for (Eigen::Index i = 0; i < world.landmarks.cols(); ++i) {
    const double dx = world.landmarks(0, i) - x[0], dy = world.landmarks(1, i) - x[1];
    const double ahead = c * dx + s * dy, left = c * dy - s * dx;
    y[2 * i] = world.rangeBearing ? std::hypot(ahead, left) : ahead;
    y[2 * i + 1] = world.rangeBearing ? std::atan2(left, ahead) : left;
  }
  // <todo>
  //| // TODO: the landmarks in the frame of the car. Part 6: their distances and bearings, too.
  //| static_cast<void>(x);
  // </solution>
  return y;
}

Eigen::VectorXd logLikelihoods(const Eigen::MatrixXd& states, const Eigen::VectorXd& y,
                               const CarWorld& world) {
  Eigen::VectorXd logarithms = Eigen::VectorXd::Zero(states.cols());
  // <solution logLikelihoods>
  for (Eigen::Index i = 0; i < states.cols(); ++i) {
    const Eigen::VectorXd seen = viewFrom(states.col(i), world);
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const bool isBearing = world.rangeBearing && k % 2 == 1;
      const double error = isBearing ? std::remainder(y[k] - seen[k], 2 * std::numbers::pi) : y[k] - seen[k];
      const double deviations = error / (isBearing ? world.bearingNoise : world.observationNoise);
      logarithms[i] -= deviations * deviations / 2;
    }
  }
  // <todo>
  //| // TODO: the logarithm of a normal density, for each particle over all that was seen. How often is a
  //| // noise of 0.5 off by 1?
  //| static_cast<void>(y);
  //| static_cast<void>(world);
  // </solution>
  return logarithms;
}

Eigen::VectorXd weightsOf(const Eigen::VectorXd& logarithms) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(logarithms.size());
  // <solution weightsOf>
  // A common factor cancels. With this one the largest weight is exp(0): the sum is at least 1.
  const double largest = logarithms.maxCoeff();
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    weights[i] = std::isfinite(largest) ? std::exp(logarithms[i] - largest) : 1;
  weights /= weights.sum();
  // <todo>
  //| // TODO: what is exp(-10000), and what is 0 / 0? Which factor may all weights have?
  // </solution>
  return weights;
}

std::vector<int> resampledParents(const Eigen::VectorXd& weights, int count, Rng& rng) {
  std::vector<int> parents;
  // <solution resampledParents>
  // The whole parts are certain. For what remains, `count` - `parents` places stand on the line of the
  // fractions, one apart, and all are shifted by the same random number.
  Eigen::VectorXd rest = count * weights;
  for (int i = 0; i < rest.size(); ++i) {
    const int whole = static_cast<int>(rest[i] + 1e-9);
    parents.insert(parents.end(), static_cast<std::size_t>(whole), i);
    rest[i] = std::max(0., rest[i] - whole);
  }
  double place = rng.uniform(), end = 0;
  for (int i = 0; i < rest.size(); ++i)
    for (end += rest[i]; place < end && static_cast<int>(parents.size()) < count; place += 1)
      parents.push_back(i);
  // A place may fall off the end of the line by rounding.
  int heaviest = 0;
  weights.maxCoeff(&heaviest);
  parents.resize(static_cast<std::size_t>(count), heaviest);
  // <todo>
  //| // TODO: slide 7:23: whole parts for certain, the rest by chance. rng.uniform() is in [0, 1).
  //| static_cast<void>(weights);
  //| static_cast<void>(rng);
  //| parents.assign(static_cast<std::size_t>(count), 0);
  // </solution>
  return parents;
}

double effectiveSize(const Eigen::VectorXd& weights) {
  // <solution effectiveSize>
  return 1 / weights.squaredNorm();
  // <todo>
  //| // TODO: 1 for one particle that has it all, N for N that share it.
  //| return static_cast<double>(weights.size());
  // </solution>
}

Cloud filterStep(const Cloud& before, const Eigen::Vector2d& u, const Eigen::VectorXd& y,
                 const CarWorld& world, Rng& rng) {
  Cloud after = before;
  // <solution filterStep>
  const std::vector<int> parents =
      resampledParents(before.weights, static_cast<int>(before.weights.size()), rng);
  for (std::size_t i = 0; i < parents.size(); ++i)
    after.states.col(static_cast<Eigen::Index>(i)) = before.states.col(parents[i]);
  after.states = moved(after.states, u, world, rng);
  after.weights = weightsOf(logLikelihoods(after.states, y, world));
  // <todo>
  //| // TODO: resample, move, weigh. You have functions for all three.
  //| static_cast<void>(u);
  //| static_cast<void>(y);
  //| static_cast<void>(world);
  //| static_cast<void>(rng);
  // </solution>
  return after;
}

Eigen::Vector3d meanPose(const Cloud& cloud) {
  // <solution meanPose>
  double c = 0, s = 0;
  for (Eigen::Index i = 0; i < cloud.weights.size(); ++i) {
    c += cloud.weights[i] * std::cos(cloud.states(2, i));
    s += cloud.weights[i] * std::sin(cloud.states(2, i));
  }
  Eigen::Vector3d mean = cloud.states * cloud.weights;
  mean[2] = std::atan2(s, c);
  return mean;
  // <todo>
  //| // TODO: which direction lies between the headings 3.1 and -3.1?
  //| static_cast<void>(cloud);
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

double likelyNoise(const DriveLog& log, const CarWorld& world, Rng& rng) {
  // <solution likelyNoise>
  // What the filter does not explain is noise. The better the assumed noise, the better the filter, and with
  // it the noise: four rounds are enough even from a factor of ten.
  CarWorld assumed = world;
  for (int round = 0; round < 4; ++round) {
    Cloud cloud{log.start.replicate(1, 200), Eigen::VectorXd::Constant(200, 1. / 200)};
    double squares = 0, numbers = 0;
    for (std::size_t t = 0; t < log.controls.size(); ++t) {
      cloud = filterStep(cloud, log.controls[t], log.observations[t], assumed, rng);
      squares += (log.observations[t] - viewFrom(meanPose(cloud), assumed)).squaredNorm();
      numbers += static_cast<double>(log.observations[t].size());
    }
    assumed.observationNoise = std::sqrt(squares / numbers);
  }
  return assumed.observationNoise;
  // <todo>
  //| // TODO: how large is what the car saw, without what your filter explains of it?
  //| static_cast<void>(log);
  //| static_cast<void>(rng);
  //| return world.observationNoise;
  // </solution>
}

// From here on everything is given: the parts of the exercise one after another, with pictures. Change it as
// you like.

namespace {

constexpr int kSteps = 300;

// What a filter believed, after each step.
struct Belief {
  std::vector<Cloud> clouds;
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(3, kSteps);
};

Cloud cloudAt(const Eigen::Vector3d& x, int count) {
  return {x.replicate(1, count), Eigen::VectorXd::Constant(count, 1. / count)};
}

Belief filtered(const DriveLog& log, const CarWorld& world, bool look) {
  Rng rng(5);
  Belief belief;
  Cloud cloud = cloudAt(log.start, 100);
  for (std::size_t t = 0; t < log.controls.size(); ++t) {
    if (look) {
      cloud = filterStep(cloud, log.controls[t], log.observations[t], world, rng);
    } else {
      cloud.states = moved(cloud.states, log.controls[t], world, rng);
    }
    belief.means.col(static_cast<Eigen::Index>(t)) = meanPose(cloud);
    belief.clouds.push_back(cloud);
  }
  return belief;
}

std::vector<double> errorsOf(const Eigen::MatrixXd& means, const Eigen::MatrixXd& truth) {
  std::vector<double> errors;
  for (int t = 0; t < kSteps; ++t) errors.push_back((means.col(t) - truth.col(t)).head(2).norm());
  return errors;
}

Way wayOf(const std::string& name, const Eigen::MatrixXd& poses, const Color& color) {
  return {.name = name, .points = poses.topRows(2), .color = color};
}

// The clouds of every 60th step on one map.
void showMap(const std::string& name, const std::string& title, const Belief& belief,
             const std::vector<Way>& ways, const CarWorld& world) {
  Eigen::Matrix3Xd particles(3, 500);
  std::vector<double> steps;
  for (int k = 0; k < 5; ++k) {
    particles.middleCols(100 * k, 100) = belief.clouds[static_cast<std::size_t>(60 * k + 59)].states;
    steps.insert(steps.end(), 100, 60 * k + 60);
  }
  Figure map =
      figureOf({.landmarks = world.landmarks, .particles = particles, .ways = ways, .caption = title});
  for (Series& series : map.series)
    if (series.label == "particles") series.values = steps;
  map.colorLabel = "step";
  map.colorRange = AxisRange{0, 360};
  map.legend = Legend::kBottomLeft;
  map.xRange = AxisRange{-14, 20};
  map.yRange = AxisRange{-3, 25};
  plot(name, map);
}

void showFilm(const std::string& name, const std::string& caption, const Belief& belief,
              const std::vector<Way>& ways, const CarWorld& world, const Eigen::MatrixXd& truth) {
  std::vector<CarView> views;
  for (int t = 0; t < kSteps; t += 3) {
    CarView view{.car = truth.col(t),
                 .landmarks = world.landmarks,
                 .particles = belief.clouds[static_cast<std::size_t>(t)].states,
                 .ways = ways,
                 .caption = caption + ", step " + std::to_string(t)};
    for (Way& way : view.ways) way.points.conservativeResize(2, t + 1);
    views.push_back(view);
  }
  writeFilm(views, name, {.step = 3});
}

// The same drive with three assumptions about the noise of the sensor.
void showAssumptions(const DriveLog& log, const CarWorld& world, const Eigen::MatrixXd& truth) {
  Figure errors{.title = "What the filter makes of a wrong noise",
                .xLabel = "step",
                .yLabel = "error of the place [m]"};
  Figure sizes{.title = "How many of 100 particles count",
               .xLabel = "step",
               .yLabel = "effective size",
               .logY = true,
               .legend = Legend::kOutside};
  Figure weights{.title = "Weights in step 150, sorted",
                 .xLabel = "rank of the particle",
                 .yLabel = "weight",
                 .logY = true,
                 .yRange = AxisRange{1e-8, 2}};
  for (const double factor : {10., 1., 0.1}) {
    CarWorld assumed = world;
    assumed.observationNoise *= factor;
    const std::string label = factor > 1 ? "10 sigma" : factor < 1 ? "sigma / 10" : "sigma";
    const Belief belief = filtered(log, assumed, true);
    std::vector<double> size, sorted;
    for (const Cloud& cloud : belief.clouds) size.push_back(effectiveSize(cloud.weights));
    for (const double weight : belief.clouds[150].weights) sorted.push_back(std::max(weight, 1e-9));
    std::sort(sorted.rbegin(), sorted.rend());
    errors.series.push_back({.label = label, .y = errorsOf(belief.means, truth)});
    sizes.series.push_back({.label = label, .y = size});
    weights.series.push_back({.label = label, .y = sorted, .style = SeriesStyle::kLinesPoints, .size = 0.7});
  }
  plot("assumed", errors);
  plot("effective_size", sizes);
  plot("weights", weights);
}

// A car that knows roughly where it is, but not which way it looks.
void showBearings(const DriveLog& log, const CarWorld& world, const Eigen::MatrixXd& truth) {
  Rng rng(3);
  Cloud cloud = cloudAt(log.start, 2000);
  for (auto x : cloud.states.colwise())
    x += Eigen::Vector3d(rng.uniform(-2, 2), rng.uniform(-2, 2),
                         rng.uniform(-std::numbers::pi, std::numbers::pi));
  std::vector<CarView> views;
  for (int t = 0; t < 12; ++t) {
    const auto i = static_cast<std::size_t>(t);
    views.push_back({.car = t == 0 ? log.start : Eigen::Vector3d(truth.col(t - 1)),
                     .estimate = meanPose(cloud),
                     .landmarks = world.landmarks,
                     .particles = cloud.states,
                     .weights = cloud.weights,
                     .caption = "distances and bearings, step " + std::to_string(t)});
    cloud = filterStep(cloud, log.controls[i], log.observations[i], world, rng);
  }
  writeFilm(views, "bearings", {.rate = 2});
}

}  // namespace

int main() {
  CarWorld world;
  world.landmarks = (Eigen::MatrixXd(2, 2) << 15, -6, 5, 12).finished();
  const auto drive = [](const CarWorld& in, const Eigen::Vector2d& u, Eigen::MatrixXd& truth) {
    CarSimulator car(1, static_cast<int>(in.landmarks.cols()),
                     {.observationNoise = in.observationNoise,
                      .rangeBearing = in.rangeBearing,
                      .bearingNoise = in.bearingNoise});
    car.setLandmarks(in.landmarks);
    DriveLog log;
    truth.resize(3, kSteps);
    for (int t = 0; t < kSteps; ++t) {
      car.step(u);
      truth.col(t) = car.getState();
      log.controls.push_back(u);
      log.observations.push_back(car.getRealNoisyObservation());
    }
    return log;
  };
  Eigen::MatrixXd truth;
  const DriveLog log = drive(world, {0.1, 0.2}, truth);
  const Belief reckoned = filtered(log, world, false), belief = filtered(log, world, true);
  const Way wayOfCar = wayOf("car", truth, kTruthColor);
  const Way withoutLooking = wayOf("mean of the particles", reckoned.means, kDeadReckoningColor);
  const Way withLooking = wayOf("mean of the particles", belief.means, kEstimateColor);
  showMap("dead_reckoning", "Dead reckoning: the particles of every 60th step", reckoned,
          {wayOfCar, withoutLooking}, world);
  showMap("filter", "Particle filter: the particles of every 60th step", belief, {wayOfCar, withLooking},
          world);
  showFilm("dead_reckoning", "dead reckoning", reckoned, {wayOfCar, withoutLooking}, world, truth);
  showFilm("filter", "particle filter", belief,
           {wayOfCar, wayOf("dead reckoning", reckoned.means, kDeadReckoningColor)}, world, truth);

  // Once your own filter works, it is as good as the library's.
  const CarSimulator map(world.landmarks, CarOptions{});
  const NonlinearModel transition{
      .g = [&](const Eigen::VectorXd& x) { return map.getMeanStateAfterStep(x, log.controls[0]); },
      .W = std::pow(world.dynamicsNoise, 2) * Eigen::Matrix3d::Identity()};
  const NonlinearModel observation{
      .g = [&](const Eigen::VectorXd& x) { return map.getMeanObservationAtState(x); },
      .W = std::pow(world.observationNoise, 2) * Eigen::Matrix4d::Identity()};
  Rng rng(7);
  ParticleFilter library({Eigen::MatrixXd::Zero(3, 100), Eigen::VectorXd::Constant(100, 0.01)});
  Eigen::MatrixXd byLibrary(3, kSteps);
  for (int t = 0; t < kSteps; ++t) {
    static_cast<void>(
        library.step(motionProposal(transition),
                     observationWeights(observation, log.observations[static_cast<std::size_t>(t)]), rng));
    byLibrary.col(t) = momentsOf(library.particles()).mean;
  }
  plot("error",
       {.title = "How far the mean of the particles is from the car",
        .xLabel = "step",
        .yLabel = "error of the place [m]",
        .series = {
            {.label = "dead reckoning", .y = errorsOf(reckoned.means, truth), .color = kDeadReckoningColor},
            {.label = "your filter", .y = errorsOf(belief.means, truth), .color = kEstimateColor},
            {.label = "the library's filter",
             .y = errorsOf(byLibrary, truth),
             .dashed = true,
             .color = kTruthColor}}});
  showAssumptions(log, world, truth);

  CarWorld many = world;
  many.landmarks =
      (Eigen::MatrixXd(2, 8) << 15, -6, 20, 3, -12, 8, 0, 12, 5, 12, 22, -8, 1, 28, 20, -2).finished();
  const DriveLog longLog = drive(many, {0.1, 0.2}, truth);
  for (const double factor : {10., 1., 0.1}) {
    CarWorld assumed = many;
    assumed.observationNoise *= factor;
    print("assumed noise [m]", assumed.observationNoise);
    print("noise found (it was made with 0.5) [m]", likelyNoise(longLog, assumed, rng));
  }
  CarWorld polar = world;
  polar.rangeBearing = true;
  polar.bearingNoise = 0.1;
  polar.landmarks = (Eigen::MatrixXd(2, 3) << 15, -6, 2, 5, 8, -7).finished();
  const DriveLog polarLog = drive(polar, {0.3, 0.2}, truth);
  showBearings(polarLog, polar, truth);
}
