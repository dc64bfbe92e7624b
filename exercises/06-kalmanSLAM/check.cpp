#include "grading/check.h"

#include "car_runs.h"
#include "interface.h"
#include "slam_runs.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// Part 1. Derivatives by finite differences are accurate to 1e-8 here.

void stepsRightly(Check& check, Student& student, const CarSetup& car) {
  Rng& rng = check.rng();
  const Eigen::Vector3d x = randomState(rng);
  const Eigen::Vector2d u = randomControl(rng);
  const auto model = CarSimulator::withoutPlaces(0, optionsOf(car));
  check.near("state after a step", student.stepped(car, x, u), model.getMeanStateAfterStep(x, u), 1e-9);
  const auto byState = [&](const Eigen::VectorXd& z) { return model.getMeanStateAfterStep(z, u); };
  const auto byControl = [&](const Eigen::VectorXd& z) { return model.getMeanStateAfterStep(x, z); };
  check.near("derivative with respect to the state", student.stepByState(car, x, u), derivative(byState, x),
             1e-6);
  check.near("derivative with respect to the control", student.stepByControl(car, x, u),
             derivative(byControl, u), 1e-6);
  check.near("covariance of the noise of a step", student.stepNoise(car),
             car.dynamicsNoise * car.dynamicsNoise * Eigen::Matrix3d::Identity(), 1e-12);
}

void seesRightly(Check& check, Student& student, const CarSetup& car, const Eigen::Vector3d& x,
                 const Eigen::Vector2d& l) {
  check.near("what is seen", student.view(car, x, l), seenFrom(car, x, l), 1e-9);
  const auto byState = [&](const Eigen::VectorXd& z) { return seenFrom(car, z, l); };
  const auto byLandmark = [&](const Eigen::VectorXd& z) { return seenFrom(car, x, z); };
  check.near("derivative with respect to the state", student.viewByState(car, x, l), derivative(byState, x),
             1e-6);
  check.near("derivative with respect to the landmark", student.viewByLandmark(car, x, l),
             derivative(byLandmark, l), 1e-6);
  check.near("covariance of a sighting", student.viewNoise(car), noiseOf(car, 1), 1e-12);
}

void carSteps(Check& check, Student& student) {
  check.input("the car from the script, random states and controls");
  check.forEachCase(10, [&](int) { stepsRightly(check, student, {}); });
}

void carSees(Check& check, Student& student) {
  check.input("metres ahead and to the left, from a random state");
  check.forEachCase(10, [&](int) {
    const Eigen::Vector3d x = randomState(check.rng());
    seesRightly(check, student, {}, x, randomLandmark(check.rng(), x));
    const Eigen::Vector2d a = check.rng().normalVector(2), b = check.rng().normalVector(2);
    check.near("difference of two sightings", student.viewGap({}, a, b), a - b, 1e-12);
  });
}

void carMeasuresAngles(Check& check, Student& student) {
  CarSetup car;
  car.rangeBearing = true;
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    check.input("distance and bearing, from a random state");
    const Eigen::Vector3d x = randomState(rng);
    seesRightly(check, student, car, x, randomLandmark(rng, x));
    check.input("two bearings; in every other case they lie on both sides of straight behind the car");
    const double a = i % 2 == 0 ? rng.uniform(2.5, 3.1) : rng.uniform(-1.5, 1.5),
                 turn = rng.uniform(0.1, 1.2);
    const double b = a + turn > kPi ? a + turn - 2 * kPi : a + turn;
    const Eigen::Vector2d from(rng.uniform(3, 9), a), to(rng.uniform(3, 9), b);
    check.near("difference of two sightings", student.viewGap(car, to, from),
               Eigen::Vector2d(to[0] - from[0], turn), 1e-9);
    check.near("difference of the same sightings in the opposite order", student.viewGap(car, from, to),
               Eigen::Vector2d(from[0] - to[0], -turn), 1e-9);
  });
}

// <hidden>
void anyCar(Check& check, Student& student) {
  check.forEachCase(20, [&](int i) {
    const CarSetup car = randomCar(check.rng(), i % 2 == 0);
    stepsRightly(check, student, car);
    const Eigen::Vector3d x = randomState(check.rng());
    seesRightly(check, student, car, x, randomLandmark(check.rng(), x));
  });
}
// </hidden>

