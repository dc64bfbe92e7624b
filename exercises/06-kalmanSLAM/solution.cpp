#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

Eigen::Vector3d stepped(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  // <solution stepped>
  const double way = car.tau * u[0];
  return {x[0] + way * std::cos(x[2]), x[1] + way * std::sin(x[2]),
          x[2] + way / car.wheelbase * std::tan(u[1])};
  // <todo>
  //| // TODO: slide 4:48, for a step of tau seconds.
  //| return x;
  // </solution>
}

Eigen::MatrixXd stepByState(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3, 3);
  // <solution stepByState>
  A(0, 2) = -car.tau * u[0] * std::sin(x[2]);
  A(1, 2) = car.tau * u[0] * std::cos(x[2]);
  // <todo>
  //| // TODO: what does a slightly different heading change?
  // </solution>
  return A;
}

Eigen::MatrixXd stepByControl(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3, 2);
  // <solution stepByControl>
  const double cosine = std::cos(u[1]);
  B(0, 0) = car.tau * std::cos(x[2]);
  B(1, 0) = car.tau * std::sin(x[2]);
  B(2, 0) = car.tau * std::tan(u[1]) / car.wheelbase;
  B(2, 1) = car.tau * u[0] / (car.wheelbase * cosine * cosine);
  // <todo>
  //| // TODO: 12.9.2 a.
  // </solution>
  return B;
}

Eigen::MatrixXd stepNoise(const CarSetup& car) {
  // <solution stepNoise>
  return car.dynamicsNoise * car.dynamicsNoise * Eigen::MatrixXd::Identity(3, 3);
  // <todo>
  //| // TODO: the covariance of three independent numbers with that standard deviation.
  //| return Eigen::MatrixXd::Zero(3, 3);
  // </solution>
}

Eigen::Vector2d view(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  // <solution view>
  const double c = std::cos(x[2]), s = std::sin(x[2]), dx = l[0] - x[0], dy = l[1] - x[1];
  const double ahead = c * dx + s * dy, left = c * dy - s * dx;
  if (car.rangeBearing) return {std::hypot(ahead, left), std::atan2(left, ahead)};
  return {ahead, left};
  // <todo>
  //| // TODO: l in the frame of the car; and if the car has the other sensor?
  //| return Eigen::Vector2d::Zero();
  // </solution>
}

// <solution polarByOffsets>
// d(distance, bearing) / d(ahead, left), 2 x 2, of what is seen from x.
Eigen::MatrixXd polarByOffsets(CarSetup car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  car.rangeBearing = false;
  const Eigen::Vector2d offset = view(car, x, l);
  const double squared = offset.squaredNorm(), distance = std::sqrt(squared);
  Eigen::MatrixXd P(2, 2);
  P << offset[0] / distance, offset[1] / distance, -offset[1] / squared, offset[0] / squared;
  return P;
}
// <todo>
// </solution>

Eigen::MatrixXd viewByState(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2, 3);
  // <solution viewByState>
  const double c = std::cos(x[2]), s = std::sin(x[2]), dx = l[0] - x[0], dy = l[1] - x[1];
  C << -c, -s, c * dy - s * dx, s, -c, -c * dx - s * dy;
  if (car.rangeBearing) return polarByOffsets(car, x, l) * C;
  // <todo>
  //| // TODO: if the car moves, a landmark moves the other way; and if it turns?
  // </solution>
  return C;
}

Eigen::MatrixXd viewByLandmark(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(2, 2);
  // <solution viewByLandmark>
  const double c = std::cos(x[2]), s = std::sin(x[2]);
  D << c, s, -s, c;
  if (car.rangeBearing) return polarByOffsets(car, x, l) * D;
  // <todo>
  //| // TODO: two columns of viewByState() are nearly this.
  // </solution>
  return D;
}

Eigen::MatrixXd viewNoise(const CarSetup& car) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(2, 2);
  // <solution viewNoise>
  const double second = car.rangeBearing ? car.bearingNoise : car.observationNoise;
  W(0, 0) = car.observationNoise * car.observationNoise;
  W(1, 1) = second * second;
  // <todo>
  //| // TODO: of both sensors.
  // </solution>
  return W;
}

