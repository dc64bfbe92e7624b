#include <algorithm>
#include <cmath>
#include <numbers>

#include "drives.h"
#include "estimation/consistency.h"
#include "estimation/ekf_slam.h"
#include "estimation/smoother.h"
#include "exercise.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

Eigen::Vector3d stepped(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  // <solution stepped>
  const double way = car.tau * u[0];
  return {x[0] + way * std::cos(x[2]), x[1] + way * std::sin(x[2]),
          x[2] + way / car.wheelbase * std::tan(u[1])};
  // <todo>
  //| // TODO: slide 4:48, for a step of tau seconds.
  //| notUsedYet(car, u);
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
  //| notUsedYet(car, x, u);
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
  //| notUsedYet(car, x, u);
  // </solution>
  return B;
}

Eigen::MatrixXd stepNoise(const CarSetup& car) {
  // <solution stepNoise>
  return car.dynamicsNoise * car.dynamicsNoise * Eigen::MatrixXd::Identity(3, 3);
  // <todo>
  //| // TODO: the covariance of three independent numbers with that standard deviation.
  //| notUsedYet(car);
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
  //| notUsedYet(car, x, l);
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
  //| notUsedYet(car, x, l);
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
  //| notUsedYet(car, x, l);
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
  //| notUsedYet(car);
  // </solution>
  return W;
}

Eigen::Vector2d viewGap(const CarSetup& car, const Eigen::Vector2d& y, const Eigen::Vector2d& expected) {
  Eigen::Vector2d gap = y - expected;
  // <solution viewGap>
  if (car.rangeBearing) gap[1] = std::remainder(gap[1], 2 * std::numbers::pi);
  // <todo>
  //| // TODO: how far is it from a bearing of 3.1 to one of -3.1?
  //| notUsedYet(car);
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
  //| notUsedYet(car, u);
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
  //| notUsedYet(gap, C, W);
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
  //| notUsedYet(car, u, landmarks, y);
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
  //| notUsedYet(car, controls);
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
  //| notUsedYet(car, u);
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
  //| notUsedYet(car, i, y);
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
  //| notUsedYet(car, y);
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
  //| notUsedYet(car, joint);
  // </solution>
  return names;
}