// Part 2.

// The predicted belief, with the library's motion model and its derivative at the old mean.
Belief movedOn(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u) {
  const auto model = CarSimulator::withoutPlaces(0, optionsOf(car));
  const Eigen::Matrix3d A = model.getStateJacobian(belief.mean, u);
  return {model.getMeanStateAfterStep(belief.mean, u),
          A * belief.covariance * A.transpose() +
              car.dynamicsNoise * car.dynamicsNoise * Eigen::Matrix3d::Identity()};
}

void predicts(Check& check, Student& student, const CarSetup& car) {
  const Belief belief{randomState(check.rng()), randomCovariance(check.rng(), 3)};
  const Eigen::Vector2d u = randomControl(check.rng());
  sameBelief(check, student.predicted(car, belief, u), movedOn(car, belief, u), 1e-9);
}

void corrects(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    const int n = 1 + i, m = 1 + rng.index(7);
    check.input("a random belief about " + std::to_string(n) + " numbers, an observation of " +
                std::to_string(m));
    const Belief belief{rng.normalVector(n), randomCovariance(rng, n)};
    const Eigen::MatrixXd C = rng.normalVector(m * n).reshaped(m, n), W = randomCovariance(rng, m);
    const Eigen::VectorXd gap = rng.normalVector(m);
    sameBelief(check, student.corrected(belief, gap, C, W), informed(belief, gap, C, W), 1e-8);
  });
}

// Observations a thousand times better than the belief: a millionth of its covariance remains. The precisions
// add up; relative to their sum the covariance is the identity.
void staysACovariance(Check& check, Student& student) {
  check.input("a belief about 6 numbers and 20 observations of 3 numbers, with standard deviations of 0.001");
  Rng& rng = check.rng();
  Belief belief{rng.normalVector(6), Eigen::MatrixXd::Identity(6, 6) + 10 * randomCovariance(rng, 6)};
  Eigen::MatrixXd precision = belief.covariance.inverse();
  for (int i = 0; i < 20; ++i) {
    const Eigen::MatrixXd C = rng.normalVector(18).reshaped(3, 6);
    belief = student.corrected(belief, 1e-3 * rng.normalVector(3), C, 1e-6 * Eigen::Matrix3d::Identity());
    requireBelief(check, belief, 6);
    precision += 1e6 * C.transpose() * C;
  }
  const Eigen::MatrixXd U = precision.llt().matrixU();
  check.near("remaining covariance, relative to the wanted one", U * belief.covariance * U.transpose(),
             Eigen::MatrixXd::Identity(6, 6), 1e-3);
}

// If several landmarks are seen, the gaps are a millionth of the usual size: processing landmarks one by one
// and linearising anew for each is not wrong either, and leads to the same result.
void tracksOneStep(Check& check, Student& student, const CarSetup& car, int landmarks) {
  Rng& rng = check.rng();
  const Belief belief{randomState(rng), randomCovariance(rng, 3)};
  const Eigen::Vector2d u = randomControl(rng);
  const Belief moved = movedOn(car, belief, u);
  Eigen::Matrix2Xd places(2, landmarks);
  for (int i = 0; i < landmarks; ++i) places.col(i) = randomLandmark(rng, moved.mean);
  const Eigen::VectorXd stacked = places.reshaped();
  const Eigen::MatrixXd W = noiseOf(car, landmarks);
  const Eigen::VectorXd gap = (landmarks > 1 ? 1e-6 : 1) * W.cwiseSqrt() * rng.normalVector(2 * landmarks);
  Eigen::VectorXd y = seenFrom(car, moved.mean, stacked) + gap;
  if (car.rangeBearing)
    for (int i = 0; i < landmarks; ++i) y[2 * i + 1] = std::remainder(y[2 * i + 1], 2 * kPi);
  const Eigen::MatrixXd C =
      derivative([&](const Eigen::VectorXd& z) { return seenFrom(car, z, stacked); }, moved.mean);
  const Belief got = student.tracked(car, belief, u, places, y), wanted = informed(moved, gap, C, W);
  sameBelief(check, got, wanted, 1e-6);
  if (landmarks > 1)
    check.near("mean, after gaps of micrometres", moved.mean + gapOf(got.mean, moved.mean), wanted.mean,
               1e-9);
}

