#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "motion_checks.h"

// Parts 2 and 6: what the car sees, how likely that is, and weights, against the library's.

/// How an observation could be weighed, rightly and by usual mistakes.
struct Weighing {
  bool isPolar = false;
  double first = 1, second = 1;  ///< divisors of squared errors: variances, if all is right
  int turns = 1000;              ///< whole turns that a difference of bearings may lose; 0: none
  double half = .5;
  Eigen::Index numbers = std::numeric_limits<Eigen::Index>::max();  ///< how many count

  Eigen::VectorXd logarithms(const CarWorld& world, const Eigen::MatrixXd& states,
                             const Eigen::VectorXd& y) const {
    const rex::CarSimulator map = mapOf(world);
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(states.cols());
    for (Eigen::Index k = 0; k < states.cols(); ++k) {
      const Eigen::VectorXd seen = map.getMeanObservationAtState(states.col(k));
      for (Eigen::Index i = 0; i < std::min(numbers, y.size()); ++i) {
        double error = y[i] - seen[i];
        for (int turn = 0; isPolar && i % 2 == 1 && turn < turns && std::abs(error) > M_PI; ++turn)
          error -= std::copysign(2 * M_PI, error);
        sums[k] -= half * error * error / (i % 2 == 0 ? first : second);
      }
    }
    return (sums.array() - sums[0]).matrix();
  }
};

/// Compares the differences from the first, since a constant is free. The tolerance is relative to the
/// largest of the numbers.
inline void logarithmsFit(rex::grading::Check& check, const Eigen::VectorXd& got, const CarWorld& world,
                          const Eigen::MatrixXd& states, const Eigen::VectorXd& y) {
  check.shape("result of logLikelihoods", got, states.cols(), 1);
  const Eigen::VectorXd all = logDensities(world, states, y), wanted = (all.array() - all[0]).matrix();
  const double sigma = world.observationNoise, angle = world.rangeBearing ? world.bearingNoise : sigma;
  const Weighing right{.isPolar = world.rangeBearing, .first = sigma * sigma, .second = angle * angle};
  const auto wrongly = [&](const char* question, const std::function<void(Weighing&)>& change) {
    Weighing wrong = right;
    change(wrong);
    return check.suspect(question, wrong.logarithms(world, states, y));
  };
  const auto notSquared = wrongly("Is the noise not squared? It is a standard deviation.", [&](Weighing& w) {
    w.first = sigma;
    w.second = angle;
  });
  const auto noNoise = wrongly("Is the noise left out? The formula on the sheet is for a noise of 1.",
                               [](Weighing& w) { w.first = w.second = 1; });
  const auto noHalf = wrongly("Is the factor 1/2 left out?", [](Weighing& w) { w.half = 1; });
  const auto times = wrongly("Is it multiplied by the variance? Wanted is divided.", [&](Weighing& w) {
    w.first = 1 / (sigma * sigma);
    w.second = 1 / (angle * angle);
  });
  const auto few = wrongly("Is only the first landmark counted?", [](Weighing& w) { w.numbers = 2; });
  const auto fewer = wrongly("Is only the first number counted?", [](Weighing& w) { w.numbers = 1; });
  const auto never =
      wrongly("Are bearings compared without regard to whole turns?", [](Weighing& w) { w.turns = 0; });
  const auto once = wrongly("Is a whole turn taken away only once? Bearings in y may be any angles.",
                            [](Weighing& w) { w.turns = 1; });
  const auto same =
      wrongly("Is the noise of distances used for bearings, too?", [](Weighing& w) { w.second = w.first; });
  const auto swapped =
      wrongly("Are both noises exchanged?", [](Weighing& w) { std::swap(w.first, w.second); });
  const auto likelihoods = check.ask("Are these the likelihoods? Wanted are their logarithms.",
                                     got.minCoeff() >= 0 && got.maxCoeff() <= 1);
  const auto equal = check.ask("Do all particles get the same?", got.minCoeff() == got.maxCoeff());
  check.near("logLikelihoods, relative to that of the first particle", (got.array() - got[0]).matrix(),
             wanted, 1e-9 * (1 + all.cwiseAbs().maxCoeff()));
}

