#include "interface.h"

namespace {

using rex::grading::Check;
using rex::grading::Group;

void triesTurned(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    rex::Rng& rng = check.rng();
    const Eigen::Vector2d p = Eigen::Vector2d::NullaryExpr([&] { return rng.uniform(-1, 1); });
    const double angle = rng.uniform(-1, 1);
    check.input("random values", {{"p", p}, {"angle", angle}});
    const Eigen::Vector2d got = student.turned(p, angle);
    const Eigen::Vector2d wanted = Eigen::Vector2d::Ones();  // TODO: as it follows from the input
    check.near("turned", got, wanted, 1e-9);
  });
}

void triesAngles(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    rex::Rng& rng = check.rng();
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k < 5; ++k)
      points.push_back(Eigen::Vector2d::NullaryExpr([&] { return rng.uniform(-1, 1); }));
    const int count = 1 + rng.index(5);
    check.input("random values", {{"count", count}});
    const Eigen::VectorXd got = student.angles(points, count);
    const Eigen::VectorXd wanted = Eigen::VectorXd::Ones(3);  // TODO: as it follows from the input
    check.near("angles", got, wanted, 1e-9);
  });
}

void triesIsStill(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    rex::Rng& rng = check.rng();
    const Body body{};  // TODO: a value
    const int kGiven = 1 + rng.index(5);
    const double wantedGiven = rng.uniform(-1, 1);
    check.input("random values", {{"k", kGiven}, {"wanted", wantedGiven}});
    const bool got = student.isStill(body, kGiven, wantedGiven);
    check.that("isStill says yes here", got);  // TODO
  });
}

void triesPosed(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    rex::Rng& rng = check.rng();
    const rex::Pose start = rex::expSE3(rng.uniformVector(6, -1, 1));
    check.input("random values");
    const rex::Pose got = student.posed(start, check.split(1));
    const rex::Pose wanted = rex::translation(1, 1, 1);  // TODO: as it follows from the input
    check.near("rotation of posed()", got.R, wanted.R, 1e-9);
    check.near("position of posed()", got.p, wanted.p, 1e-9, "m");
  });
}

void triesLongest(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    rex::Rng& rng = check.rng();
    const rex::SimulatorDescription S = rex::Simulator("man.ors").description();
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(3, 3, [&] { return rng.uniform(-1, 1); });
    check.input("random values", {{"A", A}});
    const std::vector<Eigen::VectorXd> got = student.longest(S, A);
    check.that("longest() returns the right values", got.size() == 5);  // TODO
  });
}

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"turned", "turned", "Turned", 4, Group::kVisible, triesTurned},
      {"angles", "turned", "Angles", 4, Group::kVisible, triesAngles},
      {"is-still", "turned", "Is still", 4, Group::kVisible, triesIsStill},
      {"posed", "posed", "Posed", 4, Group::kVisible, triesPosed},
      {"longest", "posed", "Longest", 4, Group::kVisible, triesLongest},
  };
}