void predictsAndTracks(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    check.input("the car from the script, a random belief and control");
    predicts(check, student, {});
    check.input("the same with one landmark; speeds up to 3 m/s");
    tracksOneStep(check, student, {}, 1);
    check.input("the same with two to four landmarks, seen almost exactly as expected");
    tracksOneStep(check, student, {}, 2 + check.rng().index(3));
  });
}

// The quality of a filter, as sums over runs: the mean squared position error over the second half of a run
// [m^2], and the squared error relative to the covariance (3 numbers), averaged over the end and the middle.
struct Tracking {
  double position = 0, squared = 0;
  int count = 0;
  TrackedRun worst{};  // shown
};

void trackRun(Check& check, Student& student, const CarRun& run, Tracking& total) {
  Rng& rng = check.rng();
  const Eigen::Vector3d deviations(0.3, 0.3, 0.1);
  const Eigen::Vector3d start = run.states[0] + deviations.cwiseProduct(rng.normalVector(3));
  Belief belief{start, deviations.cwiseAbs2().asDiagonal()};
  const std::size_t T = run.controls.size();
  TrackedRun tracked{.run = run};
  for (std::size_t t = 0; t < T; ++t) {
    belief = student.tracked(run.car, belief, run.controls[t], run.landmarks, run.sightings[t]);
    requireBelief(check, belief, 3);
    const Eigen::Vector3d error = gapOf(belief.mean, run.states[t + 1]);
    tracked.beliefs.push_back(belief);
    tracked.error = std::max(tracked.error, error.head(2).norm());
    if (2 * t >= T) total.position += error.head(2).squaredNorm() / static_cast<double>(T / 2);
    if (t + 1 == T || 2 * t == T) total.squared += squaredError(error, belief.covariance) / 2;
  }
  ++total.count;
  if (tracked.error > total.worst.error) total.worst = std::move(tracked);
}

// Over 1000 seeds, the mean of squared errors is 3.03 with a standard deviation of 0.29 for the script's car,
// and 3.01 with 0.22 for fast ones. As means of many, they are gamma distributed, and exceed the bounds with
// probabilities below 1e-5. The position errors are 0.18 (0.014) m and 0.12 (0.006) m.
void requireTracking(Check& check, const Tracking& total, double mostError, double least, double most) {
  const auto shown = check.show([&] { return trackSeen(total.worst); });
  check.atMost("root mean square position error", std::sqrt(total.position / total.count), mostError, "m");
  const double squared = total.squared / total.count;
  check.atMost("squared error relative to the covariance, on average over runs (3 expected)", squared, most);
  check.atLeast("squared error relative to the covariance, on average over runs (3 expected)", squared,
                least);
}

void tracksCircle(Check& check, Student& student) {
  check.input("40 runs of 50 steps with u = (0.1, 0.2) among two landmarks");
  Tracking total;
  for (int i = 0; i < 40; ++i) trackRun(check, student, randomRun(check.rng(), {}, 2, 50, {0.1, 0.2}), total);
  requireTracking(check, total, 0.3, 1.8, 4.6);
}

// <hidden>
void tracksAnyCar(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    const CarSetup car = randomCar(check.rng(), i % 2 == 0);
    predicts(check, student, car);
    tracksOneStep(check, student, car, 1 + i % 4);
  });
}

void tracksFast(Check& check, Student& student) {
  Tracking total;
  for (int i = 0; i < 60; ++i) {
    CarSetup car;
    car.rangeBearing = i % 2 == 0;
    trackRun(check, student, randomRun(check.rng(), car, 4, 40, {1.3, i % 3 == 0 ? -0.2 : 0.2}), total);
  }
  requireTracking(check, total, 0.25, 2, 4.5);
}
// </hidden>

// Part 3.

// The beliefs of the grader's filter on a run.
std::vector<Belief> filteredRun(Rng& rng, const CarRun& run) {
  const Eigen::Vector3d deviations(0.3, 0.3, 0.1);
  const Eigen::Vector3d start = run.states[0] + deviations.cwiseProduct(rng.normalVector(3));
  std::vector<Belief> filtered{{start, Eigen::Matrix3d(deviations.cwiseAbs2().asDiagonal())}};
  const Eigen::VectorXd places = run.landmarks.reshaped();
  for (std::size_t t = 0; t < run.controls.size(); ++t) {
    const Belief moved = movedOn(run.car, filtered.back(), run.controls[t]);
    const Eigen::MatrixXd C =
        derivative([&](const Eigen::VectorXd& z) { return seenFrom(run.car, z, places); }, moved.mean);
    Belief next = informed(moved, run.sightings[t] - seenFrom(run.car, moved.mean, places), C,
                           noiseOf(run.car, run.landmarks.cols()));
    next.covariance = 0.5 * (next.covariance + next.covariance.transpose()).eval();
    filtered.push_back(next);
  }
  return filtered;
}