std::vector<MapParticle> weighed(const CarSetup& car, const std::vector<MapParticle>& particles,
                                 const std::vector<Sighting>& sightings) {
  std::vector<MapParticle> after = particles;
  // <solution weighed>
  std::vector<double> logs;
  for (MapParticle& particle : after) {
    double log = std::log(particle.weight);
    for (const Sighting& seen : sightings) {
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
  //| notUsedYet(car, sightings);
  // </solution>
  return after;
}

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

const Color kFilter = kEstimateColor, kSmoother = kScanColor, kSoft{0.35f, 0.6f, 0.85f},
            kSoftest{0.75f, 0.35f, 0.6f};
const Belief kStart{Eigen::Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()};

std::vector<Belief> filtered(const CarSetup& car, const Recorded& drive) {
  std::vector<Belief> run{kStart};
  for (std::size_t t = 0; t < drive.controls.size(); ++t)
    run.push_back(tracked(car, run.back(), drive.controls[t], drive.landmarks, stacked(drive, t)));
  return run;
}

void showTracking(const Library& library) {
  const CarSetup car;
  Eigen::Matrix2Xd landmarks(2, 2);
  landmarks << 9, -6, 4, 16;
  const Recorded drive = library.drive(5, car, landmarks, 120, {0.5, 0.2}, kAnywhere);
  const std::vector<Belief> run = filtered(car, drive), smooth = hindsight(car, run, drive.controls);
  std::vector<Belief> blind{kStart};
  for (const Eigen::Vector2d& u : drive.controls) blind.push_back(predicted(car, blind.back(), u));

  CarView view;
  view.landmarks = landmarks;
  view.ways = {wayOf("true way", drive.states, kTruthColor), wayOf("filter", meansOf(run), kFilter),
               wayOf("without seeing", meansOf(blind), kDeadReckoningColor, true)};
  Figure above = figureOf(view);
  above.title = "A circle among two landmarks";
  addEllipses(above, "filter, 2 sigma", run, 6, kFilter);
  addEllipses(above, "without seeing", blind, 20, kDeadReckoningColor);
  plot("tracking", above);

  Figure errors = overTime("Error of the estimate along x, and what it is said to be", "error in x [m]");
  errors.bands = {deviationBand("filter, 2 sigma", run, 0, kSoft),
                  deviationBand("smoother, 2 sigma", smooth, 0, kSoftest)};
  errors.series = {
      curve("filter", errorsOf(run, drive.states, 0), kFilter),
      curve("smoother", errorsOf(smooth, drive.states, 0), kSmoother, 2.5),
      curve("smoother of the library", errorsOf(libraryHindsight(library, car, drive, run), drive.states, 0),
            kTruthColor, 1, true)};
  plot("smoothing", errors);
}

// The squared error in terms of the covariance, averaged over runs of a filter that believes in `believed`.
std::vector<double> meanSquaredErrors(const Library& library, const CarSetup& believed, int runs) {
  constexpr int kSteps = 100;
  std::vector<double> means(kSteps, 0);
  for (int i = 0; i < runs; ++i) {
    const Recorded drive =
        library.drive(static_cast<std::uint64_t>(i), {}, places(3), kSteps, {0.1, 0.2}, kAnywhere);
    Belief belief = kStart;
    belief.mean += std::sqrt(0.1) * Rng(static_cast<std::uint64_t>(i)).normalVector(3);
    for (std::size_t t = 0; t < kSteps; ++t) {
      belief = tracked(believed, belief, drive.controls[t], drive.landmarks, stacked(drive, t));
      const Eigen::VectorXd error = belief.mean - drive.states[t + 1];
      means[t] += error.dot(solveMatrix(belief.covariance, error).col(0)) / runs;
    }
  }
  return means;
}

void showConsistency(const Library& library) {
  constexpr int kRuns = 50;
  CarSetup proud, timid;
  proud.dynamicsNoise /= 5;
  timid.dynamicsNoise = std::sqrt(timid.dynamicsNoise);
  timid.observationNoise = std::sqrt(timid.observationNoise);
  const ConsistencyBand band = consistencyBand(kRuns, 3);
  Figure figure =
      overTime("Is the filter as wrong as it says? Mean of 50 runs", "squared error by covariance [1]");
  figure.logY = true;
  figure.bands = {{.label = "95 %",
                   .x = {0, 99},
                   .low = {band.lower, band.lower},
                   .high = {band.upper, band.upper},
                   .color = kSoft}};
  figure.series = {
      curve("a fifth of the noise believed", meanSquaredErrors(library, proud, kRuns), kDeadReckoningColor),
      curve("yours", meanSquaredErrors(library, {}, kRuns), kFilter, 2.5),
      curve("sigma where its square belongs", meanSquaredErrors(library, timid, kRuns), kLandmarkColor)};
  plot("consistency", figure);
}

void showMap(const Library& library) {
  const CarSetup car;
  const Recorded drive = library.drive(11, car, places(8), 90, {1, 0.2}, 9);
  const Mapping mapping = mapped(car, drive);
  std::vector<CarView> views;
  for (std::size_t t = 0; t < mapping.joints.size(); ++t) {
    views.push_back(viewAt(drive, mapping, t));
    views.back().caption = "Kalman SLAM: " + std::to_string(t) + " s";
  }
  writeFilm(views, "slam", {.rate = 10});
  for (const std::size_t t : {std::size_t{45}, mapping.joints.size() - 1}) {
    views[t].caption = "Car, map and beliefs after " + std::to_string(t) + " s";
    plot(t == 45 ? "map_before" : "map_after", figureOf(views[t]));
  }
  plot("deviations", deviationsOf(mapping));
  plot("correlations", correlationsOf(mapping.joints.back()));

  const Poses states = library.slam(drive);
  std::vector<double> yours, theirs;
  for (std::size_t t = 0; t < states.size(); ++t) {
    yours.push_back((mapping.joints[t].mean.head(2) - drive.states[t].head(2)).norm());
    theirs.push_back((states[t] - drive.states[t]).head(2).norm());
  }
  Figure figure = overTime("How far the estimate is from the car", "position error [m]");
  figure.series = {curve("yours", yours, kFilter, 3), curve("the library's", theirs, kTruthColor, 1, true)};
  plot("slam_error", figure);
}

void showNames(const Library& library) {
  const CarSetup car;
  const Recorded drive = library.drive(3, car, places(7), 80, {1, 0.2}, 14);
  Belief joint = Mapping().joints[0];
  std::vector<double> inMap, seenSoFar;
  std::vector<bool> wasSeen(7);
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    joint = jointPredicted(car, joint, drive.controls[t]);
    std::vector<Eigen::Vector2d> ys;
    for (const Sighting& seen : drive.seen[t]) {
      ys.push_back(seen.y);
      wasSeen[static_cast<std::size_t>(seen.landmark)] = true;
    }
    const std::vector<int> names = assigned(car, joint, ys);
    for (std::size_t k = 0; k < ys.size(); ++k) {
      if (names[k] >= 0) joint = jointCorrected(car, joint, names[k], ys[k]);
      if (names[k] == kNewLandmark) joint = withLandmark(car, joint, ys[k]);
    }
    inMap.push_back(static_cast<double>((joint.mean.size() - 3) / 2));
    seenSoFar.push_back(static_cast<double>(std::count(wasSeen.begin(), wasSeen.end(), true)));
  }
  Figure figure = overTime("Landmarks without names", "number of landmarks [1]");
  figure.yRange = AxisRange{0, 10};
  figure.series = {curve("seen so far", seenSoFar, kSoft, 5), curve("in the map", inMap, kFilter, 1.5)};
  plot("names", figure);
}

void showParticles(const Library& library) {
  const CarSetup car;
  const Recorded drive = library.drive(4, car, places(6), 45, {1, 0.2}, 12);
  constexpr std::size_t kParticles = 100;
  Rng rng(6);
  std::vector<int> names;
  std::vector<MapParticle> particles(kParticles, {Eigen::Vector3d::Zero(), 1. / kParticles, {}});
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    for (MapParticle& particle : particles)
      particle.x = stepped(car, particle.x, drive.controls[t]) + car.dynamicsNoise * rng.normalVector(3);
    std::vector<Sighting> seen;
    for (const Sighting& one : drive.seen[t]) {
      const auto known = std::find(names.begin(), names.end(), one.landmark);
      seen.push_back({static_cast<int>(known - names.begin()), one.y});
      if (known == names.end()) names.push_back(one.landmark);
    }
    particles = weighed(car, particles, seen);
    particles = drawn(particles, rng);
  }
  plot("particles", particleFigure(drive, particles));
}

}  // namespace