/// How far each landmark is ahead and to the left.
inline void cartesianFits(rex::grading::Check& check, const Eigen::VectorXd& got, const Eigen::Vector3d& x,
                          const CarWorld& world, const Eigen::VectorXd& wanted) {
  const double heading = x[2], c = std::cos(heading), s = std::sin(heading);
  const Eigen::Index count = world.landmarks.cols();
  // From the landmark (a, b), two numbers.
  const auto seenBy = [&](const std::function<Eigen::Vector2d(double, double)>& seen) {
    Eigen::VectorXd wrong(2 * count);
    for (Eigen::Index i = 0; i < count; ++i)
      wrong.segment<2>(2 * i) = seen(world.landmarks(0, i), world.landmarks(1, i));
    return wrong;
  };
  using V = Eigen::Vector2d;
  const auto ahead = [&](double a, double b) { return c * (a - x[0]) + s * (b - x[1]); };
  const auto left = [&](double a, double b) { return c * (b - x[1]) - s * (a - x[0]); };
  Eigen::VectorXd inRows(2 * count);
  for (Eigen::Index i = 0; i < 2 * count; ++i) inRows[i % 2 * count + i / 2] = wanted[i];
  check.near(
      "view of viewFrom: ahead and left of each landmark", got, wanted, 1e-9,
      {{"Is the heading left out? Wanted is the frame of the car.",
        seenBy([&](double a, double b) { return V(a - x[0], b - x[1]); })},
       {"Is the position of the car left out?",
        seenBy([&](double a, double b) { return V(c * a + s * b, c * b - s * a); })},
       {"Is left before ahead?", seenBy([&](double a, double b) { return V(left(a, b), ahead(a, b)); })},
       {"Are the landmarks measured to the right? Wanted is to the left.",
        seenBy([&](double a, double b) { return V(ahead(a, b), -left(a, b)); })},
       {"Are all the numbers ahead listed before those to the left? Wanted is one landmark after the other.",
        inRows}},
      "m");
}

inline void bearingFits(rex::grading::Check& check, double got, const Eigen::Vector2d& arrow, double heading,
                        double wanted) {
  const double c = std::cos(heading), s = std::sin(heading);
  const Eigen::Vector2d seen(c * arrow.x() + s * arrow.y(), c * arrow.y() - s * arrow.x());
  check.nearAngle(
      "bearing of a landmark by viewFrom with rangeBearing", got, wanted, 1e-9,
      {{"Are the arguments of atan2 exchanged?", std::atan2(seen.x(), seen.y())},
       {"Is it atan of the quotient? It does not tell ahead from behind.", std::atan(seen.y() / seen.x())}});
  const auto turns = check.ask("Is a whole turn missing after the heading was subtracted?");
  check.atMost("size of a bearing of viewFrom", std::abs(got), 3.1415926536, "rad");
}

inline void polarFits(rex::grading::Check& check, const Eigen::VectorXd& got, const Eigen::Vector3d& x,
                      const CarWorld& world, const Eigen::VectorXd& wanted) {
  CarWorld plain = world;
  plain.rangeBearing = false;
  const Eigen::VectorXd positions = mapOf(plain).getMeanObservationAtState(x);
  const auto ignored =
      check.ask("Are these still the positions? With rangeBearing they are distances and bearings.",
                (got - positions).cwiseAbs().maxCoeff() < 1e-9);
  for (Eigen::Index i = 0; 2 * i < wanted.size(); ++i) {
    const Eigen::Vector2d arrow = world.landmarks.col(i) - x.head<2>();
    const auto square = check.suspect("Is the root left out?", arrow.squaredNorm());
    const auto order = check.suspect("Does the bearing come first?", wanted[2 * i + 1]);
    check.near("distance of a landmark by viewFrom with rangeBearing", got[2 * i], wanted[2 * i], 1e-9, "m");
    bearingFits(check, got[2 * i + 1], arrow, x[2], wanted[2 * i + 1]);
  }
}