// All states of a run at once, as one large Gaussian over deviations from the filter's means. Each transition
// adds a precision, and each observation adds what it added to the filter.
std::vector<Belief> allAtOnce(const CarRun& run, const std::vector<Belief>& filtered) {
  const auto count = static_cast<Eigen::Index>(filtered.size());
  const auto model = CarSimulator::withoutPlaces(0, optionsOf(run.car));
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(3 * count);
  precision.topLeftCorner(3, 3) = filtered[0].covariance.inverse();
  for (Eigen::Index t = 0; t + 1 < count; ++t) {
    const Belief &now = filtered[static_cast<std::size_t>(t)],
                 &next = filtered[static_cast<std::size_t>(t + 1)];
    const Eigen::Vector2d& u = run.controls[static_cast<std::size_t>(t)];
    const Belief moved = movedOn(run.car, now, u);
    // x' - f(mean) - A (x - mean) is noise.
    Eigen::MatrixXd J(3, 6);
    J << -model.getStateJacobian(now.mean, u), Eigen::Matrix3d::Identity();
    const double weight = 1 / (run.car.dynamicsNoise * run.car.dynamicsNoise);
    precision.block(3 * t, 3 * t, 6, 6) += weight * J.transpose() * J;
    pull.segment(3 * t, 6) += weight * J.transpose() * (moved.mean - next.mean);
    // The observation, as what it added to the predicted belief.
    const Eigen::MatrixXd before = moved.covariance.inverse();
    precision.block(3 * t + 3, 3 * t + 3, 3, 3) += next.covariance.inverse() - before;
    pull.segment(3 * t + 3, 3) += before * (next.mean - moved.mean);
  }
  const Eigen::MatrixXd covariance = precision.inverse();
  const Eigen::VectorXd shift = covariance * pull;
  std::vector<Belief> all = filtered;
  for (Eigen::Index t = 0; t < count; ++t) {
    all[static_cast<std::size_t>(t)].mean += shift.segment(3 * t, 3);
    all[static_cast<std::size_t>(t)].covariance = covariance.block(3 * t, 3 * t, 3, 3);
  }
  return all;
}

void smoothsAsAWhole(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    check.input("a filter's beliefs over 12 steps; compared with all states estimated at once");
    const CarSetup car = i == 0 ? CarSetup{} : randomCar(check.rng(), false);
    const CarRun run = randomRun(check.rng(), car, 2, 12, {1.5, 0.3});
    const std::vector<Belief> filtered = filteredRun(check.rng(), run), all = allAtOnce(run, filtered);
    const std::vector<Belief> smooth = student.hindsight(car, filtered, run.controls);
    check.near("number of beliefs", static_cast<double>(smooth.size()), static_cast<double>(all.size()), 0);
    for (std::size_t t = 0; t < all.size(); ++t) sameBelief(check, smooth[t], all[t], 1e-7);
  });
}

// <hidden>
// Over 400 seeds: a ratio of 0.70 with a standard deviation of 0.03, squared errors of 3.03 with 0.37.
void smoothsBetter(Check& check, Student& student) {
  double before = 0, after = 0, squared = 0;
  constexpr int kRuns = 40;
  for (int i = 0; i < kRuns; ++i) {
    const CarRun run = randomRun(check.rng(), {}, 2, 60, {0.5, 0.2});
    const std::vector<Belief> filtered = filteredRun(check.rng(), run);
    const std::vector<Belief> smooth = student.hindsight(run.car, filtered, run.controls);
    check.near("number of beliefs", static_cast<double>(smooth.size()), static_cast<double>(filtered.size()),
               0);
    for (std::size_t t = 0; t < smooth.size(); ++t) {
      requireBelief(check, smooth[t], 3);
      before += (filtered[t].mean - run.states[t]).head(2).squaredNorm();
      after += (smooth[t].mean - run.states[t]).head(2).squaredNorm();
    }
    squared += squaredError(gapOf(smooth[30].mean, run.states[30]), smooth[30].covariance) / kRuns;
  }
  check.atMost("position error of the smoother / position error of the filter", std::sqrt(after / before),
               0.9);
  check.atMost("squared error relative to the covariance, on average over runs (3 expected)", squared, 5);
  check.atLeast("squared error relative to the covariance, on average over runs (3 expected)", squared, 1.5);
}
// </hidden>

