#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "cloud_evidence.h"
#include "drives.h"
#include "grading/check.h"
#include "interface.h"
#include "resampling_checks.h"

// Part 2: the motion of the car and of its particles, against the library's.

inline void positionFits(rex::grading::Check& check, const Eigen::Vector2d& got, const Eigen::Vector3d& x,
                         double speed, double tau, double turn, const Eigen::Vector2d& wanted) {
  const double way = tau * speed, c = std::cos(x[2]), s = std::sin(x[2]);
  const auto moved = [&](double alongX, double alongY) {
    return Eigen::Vector2d(x[0] + alongX, x[1] + alongY);
  };
  check.near("position after a step of carStep", got, wanted, 1e-9,
             {{"Does the car stay where it is?", moved(0, 0)},
              {"Is it the heading in the middle of the step? All terms use that before the step.",
               moved(way * std::cos(x[2] + turn / 2), way * std::sin(x[2] + turn / 2))},
              {"Are sine and cosine exchanged?", moved(way * s, way * c)},
              {"Is it the motion alone, without the position before the step?",
               moved(way * c - x[0], way * s - x[1])},
              {"Does the car drive backwards?", moved(-way * c, -way * s)}},
             "m");
}

inline void headingFits(rex::grading::Check& check, double got, double heading, double way,
                        const Eigen::Vector2d& u, const CarWorld& world, double wanted) {
  const double L = world.wheelbase, tangent = std::tan(u[1]);
  check.nearAngle(
      "heading after a step of carStep", got, wanted, 1e-9,
      {{"Does the heading not change?", heading},
       {"Is it the rate of theta? The heading changes by tau times that.", u[0] / L * tangent},
       {"Is it the change alone, without the heading before the step?", way / L * tangent},
       {"Is the tangent of the steering angle left out?", heading + way / L * u[1]},
       {"Is it the sine of the steering angle? Wanted is the tangent.", heading + way / L * std::sin(u[1])},
       {"Is the wheelbase left out?", heading + way * tangent},
       {"Is it multiplied by the wheelbase? Wanted is divided.", heading + way * L * tangent},
       {"Does the car turn to the wrong side?", heading - way / L * tangent}});
}

inline void checkStep(rex::grading::Check& check, Student& student, const CarWorld& world,
                      const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  check.input("a car", {{"x", x}, {"u", u}, {"tau", world.tau}, {"wheelbase", world.wheelbase}});
  const Eigen::Vector3d got = student.carStep(x, u, world), wanted = mapOf(world).getMeanStateAfterStep(x, u);
  check.shape("state after a step of carStep", got, 3, 1);
  const double way = world.tau * u[0], turn = way / world.wheelbase * std::tan(u[1]);
  const auto shown = check.show([&] { return stepSeen(x, got, wanted); });
  positionFits(check, got.head<2>(), x, u[0], world.tau, turn, wanted.head<2>());
  headingFits(check, got[2], x[2], way, u, world, wanted[2]);
}

/// Particles before and after moved(), and how the car moves them without noise.
struct Moved {
  Eigen::MatrixXd before, after, still;
  Eigen::MatrixXd noise() const {
    Eigen::MatrixXd d(3, after.cols());
    for (Eigen::Index k = 0; k < d.cols(); ++k) d.col(k) = poseError(after.col(k), still.col(k));
    return d;
  }
};

/// The number of columns that fit, and whether these are only the first or only the last.
template <class Fits>
int countOf(Eigen::Index columns, const Fits& fits, bool& isFirst, bool& isLast) {
  int count = 0;
  for (Eigen::Index k = 0; k < columns; ++k) count += fits(k) ? 1 : 0;
  isFirst = count == 1 && fits(0);
  isLast = count == 1 && fits(columns - 1);
  return count;
}