Eigen::Vector2d viewGap(const CarSetup& car, const Eigen::Vector2d& y, const Eigen::Vector2d& expected) {
  Eigen::Vector2d gap = y - expected;
  // <solution viewGap>
  if (car.rangeBearing) gap[1] = std::remainder(gap[1], 2 * std::numbers::pi);
  // <todo>
  //| // TODO: how far is it from a bearing of 3.1 to one of -3.1?
  // </solution>
  return gap;
}

// <solution symmetric>
Eigen::MatrixXd symmetric(const Eigen::MatrixXd& S) { return 0.5 * (S + S.transpose()); }
// <todo>
// </solution>

Belief predicted(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u) {
  // <solution predicted>
  const Eigen::Vector3d x = belief.mean;
  const Eigen::MatrixXd A = stepByState(car, x, u), AS = A * belief.covariance;
  const Eigen::MatrixXd S = AS * A.transpose() + stepNoise(car);
  return {stepped(car, x, u), symmetric(S)};
  // <todo>
  //| // TODO: the third line of the derivation on 7:27, with f(s, u) in place of A s + a.
  //| return belief;
  // </solution>
}

Belief corrected(const Belief& belief, const Eigen::VectorXd& gap, const Eigen::MatrixXd& C,
                 const Eigen::MatrixXd& W) {
  // <solution corrected>
  const Eigen::Index n = belief.mean.size();
  const Eigen::MatrixXd CS = C * belief.covariance, innovation = CS * C.transpose() + W;
  const Eigen::MatrixXd K = solveMatrix(innovation, CS).transpose();
  // Joseph's form: a sum of two terms that cannot be negative.
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n) - K * C, KW = K * W;
  const Eigen::MatrixXd LS = left * belief.covariance;
  const Eigen::MatrixXd S = LS * left.transpose() + KW * K.transpose();
  return {belief.mean + K * gap, symmetric(S)};
  // <todo>
  //| // TODO: the last lines of 7:27. What is K there, and what is y - C s - c here?
  //| return belief;
  // </solution>
}

Belief tracked(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u,
               const Eigen::MatrixXd& landmarks, const Eigen::VectorXd& y) {
  // <solution tracked>
  const Belief moved = predicted(car, belief, u);
  const Eigen::Vector3d x = moved.mean;
  const Eigen::Index m = y.size();
  Eigen::VectorXd gap(m);
  Eigen::MatrixXd C(m, 3), W = Eigen::MatrixXd::Zero(m, m);
  for (Eigen::Index i = 0; i < m; i += 2) {
    const Eigen::Vector2d l = landmarks.col(i / 2), seen(y[i], y[i + 1]);
    gap.segment(i, 2) = viewGap(car, seen, view(car, x, l));
    C.middleRows(i, 2) = viewByState(car, x, l);
    W.block(i, i, 2, 2) = viewNoise(car);
  }
  return corrected(moved, gap, C, W);
  // <todo>
  //| // TODO: predict, stack the models of all landmarks, correct.
  //| return belief;
  // </solution>
}

std::vector<Belief> hindsight(const CarSetup& car, const std::vector<Belief>& filtered,
                              const std::vector<Eigen::Vector2d>& controls) {
  std::vector<Belief> smooth = filtered;
  // <solution hindsight>
  for (std::size_t t = controls.size(); t-- > 0;) {
    const Belief &now = filtered[t], &later = smooth[t + 1], moved = predicted(car, now, controls[t]);
    // How a correction at t + 1 carries over to t: the regression of x(t) on x(t + 1).
    const Eigen::MatrixXd AS = stepByState(car, now.mean, controls[t]) * now.covariance;
    const Eigen::MatrixXd G = solveMatrix(moved.covariance, AS).transpose();
    const Eigen::MatrixXd change = later.covariance - moved.covariance, GS = G * change;
    const Eigen::VectorXd shift = later.mean - moved.mean;
    smooth[t].mean = now.mean + G * shift;
    smooth[t].covariance = symmetric(now.covariance + GS * G.transpose());
  }
  // <todo>
  //| // TODO: from the end to the start. How are x(t) and x(t + 1) correlated before x(t + 1) is seen?
  // </solution>
  return smooth;
}

