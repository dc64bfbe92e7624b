#include "grading/check.h"

#include <cmath>

#include "interface.h"
#include "plate_checks.h"
#include "wrench_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// Part 1.

void wrenches(Check& check, Student& student) {
  planarWrenchFits(check, student, {1, 0}, {0, 1}, {0, 0}, 1);
  planarWrenchFits(check, student, {0.5, 2}, {3, -1}, {1, 1}, 0.5);
  for (int i = 0; i < 5; ++i) spatialWrenchFits(check, student, check.rng());
}

void planarWrenchesOfFingers(Check& check, Student& student, int count) {
  Rng& rng = check.rng();
  std::vector<PlanarFinger> fingers;
  for (int k = 0; k < count; ++k) fingers.push_back(randomPlanarFinger(rng, rng.uniform(0.1, 1)));
  const Eigen::Vector2d center = rng.uniformVector(2, -1, 1);
  const double length = rng.uniform(0.2, 2);
  const Eigen::MatrixXd got = student.planarWrenches(fingers, center, length);
  const Eigen::MatrixXd wanted = wrenchesOf(fingers, center, length);
  check.shape("planarWrenches", got, 3, 2 * count);
  for (Eigen::Index k = 0; k < 2 * count; k += 2) {
    const bool isSwapped = (got.col(k) - wanted.col(k)).norm() > (got.col(k) - wanted.col(k + 1)).norm();
    check.near("wrench of one edge of a finger, in planarWrenches", got.col(k),
               wanted.col(isSwapped ? k + 1 : k), 1e-9, "N");
    check.near("wrench of the other edge, in planarWrenches", got.col(k + 1),
               wanted.col(isSwapped ? k : k + 1), 1e-9, "N");
  }
}

void spatialWrenchesOfFingers(Check& check, Student& student, int count) {
  Rng& rng = check.rng();
  std::vector<Finger> fingers;
  for (int k = 0; k < count; ++k) fingers.push_back(randomFinger(rng, k % 4 == 3 ? 0 : rng.uniform(0.1, 1)));
  const int edges = 3 + rng.index(8);
  const Eigen::Vector3d center = rng.uniformVector(3, -1, 1);
  const double length = rng.uniform(0.2, 2);
  const Eigen::MatrixXd got = student.spatialWrenches(fingers, edges, center, length);
  check.shape("spatialWrenches", got, 6, edges * count);
  bool isByEdges = count > 1;
  for (int k = 0; k < edges * count; ++k)
    isByEdges =
        isByEdges &&
        std::abs(fingers[static_cast<std::size_t>(k % count)].normal.dot(got.col(k).head(3)) - 1) < 1e-9;
  const auto byEdges = check.ask(
      "Are the columns in the order of edges? All of a finger come before those of the next one.", isByEdges);
  for (int k = 0; k < count; ++k) {
    const Finger& finger = fingers[static_cast<std::size_t>(k)];
    const Eigen::MatrixXd part = got.middleCols(edges * k, edges);
    areEdges(check, finger, part.topRows(3), edges, "spatialWrenches");
    for (Eigen::Index i = 0; i < edges; ++i) {
      const Eigen::Vector3d force = part.col(i).head(3);
      check.near("torque / length of an edge, in spatialWrenches", part.col(i).tail(3),
                 Eigen::Vector3d((finger.p - center).cross(force) / length), 1e-9, "N");
    }
  }
}

void cones(Check& check, Student& student) {
  for (const int edges : {3, 4, 8}) {
    const Finger finger = randomFinger(check.rng(), check.rng().uniform(0.2, 1));
    check.input("a pyramid", {{"edges", edges}, {"normal", finger.normal}, {"friction", finger.friction}});
    areEdges(check, finger, student.pyramidEdges(finger, edges), edges);
  }
  for (const double side : {1, -1}) {
    const Finger finger{{0, 0, 0}, {0, 0, side}, .5};
    check.input("a pyramid", {{"edges", 4}, {"normal", finger.normal}, {"friction", finger.friction}});
    areEdges(check, finger, student.pyramidEdges(finger, 4), 4);
  }
  for (int i = 0; i < 20; ++i) coneFits(check, student, check.rng());
  for (const int count : {1, 2}) {
    check.input(count == 1 ? "a finger" : "two fingers");
    planarWrenchesOfFingers(check, student, count);
    spatialWrenchesOfFingers(check, student, count);
  }
}

