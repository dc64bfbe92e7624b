#include "grading/check.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "belief_checks.h"
#include "descent_checks.h"
#include "gauss_newton_checks.h"
#include "interface.h"
#include "matrix_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

void squareEquations(Check& check, Student& student) {
  for (const int n : {1, 3, 5}) equationAHolds(check, student, n);
  for (const int n : {1, 2, 4}) equationBHolds(check, student, n, n == 1 ? 1 : 3);
}

void tallEquations(Check& check, Student& student) {
  for (const int n : {1, 2, 4}) equationCHolds(check, student, 6, n);
  for (const int n : {1, 3, 8}) equationDHolds(check, student, 6, n);
}

void derivatives(Check& check, Student& student) {
  for (const int n : {1, 2, 4}) derivativeFits(check, student, 3, n);
}

void minima(Check& check, Student& student) {
  for (const int n : {1, 3, 5}) minimumIsLeast(check, student, 4, n);
}

// Part 2.

void descendsBowlAndHole(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    Rng& rng = check.rng();
    const int n = 1 + rng.index(4);
    const SearchOptions options{.shrink = i < 4 ? 0.5 : 0.4, .decrease = i < 4 ? 0.01 : 0.3};
    descends(check, student, i % 2 == 0 ? bowl(rng, n) : hole(rng, n), options);
  });
}

void gaussNewtonOnKnownProblems(Check& check, Student& student) {
  const SearchOptions few{.maxSteps = 40};
  followsGaussNewton(check, student, affine(check.rng(), 5, 3), {.maxSteps = 1});
  followsGaussNewton(check, student, curvedValley(check.rng()), few);
  followsGaussNewton(check, student, arcTangent(check.rng(), 2), few);
}

// Part 3.

Eigen::Matrix3d pose(const Eigen::Vector2d& move, double angle) {
  return Eigen::Isometry2d(Eigen::Translation2d(move) * Eigen::Rotation2Dd(angle)).matrix();
}

Eigen::Matrix3d randomPose(Rng& rng) { return pose(rng.normalVector(2), rng.uniform(-3, 3)); }

// The book is moved and turned as `bookPose` should do it.
void poseFits(Check& check, Student& student, const Eigen::Vector2d& move, double angle) {
  check.input("a book", {{"move", move}, {"angle", angle}});
  const Eigen::Matrix3d X_WB = student.bookPose(move, angle), wanted = pose(move, angle);
  check.near("origin of the book in bookPose", X_WB.topRightCorner(2, 1), move, 1e-11, "m");
  check.near("X_WB of bookPose", X_WB, wanted, 1e-11);
}

void mappedFits(Check& check, Student& student, const Eigen::Matrix3d& X_WB, const Eigen::Vector2d& p_B) {
  check.input("a point of the book", {{"X_WB", X_WB}, {"p_B", p_B}});
  const Eigen::Vector2d turned = X_WB.topLeftCorner(2, 2) * p_B;
  check.near("p_W of mapped", student.mapped(X_WB, p_B), X_WB.topRightCorner(2, 1) + turned, 1e-11, "m");
}

void bookAndDot(Check& check, Student& student) {
  poseFits(check, student, {1, 0}, M_PI / 4);
  mappedFits(check, student, pose({1, 0}, M_PI / 4), {1, 1});
  poseFits(check, student, {2, -3}, 0);
}

void backAndRelative(Check& check, Student& student, const Eigen::Matrix3d& X_WA,
                     const Eigen::Matrix3d& X_WB) {
  check.input("a frame", {{"X_WB", X_WB}});
  check.near("X_BW of inverted", student.inverted(X_WB), X_WB.inverse(), 1e-11);
  check.input("two frames", {{"X_WA", X_WA}, {"X_WB", X_WB}});
  check.near("X_AB of seenFrom", student.seenFrom(X_WA, X_WB), X_WA.inverse() * X_WB, 1e-11);
}