// Part 4.

void predictsJointly(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    check.input("a random joint belief about the car and " + std::to_string(i) + " landmarks");
    const CarSetup car = i < 2 ? CarSetup{} : randomCar(check.rng(), false);
    const Belief joint = randomJoint(check.rng(), i);
    const Eigen::Vector2d u = randomControl(check.rng());
    // The whole state at once, by finite differences.
    const auto model = CarSimulator::withoutPlaces(0, optionsOf(car));
    const auto f = [&](Eigen::VectorXd z) {
      z.head(3) = model.getMeanStateAfterStep(z.head(3), u);
      return z;
    };
    const Eigen::MatrixXd F = derivative(f, joint.mean);
    Belief wanted{f(joint.mean), F * joint.covariance * F.transpose()};
    wanted.covariance.topLeftCorner(3, 3).diagonal().array() += car.dynamicsNoise * car.dynamicsNoise;
    sameBelief(check, student.jointPredicted(car, joint, u), wanted, 1e-6);
  });
}

void correctsJointly(Check& check, Student& student) {
  check.forEachCase(8, [&](int k) {
    const int count = 1 + k % 4, i = check.rng().index(count);
    check.input("a random joint belief about the car and " + std::to_string(count) + " landmarks, number " +
                std::to_string(i) + " seen; " + (k < 4 ? "metres ahead and left" : "distance and bearing"));
    CarSetup car;
    car.rangeBearing = k >= 4;
    const Belief joint = randomJoint(check.rng(), count);
    const auto g = [&](const Eigen::VectorXd& z) {
      return seenFrom(car, z.head(3), z.segment(3 + 2 * i, 2));
    };
    const Eigen::Vector2d gap = noiseOf(car, 1).cwiseSqrt() * check.rng().normalVector(2);
    Eigen::Vector2d y = g(joint.mean) + gap;
    if (car.rangeBearing) y[1] = std::remainder(y[1], 2 * kPi);
    sameBelief(check, student.jointCorrected(car, joint, i, y),
               informed(joint, gap, derivative(g, joint.mean), noiseOf(car, 1)), 1e-6);
  });
}

// The new landmark is treated as an unknown that is seen: since nothing was known about it before, the
// canonical form of the larger belief is that of the smaller one plus the sighting.
void startsLandmarks(Check& check, Student& student) {
  check.forEachCase(8, [&](int k) {
    const int count = k % 4, n = 3 + 2 * count;
    check.input("a joint belief about the car and " + std::to_string(count) +
                " landmarks; one more is seen, by " +
                (k < 4 ? "metres ahead and left" : "distance and bearing"));
    CarSetup car;
    car.rangeBearing = k >= 4;
    const Belief joint = randomJoint(check.rng(), count);
    const Eigen::Vector2d l = randomLandmark(check.rng(), joint.mean.head(3)),
                          y = seenFrom(car, joint.mean.head(3), l);
    Belief wanted{Eigen::VectorXd(n + 2), Eigen::MatrixXd::Zero(n + 2, n + 2)};
    wanted.mean << joint.mean, l;
    const auto g = [&](const Eigen::VectorXd& z) { return seenFrom(car, z.head(3), z.tail(2)); };
    const Eigen::MatrixXd C = derivative(g, wanted.mean);
    wanted.covariance.topLeftCorner(n, n) = joint.covariance.inverse();
    wanted.covariance += C.transpose() * noiseOf(car, 1).inverse() * C;
    wanted.covariance = wanted.covariance.inverse().eval();
    sameBelief(check, student.withLandmark(car, joint, y), wanted, 1e-6);
  });
}

