#include "cli/methods/car_filter.h"

#include <utility>

#include "base/error.h"
#include "cli/methods/car_slam_internal.h"
#include "cli/option_value_internal.h"
#include "estimation/kalman_filter.h"
#include "estimation/landmark_sensor.h"
#include "estimation/particle_filter.h"

namespace rex::cli {
namespace {

Gaussian start() {
  constexpr double kDeviation = 1e-3;
  return {Eigen::Vector3d::Zero(), kDeviation * kDeviation * Eigen::Matrix3d::Identity()};
}

// A filter whose belief is a single Gaussian, in any form.
class GaussianCarFilter : public CarFilter {
 public:
  explicit GaussianCarFilter(const CarSimulator& car) : car_(car) {}
  CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) final {
    predict(motionModel(car_, u));
    if (seen.landmarks.empty()) return {};
    return {.nis = update(sightingModel(car_, seen.landmarks), seen.y),
            .degrees = static_cast<int>(seen.y.size())};
  }

 private:
  virtual void predict(const NonlinearModel& motion) = 0;
  virtual double update(const NonlinearModel& sighting, const Eigen::VectorXd& y) = 0;

  CarSimulator car_;
};

class ExtendedCarFilter final : public GaussianCarFilter {
 public:
  using GaussianCarFilter::GaussianCarFilter;
  Gaussian pose() const override { return belief_; }

 private:
  void predict(const NonlinearModel& motion) override { belief_ = extendedPredict(belief_, motion); }
  double update(const NonlinearModel& sighting, const Eigen::VectorXd& y) override {
    const KalmanUpdate result = extendedUpdate(belief_, sighting, y);
    belief_ = result.belief;
    return result.squaredInnovation;
  }
  Gaussian belief_ = start();
};

class UnscentedCarFilter final : public GaussianCarFilter {
 public:
  using GaussianCarFilter::GaussianCarFilter;
  Gaussian pose() const override { return belief_; }

 private:
  void predict(const NonlinearModel& motion) override { belief_ = unscentedPredict(belief_, motion); }
  double update(const NonlinearModel& sighting, const Eigen::VectorXd& y) override {
    const KalmanUpdate result = unscentedUpdate(belief_, sighting, y);
    belief_ = result.belief;
    return result.squaredInnovation;
  }
  Gaussian belief_ = start();
};

// An observation model linearized at the mean, for filters that take linear models only. Angles in y are
// wrapped to be nearest to the expected ones.
struct Tangent {
  LinearModel model;
  Eigen::VectorXd y;
  double nis;
};
Tangent tangentAt(const Gaussian& belief, const NonlinearModel& sighting, const Eigen::VectorXd& y) {
  const LinearModel model = linearized(sighting, belief.mean);
  const Eigen::VectorXd expected = model.C * belief.mean + model.c;
  const Eigen::VectorXd nearest = expected + difference(sighting, y, expected);
  return {model, nearest, squaredMahalanobis(propagated(belief, model.C, model.c, model.W), nearest)};
}

class InformationCarFilter final : public GaussianCarFilter {
 public:
  using GaussianCarFilter::GaussianCarFilter;
  Gaussian pose() const override { return toNormal(belief_); }

 private:
  void predict(const NonlinearModel& motion) override {
    belief_ = informationPredict(belief_, linearized(motion, pose().mean));
  }
  double update(const NonlinearModel& sighting, const Eigen::VectorXd& y) override {
    const Tangent tangent = tangentAt(pose(), sighting, y);
    belief_ = informationUpdate(belief_, tangent.model, tangent.y);
    return tangent.nis;
  }
  CanonicalGaussian belief_ = toCanonical(start());
};

class RootCarFilter final : public GaussianCarFilter {
 public:
  using GaussianCarFilter::GaussianCarFilter;
  Gaussian pose() const override { return toNormal(belief_); }

 private:
  void predict(const NonlinearModel& motion) override {
    belief_ = rootPredict(belief_, linearized(motion, belief_.mean));
  }
  double update(const NonlinearModel& sighting, const Eigen::VectorXd& y) override {
    const Tangent tangent = tangentAt(pose(), sighting, y);
    belief_ = rootUpdate(belief_, tangent.model, tangent.y);
    return tangent.nis;
  }
  RootGaussian belief_ = toRoot(start());
};

class DeadReckoning final : public CarFilter {
 public:
  explicit DeadReckoning(const CarSimulator& car) : car_(car) {}
  CarUpdate step(const Eigen::Vector2d& u, const CarSightings&) override {
    belief_ = extendedPredict(belief_, motionModel(car_, u));
    return {};
  }
  Gaussian pose() const override { return belief_; }

 private:
  CarSimulator car_;
  Gaussian belief_ = start();
};

class ParticleCarFilter final : public CarFilter {
 public:
  ParticleCarFilter(const CarSimulator& car, int count, const Rng& rng)
      : car_(car), rng_(rng), filter_(sampledParticles(start(), count, rng_), {.threshold = 0.5}) {}
  CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) override {
    const Weigh blind = [](const MatrixArg&, Eigen::Ref<Eigen::VectorXd>) {};
    const Weigh weigh =
        seen.landmarks.empty() ? blind : observationWeights(sightingModel(car_, seen.landmarks), seen.y);
    const ParticleStep step = filter_.step(motionProposal(motionModel(car_, u)), weigh, rng_);
    return {.effectiveParticles = step.lost ? 0 : step.effectiveSize};
  }
  Gaussian pose() const override { return momentsOf(filter_.particles()); }
  void addTo(CarView& view) const override {
    view.particles = filter_.particles().states;
    view.weights = filter_.particles().weights;
  }