void frames(Check& check, Student& student) {
  backAndRelative(check, student, Eigen::Matrix3d::Identity(), pose({1, 0}, M_PI / 4));
  for (int i = 0; i < 5; ++i)
    backAndRelative(check, student, randomPose(check.rng()), randomPose(check.rng()));
}

// Part 4.

// Exact fractions: all counts over one common denominator.
void fruitOf(Check& check, Student& student, const std::vector<int>& apples,
             const std::vector<int>& oranges) {
  check.input(
      fmt::format("boxes with {} apples and {} oranges", fmt::join(apples, ", "), fmt::join(oranges, ", ")));
  const std::size_t boxes = apples.size();
  std::int64_t all = 1, sum = 0;
  for (std::size_t i = 0; i < boxes; ++i) all *= apples[i] + oranges[i];
  std::vector<std::int64_t> share(boxes);
  for (std::size_t i = 0; i < boxes; ++i) sum += share[i] = all / (apples[i] + oranges[i]) * apples[i];
  const Fruit fruit = student.fruitBoxes(apples, oranges);
  const int n = static_cast<int>(boxes);
  Eigen::VectorXd wanted(n), inBox(n);
  for (int i = 0; i < n; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    wanted[i] = static_cast<double>(share[k]) / static_cast<double>(sum);
    inBox[i] = static_cast<double>(share[k]) / static_cast<double>(all);
  }
  check.near("P(apple) of fruitBoxes", fruit.apple, inBox.mean(), 1e-12);
  check.near("P(box | apple) of fruitBoxes", fruit.boxGivenApple, wanted, 1e-12);
}

// Enumerates every case: your box is number 0, and bits say which boxes the host opens.
double chanceOfSwapping(int boxes, int opened) {
  double chance = 0;
  for (int prize = 0; prize < boxes; ++prize) {
    int ways = 0;
    double wins = 0;
    for (unsigned open = 0; open < (1u << boxes); ++open) {
      if (std::popcount(open) != opened || (open & 1u) != 0 || (open >> prize & 1u) != 0) continue;
      ++ways;
      for (int taken = 1; taken < boxes; ++taken) {
        if (taken == prize) wins += 1. / (boxes - 1 - opened);
      }
    }
    chance += wins / ways / boxes;
  }
  return chance;
}

void doorsOf(Check& check, Student& student, int boxes, int opened) {
  check.input(fmt::format("{} boxes, the host opens {}", boxes, opened));
  const Doors doors = student.montyHall(boxes, opened);
  check.near("P(prize) if you stay, of montyHall", doors.stay, 1. / boxes, 1e-12);
  check.near("P(prize) if you swap, of montyHall", doors.swap, chanceOfSwapping(boxes, opened), 1e-12);
}

void tableOf(Check& check, Student& student, const Eigen::MatrixXd& P_XY, bool independent) {
  check.input(independent ? "independent X and Y" : "dependent X and Y", {{"P(X, Y)", P_XY}});
  const TableAnswers answers = student.jointTable(P_XY);
  const Eigen::VectorXd PX = P_XY * Eigen::VectorXd::Ones(P_XY.cols()),
                        PY = P_XY.transpose() * Eigen::VectorXd::Ones(P_XY.rows());
  const Eigen::MatrixXd ofY = P_XY * PY.asDiagonal().inverse();
  check.near("P(X) of jointTable", answers.PX, PX, 1e-12);
  check.near("P(Y) of jointTable", answers.PY, PY, 1e-12);
  check.near("P(X | Y) of jointTable", answers.XGivenY, ofY, 1e-12);
  const auto exact =
      check.ask("Are numbers compared with ==, or more exactly than to within 1e-9?", independent);
  const auto coarse = check.ask("Is every entry of the table compared, and to within 1e-9?", !independent);
  check.that(independent ? "`independent` of jointTable is true" : "`independent` of jointTable is false",
             answers.independent == independent);
}

