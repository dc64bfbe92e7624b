#pragma once

#include <string>
#include <vector>

#include "filter_checks.h"

// Part 3: smoothing.

// The beliefs of the grader's filter on a run.
inline std::vector<Belief> filteredRun(rex::Rng& rng, const CarRun& run) {
  const Eigen::Vector3d deviations(0.3, 0.3, 0.1);
  const Eigen::Vector3d start = run.states[0] + deviations.cwiseProduct(rng.normalVector(3));
  std::vector<Belief> filtered{{start, Eigen::Matrix3d(deviations.cwiseAbs2().asDiagonal())}};
  for (std::size_t t = 0; t < run.controls.size(); ++t) {
    const Belief moved = movedOn(run.car, filtered.back(), run.controls[t]);
    Belief next = informed(moved, seenAround(run.car, {run.landmarks, run.sightings[t]}, moved.mean));
    next.covariance = 0.5 * (next.covariance + next.covariance.transpose()).eval();
    filtered.push_back(next);
  }
  return filtered;
}

/// All states of a run, estimated at once.
struct Smoothed {
  std::vector<Belief> beliefs;
  std::vector<Eigen::MatrixXd> gains;  ///< by how much x(t) moves with x(t + 1)
};

// As one large Gaussian over deviations from the filter's means. Each transition adds a precision, and each
// observation adds what it added to the filter.
inline Smoothed allAtOnce(const CarRun& run, const std::vector<Belief>& filtered) {
  const auto count = static_cast<Eigen::Index>(filtered.size());
  const auto model = rex::CarSimulator::withoutPlaces(0, optionsOf(run.car));
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
  Smoothed all{filtered, {}};
  for (Eigen::Index t = 0; t < count; ++t) {
    const Eigen::MatrixXd S = covariance.block(3 * t, 3 * t, 3, 3);
    all.beliefs[static_cast<std::size_t>(t)].mean += shift.segment(3 * t, 3);
    all.beliefs[static_cast<std::size_t>(t)].covariance = S;
    if (t > 0) {
      const Eigen::MatrixXd cross = covariance.block(3 * t - 3, 3 * t, 3, 3);
      all.gains.push_back(product(cross, rex::inverse(S)));
    }
  }
  return all;
}

/// What a belief becomes if the next one turns out to be `later` and was expected to be `moved`.
inline Belief pulledAlong(const Belief& now, const Belief& moved, const Belief& later,
                          const Eigen::MatrixXd& gain) {
  return {sum(now.mean, product(gain, sum(later.mean, moved.mean, -1))),
          sum(now.covariance, carried(gain, sum(later.covariance, moved.covariance, -1)))};
}

inline std::vector<WrongBelief> wrongSmoothing(const CarRun& run, const std::vector<Belief>& filtered,
                                               const Smoothed& all, std::size_t t) {
  const std::size_t last = run.controls.size();
  if (t == last) return {};
  const auto movedBy = [&](std::size_t control) {
    return movedOn(run.car, filtered[t], run.controls[control]);
  };
  const Belief &now = filtered[t], &later = all.beliefs[t + 1], moved = movedBy(t);
  const Eigen::MatrixXd& gain = all.gains[t];
  const Belief still{moved.mean, sum(moved.covariance, stepNoiseOf(run.car), -1)};
  const auto gainWith = [&](const Eigen::MatrixXd& covariance) -> Eigen::MatrixXd {
    return product(product(gain, moved.covariance), rex::inverse(covariance));
  };
  const auto ofControl = [&](std::size_t control) {
    const auto model = rex::CarSimulator::withoutPlaces(0, optionsOf(run.car));
    const Belief other = movedBy(control);
    const Eigen::MatrixXd A = model.getStateJacobian(now.mean, run.controls[control]);
    return pulledAlong(now, other, later,
                       product(product(now.covariance, transposed(A)), rex::inverse(other.covariance)));
  };
  const Belief right = all.beliefs[t];
  const char* control = "Is it the control of another step? controls[t] leads from t to t + 1.";
  return {
      {"Is nothing changed by what was seen later?", now},
      {"Is the predicted covariance without Q?", pulledAlong(now, still, later, gainWith(still.covariance))},
      {"Is the gain that of a car that does not turn, without A?",
       pulledAlong(now, moved, later, product(now.covariance, rex::inverse(moved.covariance)))},
      {"Does the change of the covariance have the wrong sign?",
       {right.mean, sum(sum(now.covariance, now.covariance), right.covariance, -1)}},
      {"Does the change of the mean have the wrong sign?",
       {sum(sum(now.mean, now.mean), right.mean, -1), right.covariance}},
      {"Is only the mean smoothed?", {right.mean, now.covariance}},
      {"Is only the covariance smoothed?", {now.mean, right.covariance}},
      {"Is the later belief compared with the filter's, instead of the predicted one?",
       pulledAlong(now, filtered[t + 1], later, gain)},
      {control, ofControl(t > 0 ? t - 1 : t)},
      {control, ofControl(t + 1 < last ? t + 1 : t)},
      {control, ofControl(0)}};
}

inline void smoothsRightly(rex::grading::Check& check, Student& student, const CarRun& run) {
  const std::vector<Belief> filtered = filteredRun(check.rng(), run);
  const Smoothed all = allAtOnce(run, filtered);
  const std::vector<Belief> smooth = student.hindsight(run.car, filtered, run.controls);
  check.near("number of beliefs of hindsight", static_cast<double>(smooth.size()),
             static_cast<double>(filtered.size()), 0);
  // From the end, as the beliefs depend on each other.
  for (std::size_t t = filtered.size(); t-- > 0;) {
    const std::string where = fmt::format("{}, t = {} of {}", described(run.car), t, run.controls.size());
    const Belief& now = filtered[t];
    if (t + 1 == filtered.size()) {
      check.input(where, {{"mean of filtered[t]", now.mean}, {"its covariance", now.covariance}});
    } else {
      const Belief& later = all.beliefs[t + 1];
      check.input(where, {{"mean of filtered[t]", now.mean},
                          {"its covariance", now.covariance},
                          {"controls[t]", run.controls[t]},
                          {"smoothed mean of t + 1", later.mean},
                          {"its covariance", later.covariance}});
    }
    const bool isLast = t + 1 == filtered.size();
    const auto kept =
        check.ask("Does the last belief change? The filter has seen everything by then.", isLast);
    sameBelief(check, {.name = "hindsight"}, smooth[t], all.beliefs[t], 1e-7,
               wrongSmoothing(run, filtered, all, t));
  }
}
