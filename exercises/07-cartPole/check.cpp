#include "grading/check.h"

#include "cart_checks.h"
#include "gain_checks.h"
#include "interface.h"
#include "sensor_checks.h"
#include "stability_checks.h"

using rex::grading::Check;
using rex::grading::Group;

namespace {

void linear(Check& check, Student& student) {
  for (int i = 0; i < 20; ++i) ratesFit(check, student, i < 5 ? PoleCart{} : randomCart(check.rng()));
  linearisationFits(check, student, {});
  const auto fixed =
      check.ask("It is right for the cart of the sheet: is a number of that cart in the code?");
  linearisationFits(check, student, randomCart(check.rng()));
}

void iterates(Check& check, Student& student) {
  firstStepsFit(check, student);
  iterationFits(check, student, regulationOf(plantOf({}), costsOfTheSheet()), 1e-3, 1e-5);
  iterationFits(check, student, randomRegulation(check.rng(), false), 5e-3, 1e-4);
  iterationEnds(check, student);
}

void halves(Check& check, Student& student) {
  hamiltonianFits(check, student, smallRegulation());
  hamiltonianFits(check, student, regulationOf(plantOf({}), costsOfTheSheet()));
  // Both poles of the closed loop are -1, with a single eigenvector.
  hamiltonianFits(check, student,
                  regulationOf({drift(), Eigen::Vector2d(0, 1)},
                               {Eigen::Vector2d(1, 2).asDiagonal(), Eigen::MatrixXd::Identity(1, 1)}));
  for (int i = 0; i < 5; ++i) hamiltonianFits(check, student, randomRegulation(check.rng(), i == 4));
  hamiltonianFits(check, student, stiffRegulation(check.rng()));
  gainsOfTheSheetFit(check, student);
  for (int i = 0; i < 5; ++i) gainsFit(check, student, randomRegulation(check.rng(), false));
}

void outings(Check& check, Student& student) {
  const PoleCart cart;
  const Eigen::MatrixXd K = -regulationOf(plantOf(cart), costsOfTheSheet()).optimal.K;
  stepsFit(check, student, cart, K);
  check.input("optimal gains, theta = 0.2");
  outingFits(check, student, cart, K, {0, 0, .2, 0}, {.steps = 500});
  check.input("optimal gains, theta = 0.2, no noise and long steps");
  outingFits(check, student, cart, K, {0, 0, .2, 0}, {.tau = .05, .noise = 0, .steps = 100});
  check.input("no gains, so that the pole falls");
  outingFits(check, student, cart, Eigen::MatrixXd::Zero(1, 4), {0, 0, -.2, 0}, {});
}

void reach(Check& check, Student& student) {
  const Eigen::Matrix2d still = Eigen::Matrix2d::Zero();
  reachFits(check, student, {still, Eigen::Vector2d(1, 0)}, 1);
  reachFits(check, student, {still, Eigen::Vector2d(1, 1)}, 1);
  reachFits(check, student, {drift(), Eigen::Vector2d(0, 1)}, 2);
  reachFits(check, student, {still, Eigen::Vector2d(1, 1e-7).asDiagonal().toDenseMatrix()}, 2);
  reachFits(check, student, {drift(), Eigen::Vector2d(1, 0)}, 1);
  reachFits(check, student, plantOf({}), 4);
  reachFits(check, student, partlyReached(check.rng(), 4, 3, 2), 3);
  // The rank does not depend on the unit of u.
  for (const double unit : {1e-11, 1e7}) {
    Plant plant = partlyReached(check.rng(), 3, 2, 1);
    plant.B *= unit;
    reachFits(check, student, plant, 2);
  }
}

void poles(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) {
    const Regulation task =
        i == 0 ? regulationOf(plantOf({}), costsOfTheSheet()) : randomRegulation(check.rng(), false);
    check.input("a plant under optimal gains",
                {{"A", task.plant.A}, {"B", task.plant.B}, {"K", -task.optimal.K}});
    check.near("slowestPole under optimal gains", student.slowestPole(task.plant, -task.optimal.K),
               task.optimal.closedLoop.real().maxCoeff(), 1e-6, "1/s");
    describe(check, "a plant with K = 0", task.plant);
    check.near("slowestPole without control", student.slowestPole(task.plant, 0 * task.optimal.K),
               abscissa(task.plant.A), 1e-6, "1/s");
  }
  const std::vector<KnownFate> known = knownFates(check.rng());
  for (const std::size_t i : shuffled(check.rng(), 9)) fateFits(check, student, known[i]);
}

// With the cart of the sheet alone, four fixed numbers would pass.
void quick(Check& check, Student& student) {
  for (int i = 0; i < 3; ++i) {
    PoleCart cart = i == 0 ? PoleCart{} : randomCart(check.rng());
    cart.g = 9.8;  // so that the bound is met
    gainsAreQuick(check, student, cart);
  }
}

void observer(Check& check, Student& student) {
  // Of position, velocity, acceleration and jerk only the acceleration is seen.
  Eigen::Matrix4d chain = Eigen::Matrix4d::Zero();
  chain.diagonal(1).setOnes();
  unseenFits(check, student, chain, Eigen::RowVector4d(0, 0, 1, 0));
  const Eigen::MatrixXd A = plantOf({}).A;
  unseenFits(check, student, drift(), Eigen::RowVector2d(0, 1));
  unseenFits(check, student, A, Eigen::RowVector4d(1, 0, 0, 0));
  unseenFits(check, student, A, Eigen::RowVector4d(0, 0, 1, 0));
  for (const Eigen::Index rank : {2, 3}) {
    const Plant dual = partlySeen(check.rng(), 4, rank, 1);
    unseenFits(check, student, dual.A.transpose(), dual.B.transpose());
  }
  for (int i = 0; i < 5; ++i) observerFits(check, student, randomRegulation(check.rng(), i == 4));
}

