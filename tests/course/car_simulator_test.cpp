#include "course/car_simulator.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/derivative_check.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::car_simulator_test {

Eigen::VectorXd vectorOf(const nlohmann::json& json) {
  const auto numbers = json.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

TEST(CarSimulator, AgreesWithTheGoldenNumbers) {
  std::ifstream stream(sourcePath("tests/golden/exercises.json"));
  const nlohmann::json car = nlohmann::json::parse(stream)["car"];
  Eigen::Matrix2Xd landmarks(2, 2);
  for (int i = 0; i < 2; ++i) landmarks.col(i) = vectorOf(car["landmarks"][static_cast<std::size_t>(i)]);
  const CarSimulator simulator(landmarks, {});
  ASSERT_FALSE(car["cases"].empty());
  for (const nlohmann::json& one : car["cases"]) {
    const Eigen::VectorXd x = vectorOf(one["x"]), u = vectorOf(one["u"]);
    EXPECT_LT((simulator.getMeanStateAfterStep(x, u) - vectorOf(one["x_next_noisefree"])).norm(), 1e-14);
    EXPECT_LT((simulator.getMeanObservationAtState(x) - vectorOf(one["y"])).norm(), 1e-13);
    const Eigen::MatrixXd C = simulator.getObservationJacobianAtState(x);
    for (int row = 0; row < 4; ++row)
      EXPECT_LT((C.row(row).transpose() - vectorOf(one["dy_dx"][static_cast<std::size_t>(row)])).norm(),
                1e-13);
  }
}

TEST(CarSimulator, JacobiansAreDerivatives) {
  for (const bool rangeBearing : {false, true}) {
    CarSimulator car(3, 5, {.rangeBearing = rangeBearing});
    Rng rng(4);
    for (const double size : {0., 1e-8, 1.}) {
      const Eigen::VectorXd x = size * rng.normalVector(3), u = rng.normalVector(2);
      Eigen::VectorXd z(13);
      z << x, car.getLandmarks().reshaped();
      const auto see = [&](const Eigen::VectorXd& at) {
        return car.getMeanObservationAtStateAndLandmarks(at.head(3), at.tail(10));
      };
      const JacobianCheck seen =
          checkJacobian(see, car.getObservationJacobianAtStateAndLandmarks(x, z.tail(10)), z, 1e-7);
      EXPECT_TRUE(seen.ok) << seen.message;
      const auto move = [&](const Eigen::VectorXd& at) { return car.getMeanStateAfterStep(at, u); };
      const JacobianCheck moved = checkJacobian(move, car.getStateJacobian(x, u), x, 1e-7);
      EXPECT_TRUE(moved.ok) << moved.message;
    }
  }
}

TEST(CarSimulator, ObservationIsLinearInTheLandmarks) {
  Rng rng(9);
  const CarSimulator car(3, 4);
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd x = 5 * rng.normalVector(3), landmarks = 10 * rng.normalVector(8);
    Eigen::MatrixXd C;
    Eigen::VectorXd c;
    car.getLinearObservationModelAtState(C, c, x);
    ASSERT_EQ(C.rows(), 8);
    ASSERT_EQ(C.cols(), 8);
    EXPECT_LT((C * landmarks + c - car.getMeanObservationAtStateAndLandmarks(x, landmarks)).norm(), 1e-12);
    EXPECT_LT((c + C * Eigen::Vector2d(x.head<2>()).replicate(4, 1)).norm(), 1e-12) << "c = -C p";
  }
}

TEST(CarSimulator, NoiseHasTheStatedDeviation) {
  CarSimulator car(5, 2, {.rangeBearing = true});
  double moved = 0, range = 0, bearing = 0;
  const int count = 20000;
  const Eigen::Vector2d u(.1, .2);
  for (int i = 0; i < count; ++i) {
    car.setState(Eigen::Vector3d(0, 0, .5));
    const Eigen::VectorXd error =
        car.getRealNoisyObservation() - car.getMeanObservationAtState(car.getState());
    range += error[0] * error[0] / count;
    bearing += error[1] * error[1] / count;
    car.step(u);
    moved +=
        (car.getState() - car.getMeanStateAfterStep(Eigen::Vector3d(0, 0, .5), u)).squaredNorm() / 3 / count;
  }
  EXPECT_NEAR(std::sqrt(range), .5, .015);
  EXPECT_NEAR(std::sqrt(bearing), .02, .0006);
  EXPECT_NEAR(std::sqrt(moved), .03, .0006);
}

TEST(CarSimulator, SeesWhatIsInRangeAndInView) {
  CarSimulator car(6, 0, {.maxRange = 5, .fieldOfView = 2});
  Eigen::Matrix2Xd landmarks(2, 4);
  landmarks << 4, 6, 2, -3, 0, 0, 3, 0;
  car.setLandmarks(landmarks);
  EXPECT_EQ(car.getVisibleLandmarks(), (std::vector<int>{0, 2}));
  car.setState(Eigen::Vector3d(6, 0, 0));
  EXPECT_EQ(car.getVisibleLandmarks(), (std::vector<int>{1})) << "at the car itself";
  car.setState(Eigen::Vector3d(0, 0, M_PI));
  EXPECT_EQ(car.getVisibleLandmarks(), (std::vector<int>{3}));
}