inline void viewFits(rex::grading::Check& check, Student& student, const CarWorld& world,
                     const Eigen::Vector3d& x) {
  check.input(world.rangeBearing ? "a car, with rangeBearing" : "a car",
              {{"x", x}, {"landmarks", world.landmarks}});
  const Eigen::VectorXd got = student.viewFrom(x, world), wanted = mapOf(world).getMeanObservationAtState(x);
  check.shape("result of viewFrom", got, wanted.size(), 1);
  const auto shown = check.show([&] { return viewSeen(got, wanted, world.rangeBearing); });
  if (world.rangeBearing)
    polarFits(check, got, x, world, wanted);
  else
    cartesianFits(check, got, x, world, wanted);
}

inline Eigen::MatrixXd posesAround(const Eigen::Vector3d& x, double distance, double angle, int count,
                                   rex::Rng& rng) {
  Eigen::MatrixXd states(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    states.col(i) =
        x + Eigen::Vector3d(distance * rng.normal(), distance * rng.normal(), angle * rng.normal());
  return states;
}

/// A car with two landmarks that sees them with noise, and 12 particles around it. Every other car has a
/// landmark behind it, where bearings jump. In y they are up to three turns off.
inline void likelihoodsFit(rex::grading::Check& check, Student& student, CarWorld world, bool isBehind) {
  rex::Rng& rng = check.rng();
  Eigen::Vector3d x = randomPose(rng);
  if (isBehind) x[2] = std::atan2(x[1] - world.landmarks(1, 0), x[0] - world.landmarks(0, 0));
  const Driven one = drive(world, x, {0.1, isBehind ? 0 : 0.2}, 1, rng);
  Eigen::VectorXd y = one.log.observations[0];
  if (world.rangeBearing && !isBehind) y[3] += 2 * M_PI * (rng.index(7) - 3);
  const Eigen::MatrixXd states = posesAround(one.truth[0], 0.3, 0.05, 12, rng);
  const auto given = [&](const std::string& text) {
    check.input(text, {{"states", states},
                       {"y", y},
                       {"landmarks", world.landmarks},
                       {"observationNoise", world.observationNoise}});
  };
  given(world.rangeBearing
            ? "12 particles, with rangeBearing, bearingNoise = " + std::to_string(world.bearingNoise)
            : "12 particles");
  logarithmsFit(check, student.logLikelihoods(states, y, world), world, states, y);
}

/// The weights that belong to logarithms, shifted so that the largest is zero.
inline Eigen::VectorXd weightsBeside(const Eigen::VectorXd& logarithms) {
  const Eigen::VectorXd parts = (logarithms.array() - logarithms.maxCoeff()).exp().matrix();
  return parts / parts.sum();
}

/// The weights fit the logarithms, some of which may be -infinity.
inline void weightsFit(rex::grading::Check& check, const Eigen::VectorXd& got,
                       const Eigen::VectorXd& logarithms) {
  check.shape("result of weightsOf", got, logarithms.size(), 1);
  const Eigen::VectorXd wanted = weightsBeside(logarithms);
  const double sum = got.sum();
  const auto shown = check.show([&] { return weightsSeen("Weights", got, wanted); });
  const auto logs = check.ask("Are these still logarithms?", got.maxCoeff() <= 0 && got.minCoeff() < 0);
  const auto notDivided = check.ask("Are the weights not divided by their sum?",
                                    sum > 0 && (got - sum * wanted).isZero(1e-9 * sum));
  const auto none =
      check.ask("Are all weights zero? If each exp is zero by itself, a common factor helps.", got.isZero(0));
  check.near("sum of the weights of weightsOf", sum, 1, 1e-9);
  check.near("weights of weightsOf", got, wanted, 1e-9,
             {{"Is every exp zero by itself? Only differences of logarithms count: which factor may all "
               "weights have?",
               Eigen::VectorXd::Constant(got.size(), 1. / static_cast<double>(got.size()))}});
}