// <hidden>
void wrenchesOfFingers(Check& check, Student& student) {
  for (const int count : {1, 2, 5}) {
    planarWrenchesOfFingers(check, student, count);
    spatialWrenchesOfFingers(check, student, count);
  }
}

void conesAnywhere(Check& check, Student& student) {
  for (int i = 0; i < 200; ++i) coneFits(check, student, check.rng());
  for (int i = 0; i < 40; ++i) {
    const int edges = 3 + i % 14;
    Finger finger = randomFinger(check.rng(), i % 8 == 0 ? 0 : check.rng().uniform(0.05, 1.5));
    if (i % 5 == 0) finger.normal = (i % 2 == 0 ? 1 : -1) * Eigen::Vector3d::Unit(i / 5 % 3);
    areEdges(check, finger, student.pyramidEdges(finger, edges), edges);
  }
}
// </hidden>

// Part 2.

// Pairs of opposite wrenches along all axes but the last, which has a pair if `closes`, otherwise a single
// wrench.
Eigen::MatrixXd pairsAlongAxes(int d, bool closes) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(d, closes ? 2 * d : 2 * d - 1);
  for (Eigen::Index k = 0; k < W.cols(); ++k) W(k / 2, k) = k % 2 == 0 ? 1 : -1;
  return W;
}

void verdicts(Check& check, Student& student) {
  const auto isRight = [&](const std::string& name, const Eigen::MatrixXd& W) {
    check.input(name, {{"wrenches", W}});
    judgedRightly(check, student, W);
  };
  isRight("three in the plane", pairsAlongAxes(2, false));
  isRight("two pairs in the plane", pairsAlongAxes(2, true));
  Eigen::MatrixXd square(3, 4);
  square << 1, -1, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0;
  isRight("a square with a smooth finger in the middle of each side", square);
  square.row(2) << 0.5, 0.5, -0.5, -0.5;
  isRight("a square with smooth fingers beside the middle", square);
  square.row(2).setConstant(0.5);
  isRight("the same with other torques", square);
  for (int i = 0; i < 20; ++i) {
    const int d = 2 + i % 2, count = d + i % 5;
    Eigen::MatrixXd W(d, count);
    do {
      for (Eigen::Index k = 0; k < count; ++k) W.col(k) = randomDirection(check.rng(), d);
    } while (!isClear(W));
    isRight("random wrenches", W);
  }
}

// <hidden>
void judgesGrasps(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int closed = 0, open = 0; closed < 60 || open < 60;) {
    Eigen::MatrixXd W;
    const double friction = rng.index(4) == 0 ? 0 : rng.uniform(0.1, 0.8);
    if (rng.index(2) == 0) {
      const Plate plate = randomPlate(rng);
      std::vector<PlanarFinger> fingers;
      for (int k = rng.index(5); k >= 0; --k) fingers.push_back(fingerOn(plate, friction, rng));
      W = wrenchesOf(fingers, plate.center, plate.length);
    } else {
      const auto fingers = fingersOn(randomSolid(rng), 2 + rng.index(6), friction, rng);
      W = wrenchesOf(fingers, 3 + rng.index(6), Eigen::Vector3d::Zero(), 0.1).wrenches;
    }
    int& already = forceClosure(W).status == ClosureStatus::kClosed ? closed : open;
    if (already >= 60 || !isClear(W)) continue;
    ++already;
    judgedRightly(check, student, W);
  }
}