void boxesAndDoors(Check& check, Student& student) {
  fruitOf(check, student, {8, 10}, {4, 2});
  fruitOf(check, student, {1, 3}, {1, 9});
  doorsOf(check, student, 3, 1);
  doorsOf(check, student, 10, 8);
}

void tables(Check& check, Student& student) {
  tableOf(check, student, (Eigen::MatrixXd(2, 2) << .06, .24, .14, .56).finished(), true);
  // Here rounding makes P(X) P(Y) differ from the table in the last bit, whatever the order of summation.
  tableOf(check, student, (Eigen::MatrixXd(3, 3) << .03, .03, .04, .06, .06, .08, .21, .21, .28).finished(),
          true);
  tableOf(check, student, (Eigen::MatrixXd(2, 3) << .1, .2, .1, .3, .1, .2).finished(), false);
  // A little dependent, and not in the first row and column.
  Eigen::MatrixXd P_XY = (Eigen::MatrixXd(3, 3) << .03, .03, .04, .06, .06, .08, .21, .21, .28).finished();
  P_XY.bottomRightCorner(2, 2) += 1e-6 * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  tableOf(check, student, P_XY, false);
}

// Part 5.

void products(Check& check, Student& student) {
  for (const int n : {1, 2, 3}) productFits(check, student, n);
}

void propagations(Check& check, Student& student) {
  propagationFits(check, student, 1, 1);
  propagationFits(check, student, 2, 2);
  propagationFits(check, student, 3, 2);
}

void conjugates(Check& check, Student& student) {
  betaFits(check, student, 12);
  dirichletFits(check, student, 3, 15);
  for (int i = 0; i < 2; ++i) predictionFits(check, student, 3);
}

// <hidden>
void equationsOfAnySize(Check& check, Student& student) {
  check.forEachCase(18, [&](int i) {
    const int d = 1 + check.rng().index(12), n = 1 + check.rng().index(12);
    const int least = std::min(d, n), most = std::max(d, n);
    if (i % 6 == 0) equationAHolds(check, student, d);
    if (i % 6 == 1) equationBHolds(check, student, d, n);
    if (i % 6 == 2) equationCHolds(check, student, most + 1, least);
    if (i % 6 == 3) equationDHolds(check, student, d, n);
    if (i % 6 == 4) derivativeFits(check, student, d, n);
    if (i % 6 == 5) minimumIsLeast(check, student, d, n);
  });
}

// c^T x - sum ln(1 - x_i^2): infinite outside a cube.
Landscape barrier(Rng& rng, int n) {
  const Eigen::VectorXd c = rng.uniformVector(n, -3, 3);
  return {"a function that is infinite outside a cube",
          [=](const Eigen::VectorXd& x) {
            if (x.cwiseAbs().maxCoeff() >= 1) return std::numeric_limits<double>::infinity();
            return c.dot(x) - (1 - x.array().square()).log().sum();
          },
          [=](const Eigen::VectorXd& x) {
            return Eigen::VectorXd(c.array() + 2 * x.array() / (1 - x.array().square()));
          },
          rng.uniformVector(n, -0.9, 0.9)};
}

Landscape valleyFloor(Rng& rng) {
  const Residuals valley = curvedValley(rng);
  return {
      "the sum of squares of " + valley.name,
      [=](const Eigen::VectorXd& x) { return valley.phi(x).squaredNorm(); },
      [=](const Eigen::VectorXd& x) { return Eigen::VectorXd(2 * valley.J(x).transpose() * valley.phi(x)); },
      valley.start};
}

