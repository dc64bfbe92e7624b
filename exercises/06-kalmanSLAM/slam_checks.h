#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "filter_checks.h"
#include "model_checks.h"

// Part 4: joint beliefs about a car and landmarks.

/// The parts of a joint belief whose covariance and mean are compared one after another: those numbers and
/// the rest.
inline std::vector<BeliefPart> jointParts(const std::string& first, const std::vector<int>& numbers,
                                          int size) {
  std::vector<int> others;
  for (int i = 0; i < size; ++i)
    if (std::find(numbers.begin(), numbers.end(), i) == numbers.end()) others.push_back(i);
  std::vector<BeliefPart> parts{{"covariance of " + first, numbers, numbers}};
  if (!others.empty()) {
    parts.push_back({"covariance of " + first + " with the rest", numbers, others});
    parts.push_back({"covariance of the rest", others, others});
  }
  parts.push_back({"mean of " + first, numbers, {}});
  if (!others.empty()) parts.push_back({"mean of the rest", others, {}});
  return parts;
}

inline std::vector<WrongBelief> wrongJointSteps(const CarSetup& car, const Belief& joint,
                                                const Belief& wanted, const Eigen::MatrixXd& F) {
  const Eigen::Index rest = joint.mean.size() - 3;
  const double variance = car.dynamicsNoise * car.dynamicsNoise;
  const auto with = [&](const Eigen::MatrixXd& covariance) { return Belief{wanted.mean, covariance}; };
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(rest + 3, rest + 3), cross = wanted.covariance, noisy = cross;
  Q.diagonal().head(3).setConstant(variance);
  cross.topRightCorner(3, rest) = joint.covariance.topRightCorner(3, rest);
  cross.bottomLeftCorner(rest, 3) = joint.covariance.bottomLeftCorner(rest, 3);
  noisy.diagonal().tail(rest).array() += variance;
  return {{"Is nothing changed?", joint},
          {"Is Q left out?", with(sum(wanted.covariance, Q, -1))},
          {"Is A left out?", with(sum(joint.covariance, Q))},
          {"Is A transposed on the wrong side?", with(sum(carried(transposed(F), joint.covariance), Q))},
          {"Do the covariances of the car with the landmarks stay? A changes them, too.", with(cross)},
          {"Is there noise on the landmarks? They do not move.", with(noisy)}};
}

inline void predictsJointly(rex::grading::Check& check, Student& student, const CarSetup& car,
                            int landmarks) {
  const Belief joint = randomJoint(check.rng(), landmarks);
  const Eigen::Vector2d u = randomControl(check.rng());
  check.input(described(car), {{"x", joint.mean.head(3)},
                               {"u", u},
                               {"first three rows of the covariance", joint.covariance.topRows(3)}});
  // The whole state at once, by finite differences.
  const auto model = rex::CarSimulator::withoutPlaces(0, optionsOf(car));
  const auto f = [&](Eigen::VectorXd z) {
    z.head(3) = model.getMeanStateAfterStep(z.head(3), u);
    return z;
  };
  const Eigen::MatrixXd F = derivative(f, joint.mean);
  Belief wanted{f(joint.mean), carried(F, joint.covariance)};
  wanted.covariance.topLeftCorner(3, 3).diagonal().array() += car.dynamicsNoise * car.dynamicsNoise;
  const BeliefFunction function{"jointPredicted",
                                jointParts("the car", numbersFrom(0, 3), 3 + 2 * landmarks)};
  sameBelief(check, function, student.jointPredicted(car, joint, u), wanted, 1e-6,
             wrongJointSteps(car, joint, wanted, F));
}