void judgesTheBorder(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int d = 2; d <= 6; ++d)
    for (const bool closes : {false, true})
      judgedRightly(check, student, pairsAlongAxes(d, closes) * rng.uniform(0.1, 10));
  for (int i = 0; i < 20; ++i) {  // wrenches in a plane, within which they are closed
    const int d = 3 + i % 4;
    Eigen::MatrixXd frame(d, d - 1);
    for (Eigen::Index k = 0; k < d - 1; ++k) frame.col(k) = rng.normalVector(d);
    judgedRightly(check, student, frame * closedWrenches(rng, d - 1, 3 * d));
  }
  judgedRightly(check, student, rng.normalVector(6));
}
// </hidden>

// Part 3.

// A cube with half edges of 1 and a finger in the middle of each face.
Eigen::MatrixXd cubeWrenches(double friction, int edges) {
  std::vector<Finger> fingers;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1., -1.})
      fingers.push_back({side * Eigen::Vector3d::Unit(axis), -side * Eigen::Vector3d::Unit(axis), friction});
  return wrenchesOf(fingers, edges, Eigen::Vector3d::Zero(), 1).wrenches;
}

void reaches(Check& check, Student& student) {
  Eigen::MatrixXd diamond = pairsAlongAxes(2, true);
  reachIs(check, student, "two pairs", diamond, Eigen::Vector2d(1, 0), 1);
  reachIs(check, student, "two pairs", diamond, Eigen::Vector2d(0.6, -0.8), 1 / 1.4);
  for (const double friction : {0.3, 0.8}) {
    const Eigen::MatrixXd W = cubeWrenches(friction, 8);
    reachIs(check, student,
            "a cube with fingers in the middle of all faces, friction " + text(friction) +
                ", 8 edges, the weakest direction",
            W, graspQuality(W).weakest, friction * std::sqrt(2. / 3));
  }
  for (int i = 0; i < 10; ++i) {
    const int d = 2 + i % 3;
    reachFits(check, student, "random wrenches", closedWrenches(check.rng(), d, 10),
              randomDirection(check.rng(), d));
  }
}

Eigen::MatrixXd antipodal(double friction) {
  return wrenchesOf(std::vector<PlanarFinger>{{{-1, 0}, {1, 0}, friction}, {{1, 0}, {-1, 0}, friction}},
                    Eigen::Vector2d::Zero(), 1);
}

void radii(Check& check, Student& student) {
  for (const double mu : {0.1, 0.5, 1.})
    radiusIs(check, student, "two fingers on opposite sides, friction " + text(mu), antipodal(mu),
             mu / std::sqrt(2 + mu * mu));
  Eigen::MatrixXd square(3, 4);
  square << 1, -1, 0, 0, 0, 0, 1, -1, 0.5, 0.5, -0.5, -0.5;
  radiusIs(check, student, "four smooth fingers on a square", square, std::sqrt(1. / 8));
  square.row(2).setConstant(0.5);
  radiusIs(check, student, "the same with other torques", square, 0);
  for (int i = 0; i < 20; ++i) {
    Eigen::MatrixXd W(3, 4 + i);
    for (Eigen::Index k = 0; k < W.cols(); ++k) W.col(k) = check.rng().normalVector(3);
    radiusFits(check, student, "random wrenches", W);
  }
}

// <hidden>
void reachesAnywhere(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 25; ++i) {
    const int d = 2 + i % 5;
    reachFits(check, student, "", closedWrenches(rng, d, 4 * d + rng.index(8)), randomDirection(rng, d));
  }
  for (const int edges : {4, 6, 8}) {
    const Eigen::MatrixXd W = cubeWrenches(rng.uniform(0.1, 1), edges);
    reachFits(check, student, "", W, randomDirection(rng, 6));
  }
}

