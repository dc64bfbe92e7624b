// Chapter 7: A kidnapped robot. A particle filter (dots) and a Kalman filter (pale car, ellipse) follow a car
// among landmarks; at 3 s somebody puts it elsewhere. Few particles that start anywhere find it at once;
// without them the others creep after it. Sliders say how many.
// Slides: 7:22, 7:25
// Formula: w_i ~ P(y|x_i); a share of the x_i is drawn from anywhere
// Try: At 3 s the car is moved; particles from anywhere find it. Set "share from anywhere" to zero and
// press "kidnap".
#include "course/car_pictures.h"
#include "course/car_simulator.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/kalman_filter.h"
#include "estimation/particle_filter.h"
#include "render/picture.h"

using namespace rex;

int main() {
  CarSimulator car(3, 6);
  LiveView view("kidnapped");
  view.lookFrom({0, -0.6, 1});
  Rng rng(1);
  const Gaussian start{.mean = Eigen::Vector3d::Zero(), .covariance = 0.01 * Eigen::Matrix3d::Identity()};
  ParticleFilter particles(sampledParticles(start, 300, rng));
  Gaussian kalman = start;
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double noise = view.slider("noise of landmarks [m]", 0.2, 5, 1),
                 drift = view.slider("noise of the motion", 0.01, 0.5, 0.08);
    const double lost = view.slider("share from anywhere", 0, 0.2, 0.02),
                 steering = view.slider("steering [rad]", -0.5, 0.5, 0.1);
    if (view.button("kidnap") || t == 90)
      car.setState(Eigen::Vector3d(rng.uniform(-12, 12), rng.uniform(-12, 12), rng.uniform(-3, 3)));
    const Eigen::Vector2d u(0.25, steering);
    car.step(u);
    Eigen::VectorXd y = car.getMeanObservationAtState(car.getState());
    y += noise * rng.normalVector(static_cast<int>(y.size()));
    // What both filters believe.
    const NonlinearModel motion{
        .g = [&](const Eigen::VectorXd& x) { return car.getMeanStateAfterStep(x, u); },
        .jacobian = [&](const Eigen::VectorXd& x) { return car.getStateJacobian(x, u); },
        .W = Eigen::Vector3d(drift, drift, drift / 2).cwiseAbs2().asDiagonal()};
    const NonlinearModel sight{
        .g = [&](const Eigen::VectorXd& x) { return car.getMeanObservationAtState(x); },
        .jacobian = [&](const Eigen::VectorXd& x) { return car.getObservationJacobianAtState(x); },
        .W = noise * noise * Eigen::MatrixXd::Identity(y.size(), y.size())};
    // The filter's motion, and now and then a particle anywhere.
    const MotionSampler drive = motionProposal(motion);
    const MotionSampler propose = [&](Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd> logWeights,
                                      Rng& random) {
      drive(X, logWeights, random);
      for (int i = 0; i < X.cols(); ++i)
        if (random.uniform() < lost)
          X.col(i) << random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-3.14, 3.14);
    };
    (void)particles.step(propose, observationWeights(sight, y), rng);
    kalman = extendedUpdate(extendedPredict(kalman, motion), sight, y).belief;
    const Eigen::Vector3d truth = car.getState();
    Picture picture = carPicture(
        CarView{.car = truth,
                .estimate = Eigen::Vector3d(kalman.mean),
                .landmarks = car.getLandmarks(),
                .particles = particles.particles().states,
                .weights = particles.particles().weights,
                .poseBeliefs = {{kalman.mean.head<2>(), kalman.covariance.topLeftCorner<2, 2>()}}});
    const double error = (sampleMoments(particles.particles()).mean - truth).head<2>().norm();
    picture.captions.push_back(
        {.text = error > 3 ? "the particles are lost" : "the particles are with the car", .scale = 1.5});
    picture.polylines.push_back(
        {.points = {{-17, -17, 0}, {17, -17, 0}, {17, 17, 0}, {-17, 17, 0}, {-17, -17, 0}},
         .color = kTruthColor});
    view.plot("error of the particle filter [m]", t / 30., error);
    view.plot("error of the Kalman filter [m]", t / 30., (kalman.mean - truth).head<2>().norm());
    view.show(picture);
  }
}
