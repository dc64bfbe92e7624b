#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

#include "exercise.h"
#include "show.h"
#include "worlds.h"

using namespace rex;

Eigen::Vector3d velocityOf(const CarModel& car, const Eigen::Vector3d& q, double speed, double steering) {
  // TODO: slide 4:48. What does its third line say about a car that stands still?
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d driven(const CarModel& car, const Eigen::Vector3d& q, const Drive& drive) {
  // TODO: the car drives on a circle, or in many small steps with velocityOf().
  return q;
}

bool canFollow(const CarModel& car, const std::vector<Eigen::Vector3d>& path) {
  // TODO: between two poses lies an arc. Which direction has its chord, and how large is its radius?
  return true;
}

double poseDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // TODO: slide 4:59 a), and then add x and y.
  return 0;
}

double angleDistance(double a, double b) {
  // TODO: slide 4:59 b). What if one angle is 7 turns?
  return 0;
}

bool isFree(const CarModel& car, const Eigen::Vector3d& q, const std::vector<Block>& blocks) {
  // TODO: do two rectangles overlap? It is not enough to look at their corners.
  return true;
}

// TODO: you may want a function that tests the whole path of a drive.

std::optional<Drive> driveTowards(const CarModel& car, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& target, double seconds,
                                  const std::vector<Block>& blocks, Rng& rng) {
  // TODO: which of 20 random controls leads nearest to the target without a collision?
  return {};
}

std::vector<CarNode> growTree(const CarModel& car, const World& world, Rng& rng) {
  std::vector<CarNode> tree{{world.start, -1, {}}};
  // TODO: slide 4:58. Aim at the goal now and then.
  return tree;
}

std::optional<std::array<double, 3>> dubinsLengths(DubinsWord word, const Eigen::Vector3d& from,
                                                   const Eigen::Vector3d& to, double radius) {
  // TODO: where are the centres of the first and of the last circle, and how far apart?
  return {};
}

DubinsWay shortestDubins(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  DubinsWay best;
  // TODO: ask for all six.
  return best;
}

// TODO: your own functions for parking, such as curves and parts of a path.

std::vector<Drive> park(const CarModel& car, const World& lot) {
  // TODO: a path out of the space, driven backward, is a path into it.
  return {};
}

Eigen::Vector4d rigVelocity(const Rig& rig, const Eigen::Vector4d& q, double speed, double steering) {
  Eigen::Vector4d velocity = Eigen::Vector4d::Zero();
  // TODO: where is the axle of the trailer, how does it move, and in which direction can it?
  return velocity;
}

double hitchGrowth(const Rig& rig, double speed) {
  // TODO: the equation of the angle between car and trailer, near zero.
  return 0;
}

double reverseSteering(const Rig& rig, const Eigen::Vector4d& q) {
  // TODO: which heading should the trailer have beside the axis? Which angle at the hitch turns it there,
  // and which steering angle leads to that?
  return 0;
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  const CarModel car;

  // Part 1: steering angles from one limit to the other, held for 6 s at 1 m/s.
  showDrives(car, 6);

  // Part 2: a room with things in it.
  showTree(car, room());

  // Part 3: the radius is the smallest that the car can drive.
  showDubins(car, car.wheelbase / std::tan(car.maxSteering));

  // Part 4: streets 7 and 10 m wide with spaces of 6.4 and 7.4 m at the kerb, and one with spaces across.
  showParking("street", "Into a space at the kerb", car, street(7, 6.4));
  showParking("bay", "Backward into a bay", car, bays());
  showParking("left", "The same street, turning left only", {.minSteering = 0}, street(10, 7.4));

  // Part 5: backward from 15 m, 1 m beside the line, with small angles between it and the car and trailer.
  showTrailer(Rig{}, {15, 1, .05, .04});
}