inline std::vector<WrongBelief> wrongSightings(const Belief& joint, int i, const Observation& seen,
                                               const Belief& wanted, const Eigen::Vector2d& unwrapped) {
  const Eigen::Index n = joint.mean.size(), at = 3 + 2 * i, next = at + 2 < n ? at + 2 : 3;
  const auto withC = [&](const Eigen::MatrixXd& C) { return informed(joint, {seen.gap, C, seen.W}); };
  Eigen::MatrixXd ofCar = seen.C, ofLandmark = seen.C, shifted = seen.C, minus = seen.C;
  ofCar.middleCols(at, 2).setZero();
  ofLandmark.leftCols(3).setZero();
  shifted.middleCols(at, 2).setZero();
  shifted.middleCols(next, 2) = seen.C.middleCols(at, 2);
  minus.middleCols(at, 2) *= -1;
  std::vector<int> touched = numbersFrom(0, 3);
  touched.insert(touched.end(), {static_cast<int>(at), static_cast<int>(at) + 1});
  Belief others = joint;
  for (const int row : touched) {
    others.mean[row] = wanted.mean[row];
    for (const int col : touched) others.covariance(row, col) = wanted.covariance(row, col);
  }
  std::vector<WrongBelief> wrong{
      {"Is nothing corrected?", joint},
      {"Is the derivative by the landmark left out? Its position is uncertain, too.", withC(ofCar)},
      {"Is the derivative by the car left out? Its pose is uncertain, too.", withC(ofLandmark)},
      {"Are the columns those of another landmark?", withC(shifted)},
      {"Does the derivative by the landmark have the wrong sign?", withC(minus)},
      {"Are only the car and the landmark corrected? All numbers that are correlated with them change.",
       others},
      {"Is the difference of the bearings not wrapped? viewGap does it.",
       informed(joint, {unwrapped, seen.C, seen.W})},
      {"Is the expected view subtracted the wrong way round?",
       {sum(sum(joint.mean, joint.mean), wanted.mean, -1), wanted.covariance}}};
  return wrong;
}

/// With bearings, every other landmark is behind the car, seen to the right of it and expected to the left.
inline void correctsJointly(rex::grading::Check& check, Student& student, const CarSetup& car, int landmarks,
                            bool isBehind) {
  const int i = check.rng().index(landmarks), at = 3 + 2 * i;
  Belief joint = randomJoint(check.rng(), landmarks);
  Eigen::Vector2d gap = noiseOf(car, 1).diagonal().cwiseSqrt().cwiseProduct(check.rng().normalVector(2));
  if (isBehind) {
    joint.mean.segment(at, 2) = placeBehind(check.rng(), joint.mean.head(3));
    gap[1] = std::abs(gap[1]) + 2e-3;
  }
  const auto g = [&](const Eigen::VectorXd& z) { return seenFrom(car, z.head(3), z.segment(at, 2)); };
  const Eigen::Vector2d expected = g(joint.mean), y = gapsOf(car, expected + gap, Eigen::Vector2d::Zero());
  std::vector<int> five = numbersFrom(0, 3);
  five.insert(five.end(), {at, at + 1});
  check.input(fmt::format("landmark {} of {}, {}", i, landmarks, described(car)),
              {{"x", joint.mean.head(3)},
               {"l", joint.mean.segment(at, 2)},
               {"their covariance", joint.covariance(five, five)},
               {"y", y}});
  const auto change = [&](const Eigen::VectorXd& z) { return gapsOf(car, g(z), expected); };
  const Observation seen{gap, derivative(change, joint.mean), noiseOf(car, 1)};
  const Belief wanted = informed(joint, seen);
  const BeliefFunction function{"jointCorrected", jointParts("car and landmark", five, 3 + 2 * landmarks)};
  sameBelief(check, function, student.jointCorrected(car, joint, i, y), wanted, 1e-6,
             wrongSightings(joint, i, seen, wanted, y - expected));
}

inline std::vector<std::pair<const char*, Eigen::Vector2d>> wrongPlaces(const CarSetup& car,
                                                                        const Eigen::Vector3d& x,
                                                                        const Eigen::Vector2d& y) {
  const auto place = [&](const CarSetup& setup, const Eigen::Vector3d& from) -> Eigen::Vector2d {
    return rex::landmarkPosition(sensorOf(setup), from, y).landmark;
  };
  return {{"Is the heading of the car left out?", place(car, {x[0], x[1], 0})},
          {"Is y rotated the wrong way, from the frame of the world to that of the car?",
           place(car, mirrored(x))},
          {"Is the position of the car left out?", place(car, x) - x.head<2>()},
          {"Are distance and bearing taken for metres?", place(cartesian(car), x)},
          {"Is the position never set?", Eigen::Vector2d::Zero()}};
}

