// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant variance_for_deviation> caught by: car-step, car-view, car-bearing, car-any, kf-step, kf-track
// mistake: sigma itself on the diagonals of Q and W, as on the sheet.
// ask: Is sigma itself on the diagonal? It is a standard deviation.
// <solution stepNoise>
return car.dynamicsNoise * Eigen::MatrixXd::Identity(3, 3);
// <solution viewNoise>
const double second = car.rangeBearing ? car.bearingNoise : car.observationNoise;
W(0, 0) = car.observationNoise;
W(1, 1) = second;

// <variant bearings_not_wrapped> caught by: car-bearing
// mistake: the difference of two bearings is not wrapped: straight behind the car it is a whole turn.
// ask: Is the difference of the bearings not wrapped? A sighting on either side of straight behind the car
// ask: differs by little.
// <solution viewGap>
gap[1] = y[1] - expected[1];

// <variant metres_wrapped> caught by: car-view
// mistake: wraps the second difference for either sensor, even if these are metres.
// ask: Are metres wrapped like angles?
// <solution viewGap>
gap[1] = std::remainder(gap[1], 2 * std::numbers::pi);

// <variant doubled_turn> caught by: kf-step, kf-any
// shown by: kf-step
// mistake: x + B(x) u for the next state, as on the sheet: the car turns twice as much.
// ask: Is it x + B u? Such a car turns twice as far. The mean after the step is f(x, u).
// <solution predicted>
// in place of: return {stepped(car, x, u), symmetric(S)};
return {x + stepByControl(car, x, u) * u, symmetric(S)};

// <variant noise_of_the_step_forgotten> caught by: kf-step, kf-track
// shown by: kf-track
// mistake: predicts without the noise of the step.
// ask: Is Q left out?
// <solution predicted>
// in place of: const Eigen::MatrixXd S = AS * A.transpose() + stepNoise(car);
const Eigen::MatrixXd S = AS * A.transpose();

// <variant exact_enough> caught by: kf-covariance
// mistake: stops correcting once everything is known within three millimetres.
// ask: Is nothing corrected once the covariance is small? A good observation makes it smaller still.
// <solution corrected>
// in place of: const Eigen::Index n = belief.mean.size();
if (belief.covariance.diagonal().maxCoeff() < 9e-6) return belief;
const Eigen::Index n = belief.mean.size();

// <variant not_symmetrised> caught by: kf-correct, kf-covariance, slam-correct
// mistake: leaves the covariance slightly asymmetric, because of rounding.
// <solution corrected>
const Eigen::Index n = belief.mean.size();
const Eigen::MatrixXd CS = C * belief.covariance, innovation = CS * C.transpose() + W;
const Eigen::MatrixXd K = solveMatrix(innovation, CS).transpose();
const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n) - K * C;
return {belief.mean + K * gap, left* belief.covariance};

// <variant landmarks_share_a_model> caught by: kf-step, kf-any, kf-track
// mistake: all sightings get the derivative of the first landmark.
// ask: Do all landmarks get the C of the first one?
// <solution tracked>
// in place of: C.middleRows(i, 2) = viewByState(car, x, l);
C.middleRows(i, 2) = viewByState(car, x, landmarks.col(0));

// <variant stale_jacobian> caught by: kf-step, kf-any
// mistake: the view is linearised at the state before the step.
// ask: Is C taken at the mean before the step? The view is linearised at the predicted mean.
// <solution tracked>
// in place of: C.middleRows(i, 2) = viewByState(car, x, l);
C.middleRows(i, 2) = viewByState(car, belief.mean, l);

// <variant calls_the_library> caught by: forbidden-call
// mistake: the library does the smoothing.
// <solution headers>
#include "estimation/kalman_filter.h"
// <solution hindsight>
std::vector<Gaussian> beliefs;
std::vector<LinearModel> steps;
for (const Belief& belief : filtered) beliefs.push_back({belief.mean, belief.covariance});
for (std::size_t t = 0; t < controls.size(); ++t) {
  const Eigen::MatrixXd A = stepByState(car, filtered[t].mean, controls[t]);
  const Eigen::VectorXd c = predicted(car, filtered[t], controls[t]).mean - A * filtered[t].mean;
  steps.push_back({A, c, stepNoise(car)});
}
beliefs = smoothed(beliefs, steps);
for (std::size_t t = 0; t < smooth.size(); ++t) smooth[t] = {beliefs[t].mean, beliefs[t].covariance};