Belief jointPredicted(const CarSetup& car, const Belief& joint, const Eigen::Vector2d& u) {
  Belief moved = joint;
  // <solution jointPredicted>
  // Only the first three rows and columns change: what the car has in common with the landmarks turns, too.
  const Eigen::Vector3d x = joint.mean.head(3);
  const Eigen::MatrixXd A = stepByState(car, x, u), before = joint.covariance.topRows(3), rows = A * before;
  const Eigen::MatrixXd own = rows.leftCols(3), S = own * A.transpose() + stepNoise(car);
  moved.mean.head(3) = stepped(car, x, u);
  moved.covariance.topRows(3) = rows;
  moved.covariance.leftCols(3) = rows.transpose();
  moved.covariance.topLeftCorner(3, 3) = symmetric(S);
  // <todo>
  //| // TODO: what are f, A and Q of the whole state, in blocks?
  // </solution>
  return moved;
}

// <solution expectedView>
// What is expected of a sighting of landmark i: the sighting itself, and how it depends on all.
struct ExpectedView {
  Eigen::Vector2d y;
  Eigen::MatrixXd C;  // 2 x (3 + 2 N)
};

ExpectedView expectedView(const CarSetup& car, const Belief& joint, int i) {
  const Eigen::Vector3d x = joint.mean.head(3);
  const Eigen::Vector2d l = joint.mean.segment(3 + 2 * i, 2);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2, joint.mean.size());
  C.leftCols(3) = viewByState(car, x, l);
  C.middleCols(3 + 2 * i, 2) = viewByLandmark(car, x, l);
  return {view(car, x, l), C};
}
// <todo>
// </solution>

Belief jointCorrected(const CarSetup& car, const Belief& joint, int i, const Eigen::Vector2d& y) {
  // <solution jointCorrected>
  const ExpectedView expected = expectedView(car, joint, i);
  return corrected(joint, viewGap(car, y, expected.y), expected.C, viewNoise(car));
  // <todo>
  //| // TODO: which columns of the Jacobian of a sighting are not zero?
  //| return joint;
  // </solution>
}

// <solution placed>
// A landmark that is seen as y from x. As view(x, l) = y, the derivatives of l are -1/D C by x and 1/D by y.
Eigen::Vector2d placed(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& y) {
  const double angle = car.rangeBearing ? x[2] + y[1] : x[2], c = std::cos(angle), s = std::sin(angle);
  if (car.rangeBearing) return {x[0] + y[0] * c, x[1] + y[0] * s};
  return {x[0] + c * y[0] - s * y[1], x[1] + s * y[0] + c * y[1]};
}
// <todo>
// </solution>

Belief withLandmark(const CarSetup& car, const Belief& joint, const Eigen::Vector2d& y) {
  const Eigen::Index n = joint.mean.size();
  Belief larger{Eigen::VectorXd::Zero(n + 2), Eigen::MatrixXd::Identity(n + 2, n + 2)};
  larger.mean.head(n) = joint.mean;
  larger.covariance.topLeftCorner(n, n) = joint.covariance;
  // <solution withLandmark>
  const Eigen::Vector3d x = joint.mean.head(3);
  const Eigen::Vector2d l = placed(car, x, y);
  const Eigen::MatrixXd byView = inverse(viewByLandmark(car, x, l));
  const Eigen::MatrixXd C = -viewByState(car, x, l), byState = byView * C, rows = joint.covariance.topRows(3);
  const Eigen::MatrixXd cross = byState * rows, own = cross.leftCols(3), noise = byView * viewNoise(car);
  const Eigen::MatrixXd S = own * byState.transpose() + noise * byView.transpose();
  larger.mean.tail(2) = l;
  larger.covariance.bottomLeftCorner(2, n) = cross;
  larger.covariance.topRightCorner(n, 2) = cross.transpose();
  larger.covariance.bottomRightCorner(2, 2) = symmetric(S);
  // <todo>
  //| // TODO: l as a function of x and y, its two derivatives, and with them three blocks of the covariance.
  // </solution>
  return larger;
}