/// Every particle moves, and with noise.
inline void allMove(rex::grading::Check& check, const std::string& function, const Moved& move) {
  bool isFirst = false, isLast = false;
  const Eigen::MatrixXd d = move.noise();
  const auto shown = check.show([&] { return movesSeen(move.before, move.after, move.still); });
  const int unmoved = countOf(
      d.cols(), [&](Eigen::Index k) { return move.after.col(k) == move.before.col(k); }, isFirst, isLast);
  {
    const auto all = check.ask("Do no particles move?", unmoved == d.cols());
    const auto one = check.ask(isFirst ? "Is the first particle left out?" : "Is the last particle left out?",
                               isFirst || isLast);
    check.near("number of particles that " + function + " leaves where they are", unmoved, 0, 0);
  }
  const int silent = countOf(
      d.cols(), [&](Eigen::Index k) { return d.col(k).cwiseAbs().maxCoeff() < 1e-9; }, isFirst, isLast);
  const auto all = check.ask("Is the noise left out?", silent == d.cols());
  const auto one =
      check.ask(isFirst ? "Does the first particle get no noise?" : "Does the last particle get no noise?",
                isFirst || isLast);
  check.near("number of particles that " + function + " moves without noise", silent, 0, 0);
}

/// Deviations of x, y and heading from their means.
inline Eigen::Vector3d deviationsOf(const Eigen::MatrixXd& d) {
  Eigen::Vector3d deviations;
  const double n = static_cast<double>(d.cols());
  for (int i = 0; i < 3; ++i) {
    double mean = 0, square = 0;
    for (Eigen::Index k = 0; k < d.cols(); ++k) mean += d(i, k) / n;
    for (Eigen::Index k = 0; k < d.cols(); ++k) square += (d(i, k) - mean) * (d(i, k) - mean) / n;
    deviations[i] = std::sqrt(square);
  }
  return deviations;
}

inline void widthFits(rex::grading::Check& check, const std::string& function, const Eigen::MatrixXd& d,
                      const CarWorld& world) {
  const double noise = world.dynamicsNoise;
  const Eigen::Vector3d got = deviationsOf(d);
  const auto isAll = [&](double deviation) {
    return std::all_of(got.begin(), got.end(),
                       [&](double one) { return std::abs(one / deviation - 1) < .04; });
  };
  const auto common = check.ask("Do all particles get the same noise?", got.maxCoeff() < 1e-9);
  const auto noHeading =
      check.ask("Does the heading get no noise?", got[2] < 1e-9 && std::min(got[0], got[1]) > 1e-9);
  const auto noPosition =
      check.ask("Do x and y get no noise?", std::max(got[0], got[1]) < 1e-9 && got[2] > 1e-9);
  const auto root = check.ask("Is dynamicsNoise taken for a variance? It is a standard deviation.",
                              isAll(std::sqrt(noise)));
  const auto square =
      check.ask("Is dynamicsNoise squared? It is a standard deviation.", isAll(noise * noise));
  const auto byTau = check.ask("Is the noise multiplied by tau? It is that of a step, however long it takes.",
                               isAll(world.tau * noise));
  const auto byRoot =
      check.ask("Is the noise multiplied by the root of tau? It is that of a step, however long it takes.",
                isAll(std::sqrt(world.tau) * noise));
  const auto none = check.ask("Is dynamicsNoise left out?", isAll(1));
  const auto uniform = check.ask("Are the numbers uniform? Wanted are normal ones: rng.normal().",
                                 isAll(noise / std::sqrt(3.)) || isAll(noise / std::sqrt(12.)));
  const double n = static_cast<double>(d.cols());
  check.near("standard deviations of the noise of " + function + " in x, y and heading", got,
             Eigen::Vector3d::Constant(noise), kSigmas / std::sqrt(2 * n) * noise);
}