TEST(CarSimulator, SameSeedSameDrive) {
  CarSimulator a(7), b(7), other(8);
  for (CarSimulator* car : {&a, &b, &other})
    for (int i = 0; i < 10; ++i) car->step(Eigen::Vector2d(.1, .2));
  EXPECT_EQ(a.getState(), b.getState());
  EXPECT_EQ(a.getRealNoisyObservation(), b.getRealNoisyObservation());
  EXPECT_NE(a.getState(), other.getState());
}

TEST(CarSimulator, HidesTheTruthWhereThereIsNone) {
  CarSimulator car(Eigen::Matrix2Xd::Zero(2, 1), {});
  EXPECT_REX_ERROR(car.getState(), "CarSimulator::getState: found a car whose true state is not known here");
  EXPECT_REX_ERROR(car.getRealNoisyObservation(), "CarSimulator::getRealNoisyObservation");
  EXPECT_REX_ERROR(car.step(Eigen::Vector2d(0, 0)), "CarSimulator::step");
  EXPECT_REX_ERROR(car.setState(Eigen::Vector3d(0, 0, 0)), "CarSimulator::setState");
  EXPECT_REX_ERROR(car.getVisibleLandmarks(), "CarSimulator::getVisibleLandmarks");
  EXPECT_EQ(car.getMeanObservationAtState(Eigen::Vector3d(1, 0, 0)), Eigen::Vector2d(-1, 0));
}

// Drawing on with the generator that drew the places does not give the noise.
TEST(CarSimulator, PlacesDoNotTellTheNoise) {
  CarSimulator few(11, 1), many(11, 6);
  EXPECT_EQ(few.getLandmarks().col(0), many.getLandmarks().col(0));
  few.step(Eigen::Vector2d(.1, .2));
  many.step(Eigen::Vector2d(.1, .2));
  EXPECT_EQ(few.getState(), many.getState()) << "the noise does not follow on the places";
}

TEST(CarSimulator, BearingsStayAngles) {
  CarSimulator car(12, 1, {.rangeBearing = true, .bearingNoise = .5});
  car.setLandmarks(Eigen::Vector2d(-5, 0));
  for (int i = 0; i < 100; ++i) EXPECT_LE(std::abs(car.getRealNoisyObservation()[1]), M_PI);
}

TEST(CarSimulator, HidesPlacesWhereAMapIsToBeFound) {
  CarSimulator car = CarSimulator::withoutPlaces(2);
  const Eigen::Vector3d x(1, 2, .5);
  EXPECT_EQ(car.countLandmarks(), 2);
  EXPECT_REX_ERROR(car.getLandmarks(), "CarSimulator::getLandmarks: found landmarks whose positions are not");
  EXPECT_REX_ERROR(car.getMeanObservationAtState(x), "CarSimulator::getMeanObservationAtState");
  EXPECT_REX_ERROR(car.getObservationJacobianAtState(x), "CarSimulator::getObservationJacobianAtState");
  EXPECT_REX_ERROR(car.getState(), "CarSimulator::getState");
  EXPECT_REX_ERROR(CarSimulator::withoutPlaces(-1), "car: landmarks: found -1, wanted 0 or more");
  const Eigen::Vector4d landmarks(3, 1, -2, 4);
  const Eigen::VectorXd y = car.getMeanObservationAtStateAndLandmarks(x, landmarks);
  car.setLandmarks(landmarks.reshaped(2, 2));
  EXPECT_EQ(car.getMeanObservationAtState(x), y);
}

TEST(CarSimulator, SaysWhatIsWrong) {
  Eigen::MatrixXd C;
  Eigen::VectorXd c;
  EXPECT_REX_ERROR(CarSimulator(0, 2, {.rangeBearing = true})
                       .getLinearObservationModelAtState(C, c, Eigen::Vector3d::Zero()),
                   "getLinearObservationModelAtState: found a car that observes distances and bearings");
  EXPECT_REX_ERROR(CarSimulator(0, -1), "car: landmarks: found -1, wanted 0 or more");
  EXPECT_REX_ERROR(CarSimulator(0, 2, {.tau = 0}),
                   "car: tau: found 0 s, wanted a positive, finite number of seconds");
  EXPECT_REX_ERROR(CarSimulator(0, 2, {.wheelbase = -1}),
                   "car: wheelbase: found -1 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(CarSimulator(0, 2, {.dynamicsNoise = -1}),
                   "car: noise: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(CarSimulator(0, 2, {.maxRange = 0}),
                   "car: largest range: found 0 m, wanted a positive number of metres, or infinity");
  EXPECT_REX_ERROR(CarSimulator(0, 2, {.fieldOfView = 0}),
                   "car: field of view: found 0 rad, wanted a positive, finite number of radians");
  EXPECT_REX_ERROR(CarSimulator(0, 2, {.fieldOfView = HUGE_VAL}), "car: field of view: found inf rad");
  CarSimulator car;
  EXPECT_REX_ERROR(car.step(Eigen::Vector3d(0, 0, 0)), "control: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(car.setState(Eigen::Vector3d(0, std::nan(""), 0)), "state: number 1: found nan");
  EXPECT_REX_ERROR(car.getMeanObservationAtState(Eigen::Vector2d(0, 0)),
                   "state: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(car.getMeanObservationAtStateAndLandmarks(Eigen::Vector3d(0, 0, 0), Eigen::Vector2d(0, 0)),
                   "landmarks: found a vector of size 2, wanted size 4");
  EXPECT_REX_ERROR(car.setLandmarks(Eigen::Matrix2d::Constant(INFINITY)), "landmarks: number 0: found inf");
}

}  // namespace rex::car_simulator_test