int main() {
  Library library;
  library.drive = [](std::uint64_t seed, const CarSetup& car, const Eigen::Matrix2Xd& landmarks, int steps,
                     const Eigen::Vector2d& u, double range) {
    Recorded drive{optionsOf(car), landmarks, {}, {Eigen::Vector3d::Zero()}, {}};
    drive.options.maxRange = range;
    CarSimulator simulator(seed, static_cast<int>(landmarks.cols()), drive.options);
    simulator.setLandmarks(landmarks);
    for (int t = 0; t < steps; ++t) {
      simulator.step(u);
      drive.controls.push_back(u);
      drive.states.push_back(simulator.getState());
      const Eigen::VectorXd y = simulator.getRealNoisyObservation();
      drive.seen.emplace_back();
      for (const int i : simulator.getVisibleLandmarks())
        drive.seen.back().push_back({i, y.segment(2 * i, 2)});
    }
    return drive;
  };
  library.smooth = [](const std::vector<Gaussian>& filtered, const std::vector<LinearModel>& transitions) {
    return smoothed(filtered, transitions);
  };
  library.slam = [](const Recorded& drive) {
    const auto model = CarSimulator::withoutPlaces(0, drive.options);
    const double q = drive.options.dynamicsNoise, w = drive.options.observationNoise;
    EkfSlam slam({Eigen::Vector3d::Zero(), 1e-6 * Eigen::Matrix3d::Identity()},
                 {.W = w * w * Eigen::Matrix2d::Identity()});
    Poses states{Eigen::Vector3d::Zero()};
    std::vector<int> names;
    for (std::size_t t = 0; t < drive.controls.size(); ++t) {
      const Eigen::Vector2d u = drive.controls[t];
      slam.predict(
          {[&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return model.getMeanStateAfterStep(x, u); },
           [&](const Eigen::Vector3d& x) -> Eigen::Matrix3d { return model.getStateJacobian(x, u); },
           q* q* Eigen::Matrix3d::Identity()});
      for (const Sighting& seen : drive.seen[t]) {
        const auto known = std::find(names.begin(), names.end(), seen.landmark);
        slam.observe(static_cast<int>(known - names.begin()), seen.y);
        if (known == names.end()) names.push_back(seen.landmark);
      }
      states.emplace_back(slam.pose().mean);
    }
    return states;
  };
  showTracking(library);
  showConsistency(library);
  showMap(library);
  showNames(library);
  showParticles(library);
}