std::vector<int> assigned(const CarSetup& car, const Belief& joint, const std::vector<Eigen::Vector2d>& ys) {
  std::vector<int> names(ys.size(), kUnclear);
  // <solution assigned>
  // Squared distances are chi-square of 2 degrees for the right landmark: beyond g with probability exp(-g /
  // 2). A landmark that is entered twice is never got rid of again, so a new one must be far from all.
  constexpr double kSame = 25, kDifferent = 50;
  struct Pair {
    double distance;
    std::size_t k;
    int i;
  };
  std::vector<Pair> pairs;
  std::vector<double> nearest(ys.size(), kDifferent);
  for (int i = 0; 3 + 2 * i < joint.mean.size(); ++i) {
    const ExpectedView expected = expectedView(car, joint, i);
    const Eigen::MatrixXd CS = expected.C * joint.covariance;
    const Eigen::MatrixXd precision = inverse(CS * expected.C.transpose() + viewNoise(car));
    for (std::size_t k = 0; k < ys.size(); ++k) {
      const Eigen::Vector2d gap = viewGap(car, ys[k], expected.y);
      const double distance = gap.dot(precision * gap);
      nearest[k] = std::min(nearest[k], distance);
      if (distance < kSame) pairs.push_back({distance, k, i});
    }
  }
  for (std::size_t k = 0; k < ys.size(); ++k)
    if (nearest[k] >= kDifferent) names[k] = kNewLandmark;
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  for (const Pair& pair : pairs)
    if (names[pair.k] == kUnclear && std::find(names.begin(), names.end(), pair.i) == names.end())
      names[pair.k] = pair.i;
  // <todo>
  //| // TODO: how far is each y from what each landmark would look like, in terms of its covariance?
  // </solution>
  return names;
}

std::vector<MapParticle> weighed(const CarSetup& car, const std::vector<MapParticle>& particles,
                                 const std::vector<LandmarkObservation>& sightings) {
  std::vector<MapParticle> after = particles;
  // <solution weighed>
  std::vector<double> logs;
  for (MapParticle& particle : after) {
    double log = std::log(particle.weight);
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
      const Eigen::MatrixXd DS = D * landmark.covariance, S = DS * D.transpose() + viewNoise(car);
      const Eigen::Vector2d scaled = solveMatrix(S, gap);
      log -= 0.5 * (gap.dot(scaled) + std::log(S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0)));
      landmark = corrected(landmark, gap, D, viewNoise(car));
    }
    logs.push_back(log);
  }
  // Relative to the largest of them, or all would be zero where all are tiny.
  const double most = *std::max_element(logs.begin(), logs.end());
  double sum = 0;
  for (double& log : logs) sum += log = std::exp(log - most);
  for (std::size_t k = 0; k < after.size(); ++k) after[k].weight = logs[k] / sum;
  // <todo>
  //| // TODO: for each landmark of each particle a filter of two numbers, and weights from what it expects.
  // </solution>
  return after;
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  // Part 1: a landmark 3 m ahead and 1 m to the left, by both sensors; the derivatives; and 120 steps.
  const CarSetup car, polar{.rangeBearing = true};
  const Eigen::Vector3d x(2, 1, std::numbers::pi / 2);
  print("view, which should be 3 m ahead and 1 m to the left", view(car, x, {1, 4}));
  print("view, which should be 3.162 m away at 0.3217 rad", view(polar, x, {1, 4}));
  showDerivatives();
  const RecordedDrive drive =
      recordDrive(5, car, (Eigen::MatrixXd(2, 2) << 9, -6, 4, 16).finished(), 120, {0.5, 0.2}, 1e3);
  showSteps(car, drive);

  // Part 2: the same drive, with and without observations.
  const Belief start{Eigen::Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()};
  std::vector<Belief> run{start}, blind{start};
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    run.push_back(tracked(car, run.back(), drive.controls[t], drive.landmarks, allSeen(drive, t)));
    blind.push_back(predicted(car, blind.back(), drive.controls[t]));
  }
  showTracking(drive, run, blind);
  showConsistency(start);

  // Part 3: what is known of it at its end.
  showSmoothing(drive, run, hindsight(car, run, drive.controls));

  // Part 4: 90 s among eight landmarks; the car sees those within 9 m.
  showMap(recordDrive(11, car, landmarksAround(8), 90, {1, 0.2}, 9));

  // Part 5: a map whose landmarks have no names, and a hundred maps.
  showNames(recordDrive(3, car, landmarksAround(7), 80, {1, 0.2}, 14));
  showParticles(recordDrive(4, car, landmarksAround(6), 45, {1, 0.2}, 12));
}
