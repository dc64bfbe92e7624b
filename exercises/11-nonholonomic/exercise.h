#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, radians; left turns count positive. A pose is
// q = (x, y, heading), a heading any angle: two that differ by whole turns are the same. Slides are named as
// chapter:number.

// Part 1, the car (4:48 to 4:51).

/// A car, seen from above. Its pose is that of the point between its rear wheels; its body is a rectangle.
struct CarModel {
  double wheelbase = 2.6;                        ///< L, from the rear axle to the front axle
  double minSteering = -0.6, maxSteering = 0.6;  ///< of the front wheels; a minSteering of 0: left turns only
  double front = 3.5, back = 0.9;                ///< reach of the body ahead of and behind the rear axle
  double width = 1.8;
};

/// Controls u = (speed, steering) and how long they are held. A negative speed drives backward.
struct Drive {
  double speed = 0, steering = 0, seconds = 0;
};

/// The velocity of q = (x, y, heading) of a car, regardless of its limits: 4:48 with a dot over theta.
Eigen::Vector3d velocityOf(const CarModel& car, const Eigen::Vector3d& q, double speed, double steering);

/// The pose that a car at q reaches by a drive. Accurate to 1 mm and 1 mrad for each metre driven, in
/// closed form, or in small steps, each along its mean heading: 10 cm are short enough, and park() may call
/// this a million times. The steering angle may be zero, or tiny.
Eigen::Vector3d driven(const CarModel& car, const Eigen::Vector3d& q, const Drive& drive);

/// Could a car follow this trajectory (4:50)? Yes, if it gets from each pose to the next with constant
/// controls, within its limits, forward or backward. Poses are up to 2 m and 0.6 rad apart, and come with
/// an error of up to 1 um and 1 urad. A trajectory that cannot be followed is off by a centimetre or more
/// per metre, or needs a steering angle that is too large by a tenth.
bool canFollow(const CarModel& car, const std::vector<Eigen::Vector3d>& path);

// Part 2, a tree of controls (4:52, 4:58, 4:59).

/// The distance of (x, y, e^(i heading)): 4:59.
double poseDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The distance b) of two angles on 4:59, the shorter way round. The angles may be any numbers.
double angleDistance(double a, double b);

/// A rectangle that is in the way: a parked car, a wall. `middle` is (x, y, heading), `length` along it.
struct Block {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double length = 1, width = 1;
};

/// Whether the body of the car at q overlaps none of the blocks. Accurate to 1 mm.
bool isFree(const CarModel& car, const Eigen::Vector3d& q, const std::vector<Block>& blocks);

/// Lines 5 to 7 of 4:58. Draws at least 20 pairs of a speed, -1 or 1 m/s, and a steering angle within the
/// limits of the car, each held for `seconds`. Of those whose way is free, tested at least every 10 cm, it
/// returns the one that leads nearest to the target by poseDistance(); nothing if all ways are blocked.
std::optional<Drive> driveTowards(const CarModel& car, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& target, double seconds,
                                  const std::vector<Block>& blocks, rex::Rng& rng);
/// Given: the drives of two calls, one after the other, with one generator.
inline std::pair<std::optional<Drive>, std::optional<Drive>> drivesOfTwo(
    const CarModel& car, const Eigen::Vector3d& from, const Eigen::Vector3d& target, double seconds,
    const std::vector<Block>& blocks, rex::Rng& rng) {
  const std::optional<Drive> first = driveTowards(car, from, target, seconds, blocks, rng);
  return {first, driveTowards(car, from, target, seconds, blocks, rng)};
}

/// The start of a car, its goal, and what is in the way. There is no use in leaving the rectangle from
/// `lower` to `upper` (x, y): it is surrounded by walls, which are among the blocks.
struct World {
  Eigen::Vector3d start = Eigen::Vector3d::Zero(), goal = Eigen::Vector3d::Zero();
  std::vector<Block> blocks;
  Eigen::Vector2d lower = Eigen::Vector2d::Zero(), upper = Eigen::Vector2d::Zero();
};

/// A node of a tree: `by` leads to q from the node with the number `parent`, -1 for the first.
struct CarNode {
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  int parent = -1;
  Drive by;
};

/// A tree of controls that grows from the start until it reaches the goal, within 0.6 by poseDistance().
/// Parents come before their children; the last node is the one at the goal. Speeds are 1 m/s at most, an
/// edge lasts 10 s at most, and on its way the body of the car touches nothing.
std::vector<CarNode> growTree(const CarModel& car, const World& world, rex::Rng& rng);

// Part 3, Dubins curves (4:60, 4:61).

enum class DubinsWord { kLSL, kLSR, kRSL, kRSR, kLRL, kRLR };

/// The lengths [m] of the three pieces of a word, all driven forward. Arcs have that radius and are shorter
/// than a whole turn; the middle one of LRL and RLR is longer than half a turn (4:60); d >= 0. Returns
/// nothing if this word does not lead from one pose to the other. Accurate to 1e-6 m.
std::optional<std::array<double, 3>> dubinsLengths(DubinsWord word, const Eigen::Vector3d& from,
                                                   const Eigen::Vector3d& to, double radius);

/// A word with the lengths of its pieces.
struct DubinsWay {
  DubinsWord word = DubinsWord::kLSL;
  std::array<double, 3> lengths{};
};

/// The shortest of the six.
DubinsWay shortestDubins(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

// Part 4, parking (4:54 to 4:56).

/// The drives that take a car from the start into a parking space, the goal of the world: at most 500 of
/// them and 200 m in all, at 1 m/s at most. The car ends within 0.1 m of the goal, in x and in y, and
/// within 0.05 rad; it never steers beyond its limits, and its body touches no block on the way. A scratch
/// of 5 cm is tolerated, here and in part 2. Some cars turn left only. Spaces at the kerb are at least 1.6
/// m longer than the car (2.8 m for those cars), spaces across the street are at least 2.5 m apart from
/// middle to middle; streets are 6.5 to 10 m wide. A check has up to five of them, and 20 s for all.
std::vector<Drive> park(const CarModel& car, const World& lot);

// Part 5, a trailer (4:57).

/// A car with a trailer on a hitch between its rear wheels. Its state is (x, y, heading, heading of the
/// trailer), the first three as for the car alone.
struct Rig {
  CarModel car;
  double hitchLength = 4;  ///< d, from the hitch to the axle of the trailer
};

/// The velocity of its state. The axle of the trailer cannot slide sideways either.
Eigen::Vector4d rigVelocity(const Rig& rig, const Eigen::Vector4d& q, double speed, double steering);

/// With the wheels straight, a small angle between car and trailer becomes exp(rate t) times as large: the
/// rate [1/s].
double hitchGrowth(const Rig& rig, double speed);

/// The steering angle of a rig that drives backward along the x axis, towards -x, at -1 m/s. Called every
/// 50 ms, it brings the axle of the trailer to the axis, from up to 1 m beside it, with headings of car and
/// trailer up to 0.25 rad off: after 40 m the axle is and stays within 5 cm, and both headings within 0.05
/// rad. On the way the angle between car and trailer stays below 1.2 rad. Hitches are 2.5 to 5 m long,
/// wheelbases 2.3 to 3 m, and cars steer by 0.5 rad at least. Whole turns may have been added to either
/// heading.
double reverseSteering(const Rig& rig, const Eigen::Vector4d& q);