void radiiAnywhere(Check& check, Student& student) {
  Rng& rng = check.rng();
  check.forEachCase(20, [&](int i) {
    const Plate plate = randomPlate(rng);
    std::vector<PlanarFinger> fingers;
    const double friction = rng.uniform(0.2, 1);
    while (fingers.size() < 2 || graspQuality(wrenchesOf(fingers, plate.center, plate.length)).epsilon == 0)
      fingers.push_back(fingerOn(plate, friction, rng));
    const Eigen::MatrixXd W = wrenchesOf(fingers, plate.center, plate.length);
    radiusFits(check, student, "", W * (i % 3 == 0 ? rng.uniform(0.05, 20) : 1));
    radiusFits(check, student, "", closedWrenches(rng, 3, 6 + i));
    Eigen::MatrixXd flat = closedWrenches(rng, 3, 6);
    flat.row(rng.index(3)).setConstant(rng.index(2));
    radiusFits(check, student, "", flat);
    Eigen::MatrixXd half = closedWrenches(rng, 3, 5);
    half.row(rng.index(3)) = half.row(0).cwiseAbs().array() + 0.1;
    radiusFits(check, student, "", half);
  });
}
// </hidden>

// Part 4.

struct Fingertips {
  Eigen::MatrixXd wrenches;
  std::vector<int> finger;
};

Fingertips onPlate(Rng& rng, int count, double friction) {
  const Plate plate = randomPlate(rng);
  Fingertips tips;
  std::vector<PlanarFinger> fingers;
  for (int k = 0; k < count; ++k) fingers.push_back(fingerOn(plate, friction, rng));
  tips.wrenches = wrenchesOf(fingers, plate.center, plate.length);
  const int each = static_cast<int>(tips.wrenches.cols()) / count;
  for (int k = 0; k < count * each; ++k) tips.finger.push_back(k / each);
  return tips;
}

void keepsFew(Check& check, Student& student) {
  keepsTheNeeded(check, student, "one wrench for each finger", pairsAlongAxes(2, false), {0, 1, 2});
  Eigen::MatrixXd more(2, 6);  // two wrenches are needed, so that those who delete all others keep some
  more << pairsAlongAxes(2, true), pairsAlongAxes(2, true).leftCols(2);
  keepsTheNeeded(check, student, "one wrench for each finger", more, {0, 1, 2, 3, 4, 5});
  for (int i = 0; i < 6; ++i) {
    const double friction = i % 2 == 0 ? 0 : 0.4;
    const Fingertips tips = onPlate(check.rng(), 20, friction);
    keepsTheNeeded(check, student, "20 fingers on a polygon, friction " + text(friction), tips.wrenches,
                   tips.finger);
  }
}

// <hidden>
void keepsFewOnSolids(Check& check, Student& student) {
  Rng& rng = check.rng();
  check.forEachCase(6, [&](int i) {
    const int count = 30 + rng.index(20);
    const WrenchSet set = wrenchesOf(fingersOn(randomSolid(rng), count, rng.uniform(0.1, 0.6), rng),
                                     3 + i % 4, Eigen::Vector3d::Zero(), 0.1);
    keepsTheNeeded(check, student, "", set.wrenches, set.contact);
    const Fingertips tips = onPlate(rng, 5 + rng.index(30), i % 2 == 0 ? 0 : rng.uniform(0.1, 1));
    keepsTheNeeded(check, student, "", tips.wrenches, tips.finger);
  });
}
// </hidden>

// Part 5.

void placesFingers(Check& check, Student& student) {
  const Plate slab = plateOf({{0, 0}, {0.12, 0}, {0.12, 0.06}, {0, 0.06}});
  graspIsGood(check, student, slab, 0.5, 2, kBestOnSlab);
  const Plate wedge = plateOf({{0, 0}, {0.1, 0}, {0.03, 0.09}});
  graspIsGood(check, student, wedge, 0.3, 3, kBestOnWedge);
}

