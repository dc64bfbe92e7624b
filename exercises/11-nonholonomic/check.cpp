#include "grading/check.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "car_checks.h"
#include "dubins_checks.h"
#include "interface.h"
#include "lots.h"
#include "overlap_checks.h"
#include "trailer_checks.h"
#include "tree_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// Part 1.

void carMoves(Check& check, Student& student) {
  check.forEachCase(10, [&](int) { moves(check, student, {}, 2); });
}

// <hidden>
void anyCarMoves(Check& check, Student& student) {
  check.forEachCase(20, [&](int) { moves(check, student, randomCar(check.rng()), 5); });
}
// </hidden>

void followsTrajectories(Check& check, Student& student) {
  for (int i = 0; i < 100; ++i) pathIsJudged(check, student);
}

// Part 2.

void distances(Check& check, Student& student) {
  for (int i = 0; i < 30; ++i) distancesFit(check, student);
}

void treeInARoom(Check& check, Student& student) {
  check.input("a room of 24 m x 16 m with three things in it");
  treeReaches(check, student, {}, randomRoom(check.rng()));
}

// <hidden>
void treeAnywhere(Check& check, Student& student) {
  check.forEachCase(4, [&](int) {
    CarModel car;
    car.wheelbase = check.rng().uniform(2.2, 2.8);
    treeReaches(check, student, car, placed(randomRoom(check.rng()), anywhere(check.rng())));
  });
}
// </hidden>

// Part 3.

void wordsLead(Check& check, Student& student) {
  check.forEachCase(6, [&](int word) {
    for (int i = 0; i < 30; ++i) wordLeads(check, student, word, i % 2 == 0);
  });
}

void shortestOfSix(Check& check, Student& student) {
  for (int i = 0; i < 60; ++i) {
    Rng& rng = check.rng();
    const Eigen::Vector3d from = randomPose(rng, 10);
    Eigen::Vector3d to = randomPose(rng, i % 2 == 0 ? 15 : 4);
    to.head<2>() += from.head<2>();
    isShortest(check, student, from, to, 3.8);
  }
}

// <hidden>
void shortestAnywhere(Check& check, Student& student) {
  check.forEachCase(40, [&](int i) {
    Rng& rng = check.rng();
    const double radius = std::exp(rng.uniform(-2, 2));
    const Eigen::Vector3d from = randomPose(rng, 10);
    if (i % 4 == 0) {  // straight on: both arcs vanish
      return isShortest(check, student, from, moved(from, {rng.uniform(1, 9), 0, 0}), radius);
    }
    Eigen::Vector3d to = randomPose(rng, radius * rng.uniform(0.5, 6));
    to.head<2>() += from.head<2>();
    isShortest(check, student, from, to, radius);
  });
}
// </hidden>

// Part 4.

// Uses the grader's motion model, not the student's. The reference needs 65 drives at most.
void parks(Check& check, Student& student, const CarModel& car, const World& lot) {
  const std::string space = check.input();
  const std::vector<Drive> plan = student.park(car, lot);
  const auto shown = check.show([&] { return parkingSeen(car, lot, plan); });
  {
    const auto none = check.ask("Is no way found?");
    check.atLeast("number of drives of park", static_cast<double>(plan.size()), 1);
  }
  check.atMost("number of drives of park", static_cast<double>(plan.size()), 500);
  double way = 0;
  Eigen::Vector3d q = lot.start;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const std::string name = fmt::format("drive {} of park", i);
    check.input(space, {{"from", q},
                        {"speed, steering, seconds", numbersOf(plan[i])},
                        {"minSteering", car.minSteering},
                        {"maxSteering", car.maxSteering}});
    checkLimits(check, car, plan[i], name);
    way += std::abs(plan[i].speed) * plan[i].seconds;
    check.atMost("length of the drives of park so far", way, 200, "m");
    check.input(space);
    isFreeAlong(check, car, q, plan[i], lot.blocks, name);
    q = exact(car, q, plan[i]);
  }
  check.input(space, {{"start", lot.start}, {"goal", lot.goal}, {"q after the last drive", q}});
  check.near("position of the car after the last drive of park", q.head<2>(), lot.goal.head<2>(), 0.1, "m");
  const auto backward =
      check.ask("Does the car stand the wrong way round?", std::cos(q[2] - lot.goal[2]) < -.9);
  check.nearAngle("heading of the car after the last drive of park", q[2], lot.goal[2], 0.05);
}