void loops(Check& check, Student& student) {
  observedLoopFits(check, student, doyle());
  for (int i = 0; i < 5; ++i) observedLoopFits(check, student, randomObserved(check.rng()));
  const Plant lag{Eigen::MatrixXd::Constant(1, 1, -2), Eigen::MatrixXd::Constant(1, 1, 3)};
  responseFits(check, student, lag, Eigen::MatrixXd::Identity(1, 1), Eigen::Vector3d(.5, 2, 20));
  const Regulation cart = regulationOf(plantOf({}), costsOfTheSheet());
  responseFits(check, student, cart.plant, cart.optimal.K, Eigen::VectorXd::LinSpaced(60, .5, 30));
  for (int i = 0; i < 5; ++i) randomResponseFits(check, student);
}

// <hidden>
void otherCarts(Check& check, Student& student) {
  check.forEachCase(10, [&](int) { linearisationFits(check, student, randomCart(check.rng())); });
}

void otherRegulators(Check& check, Student& student) {
  check.forEachCase(11, [&](int i) {
    if (i == 10) return hamiltonianFits(check, student, stiffRegulation(check.rng()));
    const Regulation task = randomRegulation(check.rng(), i % 2 == 1);
    hamiltonianFits(check, student, task);
    gainsFit(check, student, task);
    iterationFits(check, student, task, 5e-3, 1e-4);
  });
}

void survives(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    if (i < 2)
      survivesFrom(check, student, i == 0 ? .5 : -1, 0);
    else
      survivesFrom(check, student, check.rng().uniform(-.4, .4), i == 2 ? .01 : .1);
  });
}

void reachesOthers(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    rex::Rng& rng = check.rng();
    const int n = 2 + rng.index(4), m = 1 + rng.index(2), rank = i % 3 == 0 ? n : 1 + rng.index(n - 1);
    reachFits(check, student, partlyReached(rng, n, rank, std::min(m, rank)), rank);
  });
}

void otherFates(Check& check, Student& student) {
  const std::vector<std::size_t> order = shuffled(check.rng(), knownFates(check.rng()).size());
  check.forEachCase(static_cast<int>(order.size()), [&](int i) {
    KnownFate known = knownFates(check.rng())[order[static_cast<std::size_t>(i)]];
    const Eigen::MatrixXd T = randomCoordinates(check.rng(), known.A.rows());
    known.A = T * known.A * rex::inverse(T);
    fateFits(check, student, known);
  });
}

void quickOnOthers(Check& check, Student& student) {
  check.forEachCase(3, [&](int) {
    PoleCart cart = randomCart(check.rng());
    cart.g = 9.8;
    gainsAreQuick(check, student, cart);
  });
}

void otherSensors(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    rex::Rng& rng = check.rng();
    const int n = 2 + rng.index(3), rank = 1 + rng.index(n - 1), p = 1 + rng.index(2);
    const Plant dual = partlySeen(rng, n, rank, std::min(p, rank));
    unseenFits(check, student, dual.A.transpose(), dual.B.transpose());
    observerFits(check, student, randomRegulation(rng, i % 2 == 1));
    observedLoopFits(check, student, randomObserved(rng));
    randomResponseFits(check, student);
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"linear", "linear", "The rates of the cart pole, A and B of that of the sheet", 2, Group::kVisible,
       linear},
      {"iterates", "riccati", "The iteration of the sheet", 1, Group::kVisible, iterates},
      {"hamiltonian", "riccati", "The Hamiltonian's stable half, gains and their sign", 2, Group::kVisible,
       halves},
      {"outings", "simulate", "One step with noise, and all until the end or the fall", 2, Group::kVisible,
       outings},
      {"reach", "reach", "The controllability matrix and its rank", 1, Group::kVisible, reach},
      {"poles", "poles", "Poles and what they mean", 1, Group::kVisible, poles},
      {"quick", "poles", "A search for quick gains", 1, Group::kVisible, quick},
      {"observer", "sensor", "What a sensor never shows, and an observer", 1, Group::kVisible, observer},
      {"loops", "sensor", "The loop with an observer, and responses to sines", 2, Group::kVisible, loops},
      // <hidden>
      {"other-carts", "linear", "Other carts and poles", 1, Group::kHidden, otherCarts},
      {"other-regulators", "riccati", "Other plants and costs", 1, Group::kHidden, otherRegulators},
      {"survives", "simulate", "Your own controller stays up", 1, Group::kHidden, survives},
      {"reaches-others", "reach", "Other plants, reached in part", 1, Group::kHidden, reachesOthers},
      {"other-fates", "poles", "The same in other coordinates", 1, Group::kHidden, otherFates},
      {"quick-others", "poles", "Quick gains for other carts", 1, Group::kHidden, quickOnOthers},
      {"other-sensors", "sensor", "Other plants and sensors", 1, Group::kHidden, otherSensors},
      // </hidden>
  };
}
