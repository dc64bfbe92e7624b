#include "interface.h"

using rex::grading::Check;
using rex::grading::Group;

namespace {

void stepReaches(Check& check, Student& student) {
  check.forEachCase(3, [&](int) {
    const Eigen::Vector3d target = check.rng().normalVector(3);
    check.input("a target near the origin");
    check.near("position after the step", student.ikStep(Eigen::Vector3d::Zero(), target), target, 1e-9, "m");
  });
}

void squares(Check& check, Student& student) {
  check.forEachCase(4, [&](int k) { check.near("square", student.square(k), k * k, 1e-12); });
}

void searches(Check& check, Student& student) {
  const auto distance = [](const Eigen::VectorXd& q) { return q.norm(); };
  const Reached reached = student.search(Eigen::Vector3d(1, 2, 2), distance);
  check.atMost("distance at the end", reached.distance, 3, "m");
  check.that("the distance belongs to the configuration", reached.distance == distance(reached.q));
}

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"step", "a", "One step reaches the target", 4, Group::kVisible, stepReaches},
      {"square", "b", "Numbers are squared", 2, Group::kVisible, squares},
      {"step-unseen", "a", "One step reaches unseen targets", 3, Group::kHidden, stepReaches},
      {"search", "b", "The search comes nearer", 1, Group::kVisible, searches},
  };
}