CarModel leftOnly() { return {.minSteering = 0}; }

void parksAtTheKerb(Check& check, Student& student) {
  check.input("a space at the kerb, 2.4 m longer than the car; the street is 7 m wide");
  parks(check, student, {}, streetLot(check.rng(), 7, 2.4));
}

void parksTurningLeft(Check& check, Student& student) {
  check.input(
      "a space at the kerb, 3.5 m longer than the car, that turns left only; the street is 10 m wide");
  parks(check, student, leftOnly(), streetLot(check.rng(), 10, 3.5));
}

// <hidden>
void parksAnywhere(Check& check, Student& student) {
  check.forEachCase(5, [&](int i) {
    Rng& rng = check.rng();
    World lot = i < 3 ? streetLot(rng, 7, rng.uniform(1.6, 2.4)) : bayLot(rng, 6.5, i == 3);
    if (i == 1) lot = mirrored(lot);
    parks(check, student, {}, placed(lot, anywhere(rng)));
  });
}

void parksTurningLeftAnywhere(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    Rng& rng = check.rng();
    const World lot = i < 3 ? streetLot(rng, 10, rng.uniform(2.8, 3.6)) : bayLot(rng, 9, false);
    parks(check, student, leftOnly(), placed(lot, anywhere(rng)));
  });
}
// </hidden>

// Part 5.

void rigMoves(Check& check, Student& student) {
  for (int i = 0; i < 25; ++i) rigFits(check, student);
}

void reversesATrailer(Check& check, Student& student) {
  check.forEachCase(4, [&](int) { reverses(check, student, {}, 0); });
}

// <hidden>
void reversesAnyTrailer(Check& check, Student& student) {
  check.forEachCase(6, [&](int) {
    Rig rig;
    rig.hitchLength = check.rng().uniform(2.5, 5);
    rig.car = randomCar(check.rng());
    rig.car.wheelbase = check.rng().uniform(2.3, 3);
    rig.car.maxSteering = check.rng().uniform(0.5, 0.65);
    rig.car.minSteering = -rig.car.maxSteering;
    reverses(check, student, rig, 1);
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"car-moves", "car", "Velocity, and where a drive leads", 1, Group::kVisible, carMoves},
      {"car-follows", "car", "Could a car follow this trajectory?", 1, Group::kVisible, followsTrajectories},
      // <hidden>
      {"car-any", "car", "Cars of other sizes", 1, Group::kHidden, anyCarMoves},
      // </hidden>
      {"tree-metrics", "tree", "Distances of poses and of angles", 1, Group::kVisible, distances},
      {"tree-overlap", "tree", "Whether the body of a car is free", 1, Group::kVisible, overlapsFit},
      {"tree-drive", "tree", "One drive towards a target", 1, Group::kVisible, drivesFit},
      {"tree-room", "tree", "A tree reaches its goal", 1, Group::kVisible, treeInARoom},
      // <hidden>
      {"tree-any", "tree", "Rooms that you have not seen", 2, Group::kHidden, treeAnywhere},
      // </hidden>
      {"dubins-words", "dubins", "The six words, one by one", 2, Group::kVisible, wordsLead},
      {"dubins-shortest", "dubins", "The shortest of them", 1, Group::kVisible, shortestOfSix},
      // <hidden>
      {"dubins-any", "dubins", "Other radii, near and far goals", 1, Group::kHidden, shortestAnywhere},
      // </hidden>
      {"park-kerb", "parking", "A space at the kerb", 1, Group::kVisible, parksAtTheKerb},
      {"park-left", "parking", "Turning left only", 1, Group::kVisible, parksTurningLeft},
      // <hidden>
      {"park-any", "parking", "Spaces that you have not seen", 1, Group::kHidden, parksAnywhere},
      {"park-left-any", "parking", "Turning left only, elsewhere", 1, Group::kHidden,
       parksTurningLeftAnywhere},
      // </hidden>
      {"trailer-moves", "trailer", "How a trailer moves", 1, Group::kVisible, rigMoves},
      {"trailer-reverses", "trailer", "Backward along a line", 1, Group::kVisible, reversesATrailer},
      // <hidden>
      {"trailer-any", "trailer", "Short and long trailers", 1, Group::kHidden, reversesAnyTrailer},
      // </hidden>
  };
}
