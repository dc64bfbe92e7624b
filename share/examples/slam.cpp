// SLAM: a car drives in a circle among landmarks whose places it does not know, and maps them and itself by
// an extended Kalman filter.
#include "course/car_pictures.h"
#include "course/car_simulator.h"
#include "course/car_view.h"
#include "course/course.h"
#include "estimation/ekf_slam.h"

using namespace rex;

int main() {
  CarSimulator car(3, 8);  // the third world of eight landmarks
  const double drift = car.options().dynamicsNoise, noise = car.options().observationNoise;
  EkfSlam slam({.mean = Eigen::Vector3d::Zero(), .covariance = 1e-6 * Eigen::Matrix3d::Identity()},
               {.W = noise * noise * Eigen::Matrix2d::Identity()});

  const Eigen::Vector2d u(1, 0.2);  // speed and steering angle
  Eigen::Matrix2Xd way(2, 100);
  for (int t = 0; t < way.cols(); ++t) {
    car.step(u);
    slam.predict({.mean = [&](const Eigen::Vector3d& x) { return car.getMeanStateAfterStep(x, u); },
                  .jacobian = [&](const Eigen::Vector3d& x) { return car.getStateJacobian(x, u); },
                  .noise = drift * drift * Eigen::Matrix3d::Identity()});
    const Eigen::VectorXd seen = car.getRealNoisyObservation();
    for (int i = 0; i < car.countLandmarks(); ++i) slam.observe(i, seen.segment<2>(2 * i));
    way.col(t) = slam.pose().mean.head<2>();
  }
  print("true pose", car.getState());
  print("estimated pose", slam.pose().mean);

  CarView view{.car = car.getState(), .estimate = slam.pose().mean, .landmarks = car.getLandmarks()};
  view.paths = {{.name = "estimated way", .points = way, .color = kEstimateColor}};
  for (int i = 0; i < slam.landmarks(); ++i)
    view.landmarkBeliefs.push_back({slam.landmark(i).mean, slam.landmark(i).covariance});
  writePicture(carFilm({view}).front().picture, "slam.png", {.view = kFromAbove});
  plot("map", carFigure(view));
}