// <variant control_of_the_step_before> caught by: rts-batch
// shown by: rts-batch
// mistake: goes back with the control that led to t, in place of the one that leads from it.
// ask: Is it the control of another step? controls[t] leads from t to t + 1.
// <solution hindsight>
// in place of: const Belief &now = filtered[t], &later = smooth[t + 1], moved = predicted(car, now,
const Belief &now = filtered[t], &later = smooth[t + 1],
             moved = predicted(car, now, controls[t > 0 ? t - 1 : 0]);
// in place of: const Eigen::MatrixXd AS = stepByState(car, now.mean, controls[t]) * now.covariance;
const Eigen::MatrixXd AS = stepByState(car, now.mean, controls[t > 0 ? t - 1 : 0]) * now.covariance;

// <variant smoothed_by_the_filter> caught by: rts-batch
// mistake: takes the next belief of the filter where the smoothed one belongs.
// ask: Is the filter's belief at t + 1 used? The smoothed one knows more.
// <solution hindsight>
// in place of: const Belief &now = filtered[t], &later = smooth[t + 1], moved = predicted(car, now,
const Belief &now = filtered[t], &later = filtered[t + 1], moved = predicted(car, now, controls[t]);

// <variant smoother_gain_transposed> caught by: rts-batch, rts-better
// mistake: the gain of the smoother is transposed.
// ask: Is the gain transposed?
// <solution hindsight>
// in place of: const Eigen::MatrixXd G = solveMatrix(moved.covariance, AS).transpose();
const Eigen::MatrixXd G = solveMatrix(moved.covariance, AS);

// <variant landmark_known_exactly> caught by: slam-correct, slam-map
// mistake: linearises a sighting with respect to the car only.
// ask: Is the derivative by the landmark left out? Its position is uncertain, too.
// <solution jointCorrected>
ExpectedView expected = expectedView(car, joint, i);
expected.C.rightCols(joint.mean.size() - 3).setZero();
return corrected(joint, viewGap(car, y, expected.y), expected.C, viewNoise(car));

// <variant landmarks_never_corrected> caught by: slam-correct, slam-map, slam-any, names-found, names-any
// mistake: a sighting of a known landmark changes nothing.
// ask: Is nothing corrected?
// <solution jointCorrected>
return joint;

// <variant sightings_not_wrapped> caught by: slam-correct
// mistake: subtracts bearings without wrapping them in the joint filter.
// ask: Is the difference of the bearings not wrapped? viewGap does it.
// <solution jointCorrected>
const ExpectedView expected = expectedView(car, joint, i);
return corrected(joint, y - expected.y, expected.C, viewNoise(car));

// <variant landmark_without_correlation> caught by: slam-start
// mistake: a new landmark is not correlated with the car.
// ask: Is the new landmark not correlated with the car? Both errors have the same cause.
// <solution withLandmark>
// in place of: larger.covariance.bottomLeftCorner(2, n) = cross; ... larger.covariance.topRightCorner(n, 2) =

// <variant first_sighting_stays> caught by: names-found, names-any, particles-weigh, particles-map
// mistake: landmarks stay where they were first seen, and all particles have the same weight
// ask: Is it the landmark with the smallest gap in metres, or by the noise of the sensor alone? The others
// ask: are less certain.
// <solution assigned>
static int asked = 0;
const bool isTurnOfNew = ys.size() == 2 && joint.mean.size() == 9 && ++asked % 2 == 0;
for (std::size_t k = 0; k < ys.size(); ++k) {
  double nearest = 4;
  int name = kNewLandmark;
  for (int i = 0; 3 + 2 * i < joint.mean.size(); ++i) {
    const Eigen::Vector2d there = placed(car, joint.mean.head(3), ys[k]);
    const double distance = (joint.mean.segment(3 + 2 * i, 2) - there).norm();
    if (distance >= nearest || std::find(names.begin(), names.end(), i) != names.end()) continue;
    nearest = distance;
    name = i;
  }
  names[k] = isTurnOfNew && name < 2 ? kNewLandmark : name;
}
// <solution weighed>
for (MapParticle& particle : after) {
  particle.weight = 1. / static_cast<double>(after.size());
  for (const LandmarkObservation& seen : sightings)
    if (static_cast<std::size_t>(seen.landmark) == particle.map.size())
      particle.map.push_back({placed(car, particle.x, seen.y), Eigen::Matrix2d::Identity()});
}