// <hidden>
// The quality of fingers at positions along the outline, in edges: 2.5 is the middle of the third edge.
double qualityAt(const Plate& plate, double friction, const Eigen::VectorXd& places) {
  std::vector<PlanarFinger> fingers;
  for (const double place : places) {
    const auto n = static_cast<double>(plate.corners.size());
    const double around = place - n * std::floor(place / n);
    const auto i = static_cast<std::size_t>(around) % plate.corners.size();
    const Eigen::Vector2d &a = plate.corners[i], &b = plate.corners[(i + 1) % plate.corners.size()];
    const double size = (b - a).norm();
    const double along = std::clamp((around - std::floor(around)) * size, 0.002, size - 0.002);
    const Eigen::Vector2d side = (b - a) / size;
    fingers.push_back({a + along * side, {-side.y(), side.x()}, friction});
  }
  return graspQuality(wrenchesOf(fingers, plate.center, plate.length)).epsilon;
}

// The best of random positions, after the best few are improved by random steps of shrinking size.
double bestKnown(const Plate& plate, double friction, int count, Rng& rng) {
  std::vector<std::pair<double, Eigen::VectorXd>> grasps;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::VectorXd places = rng.uniformVector(count, 0, static_cast<double>(plate.corners.size()));
    grasps.emplace_back(qualityAt(plate, friction, places), places);
  }
  std::ranges::sort(grasps, [](const auto& a, const auto& b) { return a.first > b.first; });
  double best = 0;
  for (int k = 0; k < 8; ++k) {
    auto [quality, places] = grasps[static_cast<std::size_t>(k)];
    double step = 0.5;
    for (int i = 0; i < 250; ++i) {
      const Eigen::VectorXd other = places + step * rng.normalVector(count);
      const double then = qualityAt(plate, friction, other);
      step *= then > quality ? 1.3 : 0.96;
      if (then > quality) quality = then, places = other;
    }
    best = std::max(best, quality);
  }
  return best;
}

void placesFingersAnywhere(Check& check, Student& student) {
  Rng& rng = check.rng();
  check.forEachCase(6, [&](int i) {
    const int count = 2 + i % 3;
    for (;;) {
      const Plate plate = i == 1 ? randomWings(rng) : i == 4 ? randomFork(rng) : randomPlate(rng);
      const double friction = i == 5 ? 0 : rng.uniform(count == 2 ? 0.4 : 0.2, 0.8);
      const double best = bestKnown(plate, friction, count, rng);
      if (best < 0.1) continue;
      return graspIsGood(check, student, plate, friction, count, best);
    }
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"wrenches", "contacts", "The wrench of a force", 1, Group::kVisible, wrenches},
      {"cones", "contacts", "Friction cones and pyramids", 1, Group::kVisible, cones},
      {"verdicts", "closure", "Verdicts and their proofs", 2, Group::kVisible, verdicts},
      {"reach", "quality", "How far the hull reaches", 1, Group::kVisible, reaches},
      {"radius", "quality", "The ball in the hull", 1, Group::kVisible, radii},
      {"fewer", "fewer", "Redundant fingers are deleted", 1, Group::kVisible, keepsFew},
      {"places", "places", "A good grasp of a slab and of a wedge", 1, Group::kVisible, placesFingers},
      // <hidden>
      {"all-wrenches", "contacts", "The wrenches of many fingers", 1, Group::kHidden, wrenchesOfFingers},
      {"any-cones", "contacts", "Cones of any finger", 1, Group::kHidden, conesAnywhere},
      {"grasps", "closure", "Grasps of unseen objects", 2, Group::kHidden, judgesGrasps},
      {"border", "closure", "Sets that are nearly closed", 1, Group::kHidden, judgesTheBorder},
      {"any-reach", "quality", "How far other hulls reach", 1, Group::kHidden, reachesAnywhere},
      {"any-radius", "quality", "The ball in other hulls", 2, Group::kHidden, radiiAnywhere},
      {"fewer-on-solids", "fewer", "Fewer fingers on unseen objects", 2, Group::kHidden, keepsFewOnSolids},
      {"any-places", "places", "Good grasps of unseen objects", 2, Group::kHidden, placesFingersAnywhere},
      // </hidden>
  };
}