/// The noise has that width and mean zero, is normal, and its numbers are independent of each other and of
/// those of the next particle.
inline void noiseFits(rex::grading::Check& check, const std::string& function, const Eigen::MatrixXd& d,
                      const CarWorld& world) {
  const double noise = world.dynamicsNoise, n = static_cast<double>(d.cols());
  const auto shown = check.show([&] { return noiseSeen(d, noise); });
  widthFits(check, function, d, world);
  check.near("means of the noise of " + function + " in x, y and heading", d.rowwise().mean(),
             Eigen::Vector3d::Zero(), kSigmas / std::sqrt(n) * noise);
  const Eigen::Matrix3d products = d * d.transpose();
  const Eigen::Vector3d widths = products.diagonal().cwiseSqrt();
  const Eigen::Matrix3d of = products.cwiseQuotient(widths * widths.transpose());
  const auto one = check.ask("Do x, y and heading get the same number?",
                             of(0, 1) > .95 && of(0, 2) > .95 && of(1, 2) > .95);
  check.near("correlations of the noise of " + function + ": x and y, x and heading, y and heading",
             Eigen::Vector3d(of(0, 1), of(0, 2), of(1, 2)), Eigen::Vector3d::Zero(), kSigmas / std::sqrt(n));
  const auto next = check.show([&] { return neighboursSeen(d, noise); });
  const double neighbours =
      d.leftCols(d.cols() - 1).cwiseProduct(d.rightCols(d.cols() - 1)).sum() / (3 * n * noise * noise);
  check.near("correlation of the noise of one particle and the next in " + function, neighbours, 0,
             kSigmas / std::sqrt(n));
  const auto bars = check.show([&] { return densitySeen(d, noise); });
  const double size = d.cwiseAbs().mean() / noise;
  const auto uniform = check.ask("Are the numbers uniform? Wanted are normal ones: rng.normal().",
                                 std::abs(size - std::sqrt(.75)) < .02);
  check.near("mean of the absolute noise of " + function + ", over dynamicsNoise", size, std::sqrt(2 / M_PI),
             kSigmas * .603 / std::sqrt(3 * n));
  check.atMost("largest noise of " + function + ", over dynamicsNoise", d.cwiseAbs().maxCoeff() / noise, 8);
}

/// 3000 particles, by turns in two poses.
inline void spreadsWell(rex::grading::Check& check, Student& student, double noise, double tau) {
  rex::Rng& rng = check.rng();
  CarWorld world = worldWith(2, rng);
  world.dynamicsNoise = noise;
  world.tau = tau;
  const Eigen::Vector2d u(rng.uniform(0.5, 2), rng.uniform(-0.5, 0.5));
  const Eigen::Vector3d a = randomPose(rng), b = randomPose(rng);
  Moved move{Eigen::MatrixXd(3, 3000), {}, Eigen::MatrixXd(3, 3000)};
  for (Eigen::Index k = 0; k < 3000; ++k) move.before.col(k) = k % 2 == 0 ? a : b;
  check.input(
      "3000 particles, by turns in pose a and in pose b",
      {{"a", a}, {"b", b}, {"u", u}, {"dynamicsNoise", noise}, {"tau", tau}, {"wheelbase", world.wheelbase}});
  const rex::CarSimulator map = mapOf(world);
  for (Eigen::Index k = 0; k < 3000; ++k)
    move.still.col(k) = map.getMeanStateAfterStep(move.before.col(k), u);
  const rex::remote::SplitRng given = check.split(7), second = check.split(8);
  move.after = student.moved(move.before, u, world, given);
  check.shape("states of moved", move.after, 3, 3000);
  allMove(check, "moved", move);
  noiseFits(check, "moved", move.noise(), world);
  const Eigen::MatrixXd other = student.moved(move.before, u, world, second),
                        again = student.moved(move.before, u, world, given);
  {
    const auto own = check.ask("Does moved make a generator of its own? All randomness comes from rng.");
    check.that("moved gives other noise with another rng", other != move.after);
  }
  const auto outside = check.ask("Is there other randomness, as from rand()? All randomness comes from rng.",
                                 again != move.after);
  check.that("moved gives the same noise with the same rng", again == move.after);
  const auto [once, twice] = student.movesOfTwo(move.before, u, world, given);
  const auto copy = check.ask("Does moved draw from a copy of rng? Pass rng by reference.");
  check.that("moved gives other noise when it is called again with the same rng", once != twice);
}