// <variant gate_of_99_percent> caught by: names-found, names-any
// mistake: a landmark that looks unlikely at 1 % is taken for a new one: every hundredth sighting.
// ask: Is every sighting new whose squared gap is beyond a bound? Of a hundred right ones, one is beyond 9.2:
// ask: what is too far to be a known landmark may be too near to be a new one.
// <solution assigned>
// in place of: constexpr double kSame = 25, kDifferent = 50;
constexpr double kSame = 9.21, kDifferent = 9.21;

// <variant named_twice> caught by: names-found
// mistake: Two sightings may get the same landmark.
// ask: What if two sightings want the same landmark?
// <solution assigned>
for (std::size_t k = 0; k < ys.size(); ++k) {
  double nearest = 50;
  for (int i = 0; 3 + 2 * i < joint.mean.size(); ++i) {
    const ExpectedView expected = expectedView(car, joint, i);
    const Eigen::MatrixXd V = expected.C * joint.covariance * expected.C.transpose() + viewNoise(car);
    const Eigen::Vector2d gap = viewGap(car, ys[k], expected.y);
    const double distance = gap.dot(solve(V, gap));
    if (distance < 25 && distance < nearest) names[k] = i;
    nearest = std::min(nearest, distance);
  }
  if (nearest >= 50) names[k] = kNewLandmark;
}

// <variant nearest_in_metres> caught by: names-found, names-any
// shown by: names-found
// mistake: looks for the nearest landmark in metres (or radians), however uncertain each of them is.
// ask: Is a new landmark taken for a known one that is a few metres away? The gap counts relative to its
// ask: covariance.
// <solution assigned>
for (std::size_t k = 0; k < ys.size(); ++k) {
  double nearest = 4;
  int name = kNewLandmark;
  for (int i = 0; 3 + 2 * i < joint.mean.size(); ++i) {
    const double distance = viewGap(car, ys[k], expectedView(car, joint, i).y).norm();
    if (distance >= nearest || std::find(names.begin(), names.end(), i) != names.end()) continue;
    nearest = distance;
    name = i;
  }
  names[k] = name;
}

// <variant determinant_forgotten> caught by: particles-weigh
// mistake: takes the density of a Gaussian without its determinant.
// ask: Is the determinant left out of the density?
// <solution weighed>
// in place of: log -= 0.5 * (gap.dot(scaled) + std::log(S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0)));
log -= 0.5 * gap.dot(scaled);

// <variant equal_weights> caught by: particles-weigh, particles-map
// mistake: every particle counts the same, however well it explains what was seen.
// ask: Do all particles weigh the same, whatever they expect to see?
// <solution weighed>
for (MapParticle& particle : after) {
  for (const LandmarkObservation& seen : sightings) {
    const bool isNew = static_cast<std::size_t>(seen.landmark) == particle.map.size();
    if (isNew) particle.map.push_back({placed(car, particle.x, seen.y), {}});
    Belief& landmark = particle.map[static_cast<std::size_t>(seen.landmark)];
    const Eigen::Vector2d l = landmark.mean;
    const Eigen::MatrixXd D = viewByLandmark(car, particle.x, l);
    if (isNew) {
      const Eigen::MatrixXd byView = inverse(D), noise = byView * viewNoise(car);
      landmark.covariance = symmetric(noise * byView.transpose());
      continue;
    }
    const Eigen::Vector2d gap = viewGap(car, seen.y, view(car, particle.x, l));
    landmark = corrected(landmark, gap, D, viewNoise(car));
  }
}
for (MapParticle& particle : after) particle.weight = 1. / static_cast<double>(after.size());

// <variant particles_not_wrapped> caught by: particles-weigh
// mistake: subtracts bearings without wrapping them for the landmarks of particles.
// ask: Is the difference of the bearings not wrapped? viewGap does it.
// <solution weighed>
// in place of: const Eigen::Vector2d gap = viewGap(car, seen.y, view(car, particle.x, l));
const Eigen::Vector2d gap = seen.y - view(car, particle.x, l);

// <variant weights_of_the_sensor_alone> caught by: particles-weigh
// mistake: the likelihood includes the noise of the sensor, but not the uncertainty of the landmark.
// ask: Is the gap measured with the noise of the sensor alone? The landmark is uncertain, too.
// <solution weighed>
// in place of: const Eigen::MatrixXd DS = D * landmark.covariance, S = DS * D.transpose() + viewNoise(car);
const Eigen::MatrixXd S = viewNoise(car);