 private:
  CarSimulator car_;
  Rng rng_;
  ParticleFilter filter_;
};

[[noreturn]] void refuse(const std::string& name, const char* wanted) {
  throw UsageError({.what = "--filter", .found = "'" + name + "'", .wanted = wanted});
}

}  // namespace

CarFilterKind carFilterOf(const std::string& name) {
  if (name == "kalman")
    refuse(name, "ekf, ukf, information or root: the motion of the car is not linear in its heading");
  if (name == "histogram")
    refuse(name, "particles: with cells finer than a step of 0.1 m, x, y and heading would need millions");
  return choose<CarFilterKind>("--filter", name,
                               {{"ekf", CarFilterKind::kExtended},
                                {"ukf", CarFilterKind::kUnscented},
                                {"information", CarFilterKind::kInformation},
                                {"root", CarFilterKind::kRoot},
                                {"rts", CarFilterKind::kSmoother},
                                {"particles", CarFilterKind::kParticles},
                                {"ekf-slam", CarFilterKind::kEkfSlam},
                                {"fast-slam", CarFilterKind::kFastSlam},
                                {"fast-slam-2", CarFilterKind::kFastSlam2},
                                {"fast-slam-unnamed", CarFilterKind::kUnnamedFastSlam},
                                {"dead-reckoning", CarFilterKind::kDeadReckoning}});
}

bool makesMap(CarFilterKind kind) {
  return kind == CarFilterKind::kEkfSlam || (hasParticles(kind) && kind != CarFilterKind::kParticles);
}

bool hasParticles(CarFilterKind kind) {
  return kind == CarFilterKind::kParticles || kind == CarFilterKind::kFastSlam ||
         kind == CarFilterKind::kFastSlam2 || kind == CarFilterKind::kUnnamedFastSlam;
}

NonlinearModel motionModel(const CarSimulator& car, const Eigen::Vector2d& u) {
  const double noise = car.options().dynamicsNoise;
  return {.g = [&car, u](const Eigen::VectorXd& x) { return car.getMeanStateAfterStep(x, u); },
          .jacobian = [&car, u](const Eigen::VectorXd& x) { return car.getStateJacobian(x, u); },
          .W = noise * noise * Eigen::Matrix3d::Identity()};
}

NonlinearModel sightingModel(const CarSimulator& car, const std::vector<int>& landmarks) {
  const LandmarkSensor sensor = sensorOf(car.options());
  const Eigen::Matrix2Xd places = car.getLandmarks()(Eigen::all, landmarks);
  NonlinearModel model;
  model.g = [sensor, places](const Eigen::VectorXd& x) {
    Eigen::VectorXd y(places.size());
    for (Eigen::Index i = 0; i < places.cols(); ++i) y.segment<2>(2 * i) = viewOf(sensor, x, places.col(i)).y;
    return y;
  };
  model.jacobian = [sensor, places](const Eigen::VectorXd& x) {
    Eigen::MatrixXd J(places.size(), 3);
    for (Eigen::Index i = 0; i < places.cols(); ++i)
      J.middleRows<2>(2 * i) = viewOf(sensor, x, places.col(i)).Jx;
    return J;
  };
  model.W = sensor.W.diagonal().replicate(places.cols(), 1).asDiagonal();
  model.difference = [sensor](const Eigen::VectorXd& y1, const Eigen::VectorXd& y2) {
    Eigen::VectorXd d(y1.size());
    for (Eigen::Index i = 0; i < d.size(); i += 2)
      d.segment<2>(i) = innovation(sensor, y1.segment<2>(i), y2.segment<2>(i));
    return d;
  };
  return model;
}

std::unique_ptr<CarFilter> makeCarFilter(CarFilterKind kind, const CarSimulator& car, int particles,
                                         const Rng& rng) {
  switch (kind) {
    case CarFilterKind::kExtended:
    case CarFilterKind::kSmoother:
      return std::make_unique<ExtendedCarFilter>(car);
    case CarFilterKind::kUnscented:
      return std::make_unique<UnscentedCarFilter>(car);
    case CarFilterKind::kInformation:
      return std::make_unique<InformationCarFilter>(car);
    case CarFilterKind::kRoot:
      return std::make_unique<RootCarFilter>(car);
    case CarFilterKind::kParticles:
      return std::make_unique<ParticleCarFilter>(car, particles, rng);
    case CarFilterKind::kEkfSlam:
      return makeEkfSlam(car.options(), start());
    case CarFilterKind::kFastSlam:
    case CarFilterKind::kFastSlam2:
      return makeFastSlam(car.options(), start().mean, particles, kind == CarFilterKind::kFastSlam2, rng);
    case CarFilterKind::kUnnamedFastSlam:
      return makeUnnamedFastSlam(car.options(), start().mean, particles, rng);
    case CarFilterKind::kDeadReckoning:
      break;
  }
  return std::make_unique<DeadReckoning>(car);
}

}  // namespace rex::cli