void descendsElsewhere(Check& check, Student& student) {
  const Landscape known = bowl(check.rng(), 3);
  check.near("number of points in a path that needs no step",
             static_cast<double>(
                 student.gradientDescent(known.f, known.gradient, known.start, {.tolerance = 1e9}).size()),
             1, 0);
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    SearchOptions options{.shrink = rng.uniform(0.3, 0.7),
                          .grow = rng.uniform(1.2, 2),
                          .decrease = rng.uniform(0.01, 0.4),
                          .maxSteps = 20000};
    if (i < 4) return descends(check, student, barrier(rng, 1 + rng.index(6)), options);
    if (i < 7) return descends(check, student, bowl(rng, 6 + rng.index(6)), options);
    descends(check, student, valleyFloor(rng), options);
  });
}

// Distances to beacons at the corners of a cube: where is the receiver?
Residuals beacons(Rng& rng) {
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < 8; ++i) places.emplace_back(i & 1 ? 2 : -2, i & 2 ? 2 : -2, i & 4 ? 2 : -2);
  const Eigen::Vector3d truth = rng.uniformVector(3, -1, 1);
  Eigen::VectorXd measured = 0.05 * rng.normalVector(8);
  for (int i = 0; i < 8; ++i) measured[i] += (truth - places[static_cast<std::size_t>(i)]).norm();
  return {"distances to eight beacons",
          [=](const Eigen::VectorXd& x) {
            Eigen::VectorXd phi = -measured;
            for (int i = 0; i < 8; ++i) phi[i] += (x - places[static_cast<std::size_t>(i)]).norm();
            return phi;
          },
          [=](const Eigen::VectorXd& x) {
            Eigen::MatrixXd J(8, 3);
            for (int i = 0; i < 8; ++i)
              J.row(i) = (x - places[static_cast<std::size_t>(i)]).normalized().transpose();
            return J;
          },
          rng.uniformVector(3, -1, 1)};
}

// a exp(-b t) through noisy samples.
Residuals decay(Rng& rng) {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(15, 0, 3);
  const Eigen::ArrayXd y =
      rng.uniform(1, 3) * (-rng.uniform(0.5, 1.5) * t).exp() + 0.02 * rng.normalVector(15).array();
  return {"a exp(-b t) through fifteen samples",
          [=](const Eigen::VectorXd& x) { return Eigen::VectorXd(x[0] * (-x[1] * t).exp() - y); },
          [=](const Eigen::VectorXd& x) {
            Eigen::MatrixXd J(15, 2);
            J.col(0) = (-x[1] * t).exp();
            J.col(1) = -x[0] * t * (-x[1] * t).exp();
            return J;
          },
          Eigen::Vector2d(rng.uniform(0.5, 4), rng.uniform(0.2, 2))};
}

void gaussNewtonElsewhere(Check& check, Student& student) {
  check.forEachCase(9, [&](int i) {
    Rng& rng = check.rng();
    const SearchOptions options{.shrink = 0.4, .decrease = rng.uniform(0.01, 0.3), .maxSteps = 100};
    const Residuals problem = i % 3 == 0 ? beacons(rng) : i % 3 == 1 ? decay(rng) : arcTangent(rng, 4);
    followsGaussNewton(check, student, problem, options);
  });
}

void framesElsewhere(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    Rng& rng = check.rng();
    const Eigen::Vector2d move = rng.normalVector(2);
    const double angle = rng.uniform(-7, 7);
    poseFits(check, student, move, angle);
    mappedFits(check, student, pose(move, angle), rng.normalVector(2));
    backAndRelative(check, student, randomPose(rng), pose(move, angle));
  });
}

