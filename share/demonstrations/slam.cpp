// Chapter 7: Kalman SLAM. The car maps landmarks it does not know and itself (pale car): all ellipses grow
// with the distance driven, and shrink together when the first landmark is seen again. Sliders change the
// noises.
// Slides: 7:36 to 7:38
// Formula: x = (car, m_1, ..., m_n): Σ ← F Σ Fᵀ + Q, K = Σ Hᵀ (H Σ Hᵀ + R)⁻¹
// Try: Ellipses grow along the path and shrink when the loop closes. Raise the noises and press "from the
// start".
#include "course/car_pictures.h"
#include "course/car_simulator.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/ekf_slam.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("slam");
  view.lookFrom({0, -0.6, 1});
  Eigen::Matrix2Xd posts(2, 16);
  for (int i = 0; i < 16; ++i)
    posts.col(i) = Eigen::Vector2d(0, 12) +
                   (i % 2 == 0 ? 15 : 9) * Eigen::Vector2d(std::sin(i / 2.5465), -std::cos(i / 2.5465));
  CarSimulator car(1, 16, {.dynamicsNoise = 0});
  std::optional<EkfSlam> slam;
  std::vector<int> number;  // of each landmark in the map; -1: not seen yet
  Rng rng(2);
  double turned = 0;  // radians
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double noise = view.slider("noise of landmarks [m]", 0.05, 1, 0.4),
                 drift = view.slider("noise of the motion", 0.01, 0.12, 0.08);
    const double range = view.slider("range of sight [m]", 3, 40, 7);
    if (view.button("from the start") || !slam) {
      car.setState(Eigen::Vector3d::Zero()), car.setLandmarks(posts), number.assign(16, -1), turned = 0;
      slam.emplace(
          Gaussian{.mean = Eigen::Vector3d::Zero(), .covariance = 1e-6 * Eigen::Matrix3d::Identity()},
          LandmarkSensor{.W = noise * noise * Eigen::Matrix2d::Identity()});
    }
    // Somebody steers it along a circle of 12 m, 151 steps.
    const Eigen::Vector2d from = car.getState().head<2>() - Eigen::Vector2d(0, 12);
    const double away = from.norm() - 12,
                 turn =
                     std::remainder(std::atan2(from.x(), -from.y()) - car.getState()[2], 6.283185307179586);
    const Eigen::Vector2d u(0.5, std::clamp(std::atan(2. / 12) + 0.1 * away + 0.6 * turn, -0.6, 0.6));
    Eigen::Vector3d x = car.getMeanStateAfterStep(car.getState(), u);
    car.setState(x + drift * Eigen::Vector3d(1, 1, 0.3).cwiseProduct(Eigen::Vector3d(rng.normalVector(3))));
    slam->predict(
        {.mean = [&](const Eigen::Vector3d& at) { return Eigen::Vector3d(car.getMeanStateAfterStep(at, u)); },
         .jacobian = [&](const Eigen::Vector3d& at) { return Eigen::Matrix3d(car.getStateJacobian(at, u)); },
         .noise = drift * drift * Eigen::Vector3d(1, 1, 0.09).asDiagonal().toDenseMatrix()});
    turned += std::remainder(car.getState()[2] - x[2], 6.283185307179586) + 0.5 / 12;
    x = car.getState();
    CarView show{.car = x, .landmarks = posts};
    std::vector<Eigen::Vector2d> sightings;
    for (int i = 0; i < 16; ++i) {
      if ((posts.col(i) - x.head<2>()).norm() > range) continue;
      sightings.push_back(posts.col(i));
      const Eigen::Vector2d y =
          car.getMeanObservationAtState(x).segment<2>(2 * i) + noise * rng.normalVector(2);
      if (number[i] < 0) number[i] = slam->landmarks();
      slam->observe(number[i], y);
    }
    show.sightings.resize(2, static_cast<int>(sightings.size()));
    for (int i = 0; i < show.sightings.cols(); ++i) show.sightings.col(i) = sightings[i];
    double area = 0;
    std::vector<Ellipsoid> ellipses;
    for (int i = 0; i < slam->landmarks(); ++i) {
      const Gaussian one = slam->landmark(i);
      Eigen::Matrix3d flat = 1e-4 * Eigen::Matrix3d::Identity();
      flat.topLeftCorner<2, 2>() = one.covariance;
      ellipses.push_back(
          covarianceEllipsoid({one.mean[0], one.mean[1], 0.02}, flat, 2, {0, 0.62f, 0.45f, 0.45f}));
      area += std::sqrt(one.covariance.trace()) / slam->landmarks();
    }
    const Gaussian pose = slam->pose();
    show.estimate = Eigen::Vector3d(pose.mean),
    show.poseBeliefs = {{pose.mean.head<2>(), pose.covariance.topLeftCorner<2, 2>()}};
    show.caption = "loop " + std::to_string(1 + static_cast<int>(turned / 6.283185307179586)) + ", " +
                   std::to_string(slam->landmarks()) + " landmarks in the map";
    Picture picture = carPicture(show);
    for (const Ellipsoid& one : ellipses) picture.ellipsoids.push_back(one);
    picture.polylines.push_back(
        {.points = {{-18, -6, 0}, {18, -6, 0}, {18, 30, 0}, {-18, 30, 0}, {-18, -6, 0}},
         .color = kTruthColor});
    view.plot("mean deviation of a landmark [m]", t / 30., area);
    view.plot("error of the pose [m]", t / 30., (pose.mean - x).head<2>().norm());
    view.show(picture);
  }
}