// Over 400 seeds: the landmark error is 0.071 m with a standard deviation of 0.006 m, the squared error 1.02
// with 0.13.
void mapsRing(Check& check, Student& student) {
  check.input(
      "10 runs of 70 steps, more than a full circle, among five landmarks; all are seen in each step");
  MapQuality total;
  for (int i = 0; i < 10; ++i) {
    const CarRun run = randomRun(check.rng(), {}, 5, 70, {1, 0.2});
    judgeMap(check, run, mapped(check, student, run, 100), total);
  }
  requireMap(check, total, 0.35, 0.4, 1.9);
}

// <hidden>
void mapsAnyRing(Check& check, Student& student) {
  MapQuality total;
  for (int i = 0; i < 10; ++i) {
    CarSetup car;
    car.rangeBearing = i % 2 == 0;
    car.dynamicsNoise = 0.02;
    const CarRun run = randomRun(check.rng(), car, 5 + i % 3, 65, {1, i % 3 == 0 ? -0.2 : 0.2});
    judgeMap(check, run, mapped(check, student, run, 18), total);
  }
  requireMap(check, total, 0.5, 0.4, 1.9);
}
// </hidden>

// Part 5.

// None of 400 seeds fails here or in the hidden check. Overall the landmark error is 0.08 m with a standard
// deviation of 0.03 m; without corrections it is 0.7 m (0.3 m).
void findsLandmarks(Check& check, Student& student) {
  namesByCovariance(check, student);
  check.input(
      "three runs of 70 steps among five to seven landmarks without names, seen from up to 18 m away");
  for (int i = 0; i < 3; ++i) {
    CarSetup car;
    car.dynamicsNoise = 0.02;
    judgeNameless(check, student, clearRun(check.rng(), car, 5 + i, {1, 0.2}, 18), 18);
  }
}

// <hidden>
void findsAnyLandmarks(Check& check, Student& student) {
  namesByCovariance(check, student);
  for (int i = 0; i < 4; ++i) {
    CarSetup car;
    car.rangeBearing = i % 2 == 0;
    car.dynamicsNoise = 0.02;
    if (car.rangeBearing) car.observationNoise = 0.2;
    judgeNameless(check, student, clearRun(check.rng(), car, 5 + i % 3, {1, -0.2}, 20), 20);
  }
}
// </hidden>

void weighsParticles(Check& check, Student& student) {
  check.forEachCase(6, [&](int k) {
    CarSetup car;
    car.rangeBearing = k % 2 == 1;
    check.input(
        std::string("12 particles with three landmarks each; two of these and a new one are seen, by ") +
        (car.rangeBearing ? "distance and bearing" : "metres ahead and left") +
        (k < 4 ? "" : "; all particles are far off"));
    weighsAsItShould(check, student, car, k < 4 ? 0 : 60);
  });
}

// <hidden>
// Draws as many particles as there are, in proportion to their weights, with one random number.
std::vector<MapParticle> drawn(Rng& rng, const std::vector<MapParticle>& particles) {
  const auto n = static_cast<double>(particles.size());
  std::vector<MapParticle> survivors;
  double sum = 0, next = rng.uniform() / n;
  for (const MapParticle& particle : particles) {
    sum += particle.weight;
    for (; next < sum && survivors.size() < particles.size(); next += 1 / n) {
      survivors.push_back(particle);
      survivors.back().weight = 1 / n;
    }
  }
  while (survivors.size() < particles.size()) survivors.push_back(survivors.back());
  return survivors;
}