void bayesElsewhere(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    Rng& rng = check.rng();
    if (i < 4) {
      std::vector<int> apples = {1 + rng.index(9)}, oranges = {rng.index(9)};
      for (int box = rng.index(5); box >= 0; --box) {
        apples.push_back(rng.index(9));
        oranges.push_back(1 + rng.index(9));
      }
      fruitOf(check, student, apples, oranges);
    } else if (i < 8) {
      const int boxes = 3 + rng.index(7);
      doorsOf(check, student, boxes, 1 + rng.index(boxes - 2));
    } else {
      const int rows = 2 + rng.index(4), cols = 2 + rng.index(4);
      const Eigen::VectorXd px = rng.uniformVector(rows, 0.2, 1), py = rng.uniformVector(cols, 0.2, 1);
      Eigen::MatrixXd P_XY = px * py.transpose();
      // Keeps both marginals, so only the table itself shows that X and Y depend on each other.
      const double change = std::array{0., 0.02, 1e-10, 1e-7}[static_cast<std::size_t>(i) - 8];
      P_XY.bottomRightCorner(2, 2) += change * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
      tableOf(check, student, P_XY / P_XY.sum(), i % 2 == 0);
    }
  });
}

void beliefsElsewhere(Check& check, Student& student) {
  check.forEachCase(18, [&](int i) {
    Rng& rng = check.rng();
    if (i % 6 == 0) productFits(check, student, 1 + rng.index(8));
    if (i % 6 == 1) propagationFits(check, student, 1, 1);
    if (i % 6 == 2) propagationFits(check, student, 1 + rng.index(5), 1 + rng.index(5));
    if (i % 6 == 3) betaFits(check, student, rng.index(40));
    if (i % 6 == 4) dirichletFits(check, student, 2 + rng.index(6), rng.index(40));
    if (i % 6 == 5) predictionFits(check, student, 2 + rng.index(6));
  });
}
// </hidden>

}  // namespace

grading::Checks<Student> checks() {
  return {
      {"square-equations", "matrices", "equations a and b hold", 1, Group::kVisible, squareEquations},
      {"tall-equations", "matrices", "equations c and d hold", 1, Group::kVisible, tallEquations},
      {"derivative", "matrices", "the derivative of f^T C g", 1, Group::kVisible, derivatives},
      {"minimum", "matrices", "the quadratic minimum", 1, Group::kVisible, minima},
      // <hidden>
      {"any-size", "matrices", "equations, derivative and minimum of any size", 1, Group::kHidden,
       equationsOfAnySize},
      // </hidden>
      {"descent", "optimisation", "gradient descent in a bowl and a hole", 2, Group::kVisible,
       descendsBowlAndHole},
      {"gauss-newton", "optimisation", "Gauss-Newton on three sums of squares", 1, Group::kVisible,
       gaussNewtonOnKnownProblems},
      // <hidden>
      {"descent-elsewhere", "optimisation", "gradient descent on other functions", 1, Group::kHidden,
       descendsElsewhere},
      {"gauss-newton-elsewhere", "optimisation", "Gauss-Newton on other sums of squares", 1, Group::kHidden,
       gaussNewtonElsewhere},
      // </hidden>
      {"book", "book", "the book from the script and its dot", 1, Group::kVisible, bookAndDot},
      {"frames", "book", "the inverse transform, and one frame seen from another", 1, Group::kVisible,
       frames},
      // <hidden>
      {"frames-elsewhere", "book", "other books and frames", 1, Group::kHidden, framesElsewhere},
      // </hidden>
      {"boxes", "bayes", "the boxes with fruit and the boxes with a prize", 1, Group::kVisible,
       boxesAndDoors},
      {"table", "bayes", "the joint table", 1, Group::kVisible, tables},
      // <hidden>
      {"bayes-elsewhere", "bayes", "other boxes, doors and tables", 1, Group::kHidden, bayesElsewhere},
      // </hidden>
      {"product", "beliefs", "the product of two Gaussians", 1, Group::kVisible, products},
      {"propagation", "beliefs", "a Gaussian propagated through a linear map", 1, Group::kVisible,
       propagations},
      {"conjugate", "beliefs", "Beta and Dirichlet beliefs and predictions", 1, Group::kVisible, conjugates},
      // <hidden>
      {"beliefs-elsewhere", "beliefs", "other beliefs", 1, Group::kHidden, beliefsElsewhere},
      // </hidden>
  };
}