/// The covariance of a new landmark comes from that of the car and from that of the sensor; with the rest it
/// has in common what the car has.
inline std::vector<WrongBelief> wrongLandmarks(const Belief& joint, const Belief& wanted,
                                               const Eigen::MatrixXd& C, const Eigen::MatrixXd& W) {
  const Eigen::Index n = joint.mean.size();
  const Eigen::MatrixXd byLandmark = C.rightCols(2), byCar = C.leftCols(3),
                        ofJoint = joint.covariance.topRows(3), own3 = joint.covariance.topLeftCorner(3, 3),
                        byView = rex::inverse(byLandmark), ofSensor = carried(byView, W),
                        own = wanted.covariance.bottomRightCorner(2, 2),
                        cross = wanted.covariance.bottomLeftCorner(2, n);
  const auto with = [&](const Eigen::MatrixXd& block, const Eigen::MatrixXd& rows) {
    Belief wrong = wanted;
    wrong.covariance.bottomRightCorner(2, 2) = block;
    wrong.covariance.bottomLeftCorner(2, n) = rows;
    wrong.covariance.topRightCorner(n, 2) = rows.transpose();
    return wrong;
  };
  const auto ofCar = [&](const Eigen::MatrixXd& byState) -> Eigen::MatrixXd {
    return carried(byState, own3);
  };
  Eigen::MatrixXd straight = -1 * product(byView, byCar), back = straight;
  straight.col(2).setZero();
  back.col(2) *= -1;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(2, n), I = unitMatrix(2);
  Eigen::MatrixXd ofCarAlone = none;
  ofCarAlone.leftCols(3) = cross.leftCols(3);
  const auto rows = [&](const Eigen::MatrixXd& byState) -> Eigen::MatrixXd {
    return product(byState, ofJoint);
  };
  return {
      {"Is the landmark as certain as if the pose of the car were known?", with(ofSensor, none)},
      {"Is the noise of the sensor left out?", with(sum(own, ofSensor, -1), cross)},
      {"Is W that of the sighting in the frame of the car? It has to be turned into that of the world.",
       with(sum(sum(own, ofSensor, -1), W), cross)},
      {"Is the heading of the car taken for certain?", with(sum(ofCar(straight), ofSensor), rows(straight))},
      {"Does the derivative by the heading have the wrong sign?",
       with(sum(ofCar(back), ofSensor), rows(back))},
      {"Is the covariance of the new landmark never set?", with(I, none)},
      {"Is the new landmark not correlated with the car? Both errors have the same cause.", with(own, none)},
      {"Is the new landmark correlated with the car alone? The car is correlated with the other landmarks.",
       with(own, ofCarAlone)},
      {"Have the covariances with the new landmark the wrong sign?", with(own, -cross)}};
}

// The new landmark is treated as an unknown that is seen: since nothing was known about it before, the
// canonical form of the larger belief is that of the smaller one plus the sighting.
inline void startsLandmark(rex::grading::Check& check, Student& student, const CarSetup& car, int landmarks) {
  const int n = 3 + 2 * landmarks;
  const Belief joint = randomJoint(check.rng(), landmarks);
  const Eigen::Vector2d l = randomLandmark(check.rng(), joint.mean.head(3)),
                        y = seenFrom(car, joint.mean.head(3), l);
  check.input(fmt::format("{} landmarks, one more is seen, {}", landmarks, described(car)),
              {{"x", joint.mean.head(3)},
               {"first three rows of the covariance", joint.covariance.topRows(3)},
               {"y", y}});
  Belief wanted{Eigen::VectorXd(n + 2), Eigen::MatrixXd::Zero(n + 2, n + 2)};
  wanted.mean << joint.mean, l;
  const auto change = [&](const Eigen::VectorXd& z) {
    return gapsOf(car, seenFrom(car, z.head(3), z.tail(2)), y);
  };
  const Eigen::MatrixXd C = derivative(change, wanted.mean), W = noiseOf(car, 1);
  wanted.covariance.topLeftCorner(n, n) = rex::inverse(joint.covariance);
  wanted.covariance = sum(wanted.covariance, carried(transposed(C), rex::inverse(W)));
  wanted.covariance = rex::inverse(wanted.covariance);
  const std::vector<int> old = numbersFrom(0, n), added = numbersFrom(n, 2);
  const Belief got = student.withLandmark(car, joint, y);
  std::vector<WrongBelief> wrong = wrongLandmarks(joint, wanted, C, W);
  for (const auto& [question, place] : wrongPlaces(car, joint.mean.head(3), y)) {
    wrong.push_back({question, wanted});
    wrong.back().belief.mean.tail(2) = place;
  }
  const BeliefFunction function{"withLandmark",
                                {{"covariance of the new landmark", added, added},
                                 {"covariance of the new landmark with the rest", added, old},
                                 {"covariance of the rest with the new landmark", old, added},
                                 {"covariance of the rest, which stays", old, old},
                                 {"mean of the new landmark", added, {}},
                                 {"mean of the rest, which stays", old, {}}}};
  sameBelief(check, function, got, wanted, 1e-6, wrong);
}