// FastSLAM 1: the grader moves and resamples particles, the student updates maps and weights. Returns the map
// of the particle with the largest weight.
Eigen::Matrix2Xd particleMap(Check& check, Student& student, const CarRun& run) {
  constexpr std::size_t kParticles = 50;
  Rng& rng = check.rng();
  const auto model = CarSimulator::withoutPlaces(0, optionsOf(run.car));
  std::vector<MapParticle> particles(kParticles, {Eigen::Vector3d::Zero(), 1. / kParticles, {}});
  for (std::size_t t = 0; t < run.controls.size(); ++t) {
    for (MapParticle& particle : particles)
      particle.x = model.getMeanStateAfterStep(particle.x, run.controls[t]) +
                   run.car.dynamicsNoise * rng.normalVector(3);
    const std::vector<MapParticle> before = particles;
    particles = student.weighed(run.car, before, seenAt(run, t, 100));
    check.near("number of particles", static_cast<double>(particles.size()), kParticles, 0);
    for (std::size_t k = 0; k < kParticles; ++k)
      check.near("state of a particle", particles[k].x, before[k].x, 0);
    double sum = 0, squares = 0;
    for (const MapParticle& particle : particles) {
      check.that("weights are not negative", particle.weight >= 0);
      sum += particle.weight;
      squares += particle.weight * particle.weight;
      check.near("number of landmarks in a map", static_cast<double>(particle.map.size()),
                 static_cast<double>(run.landmarks.cols()), 0);
      for (const Belief& landmark : particle.map) requireBelief(check, landmark, 2);
    }
    check.near("sum of all weights", sum, 1, 1e-9);
    if (t + 1 < run.controls.size() && 1 / squares < 0.5 * kParticles) particles = drawn(rng, particles);
  }
  const auto& best =
      *std::max_element(particles.begin(), particles.end(),
                        [](const MapParticle& a, const MapParticle& b) { return a.weight < b.weight; });
  Eigen::Matrix2Xd places(2, run.landmarks.cols());
  for (std::size_t i = 0; i < best.map.size(); ++i)
    places.col(static_cast<Eigen::Index>(i)) = best.map[i].mean;
  return places;
}

// The noise of the motion is large, so that the particles spread and their weights matter. Over 16 seeds the
// error of the reference solution is at most 0.064 m, and with equal weights at least 0.279 m.
void mapsWithParticles(Check& check, Student& student) {
  double squared = 0;
  for (int i = 0; i < 4; ++i) {
    const CarRun run =
        randomRun(check.rng(), {.dynamicsNoise = 0.08, .observationNoise = 0.3}, 3 + i, 50, {1, 0.2});
    squared += std::pow(absoluteTrajectoryError(particleMap(check, student, run), run.landmarks), 2) / 4;
  }
  check.atMost("root mean square error of the landmarks after alignment", std::sqrt(squared), 0.15, "m");
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"car-step", "models", "A step and its derivatives", 1, Group::kVisible, carSteps},
      {"car-view", "models", "Landmarks ahead and to the left", 1, Group::kVisible, carSees},
      {"car-bearing", "models", "Landmarks by distance and bearing", 1, Group::kVisible, carMeasuresAngles},
      {"kf-step", "filter", "One step of the filter", 1, Group::kVisible, predictsAndTracks},
      {"kf-correct", "filter", "The correction, against the canonical form", 1, Group::kVisible, corrects},
      {"kf-covariance", "filter", "A covariance stays a covariance", 1, Group::kVisible, staysACovariance},
      {"kf-track", "filter", "Tracking the car from the script", 1, Group::kVisible, tracksCircle},
      {"rts-batch", "smoother", "Smoothing equals estimating all states at once", 1, Group::kVisible,
       smoothsAsAWhole},
      {"slam-predict", "slam", "The joint belief after a step", 1, Group::kVisible, predictsJointly},
      {"slam-correct", "slam", "The joint belief after a sighting", 1, Group::kVisible, correctsJointly},
      {"slam-start", "slam", "A landmark seen for the first time", 1, Group::kVisible, startsLandmarks},
      {"slam-map", "slam", "A map of five landmarks", 1, Group::kVisible, mapsRing},
      {"names-found", "hard", "Landmarks without names", 1, Group::kVisible, findsLandmarks},
      {"particles-weigh", "hard", "Maps and weights of particles", 1, Group::kVisible, weighsParticles},
      // <hidden>
      {"car-any", "models", "Other cars", 1, Group::kHidden, anyCar},
      {"kf-any", "filter", "Other cars, both sensors", 1, Group::kHidden,
       [](Check& check, Student& student) {
         tracksAnyCar(check, student);
         tracksFast(check, student);
       }},
      {"rts-better", "smoother", "The smoother is better than the filter", 1, Group::kHidden, smoothsBetter},
      {"slam-any", "slam", "Other maps, with landmarks that appear during the drive", 1, Group::kHidden,
       mapsAnyRing},
      {"names-any", "hard", "More landmarks without names, both sensors", 1, Group::kHidden,
       findsAnyLandmarks},
      {"particles-map", "hard", "A map by FastSLAM", 1, Group::kHidden, mapsWithParticles},
      // </hidden>
  };
}
