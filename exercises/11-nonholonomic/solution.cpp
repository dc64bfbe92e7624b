#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

#include "exercise.h"
#include "show.h"
#include "worlds.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

Eigen::Vector3d velocityOf(const CarModel& car, const Eigen::Vector3d& q, double speed, double steering) {
  // <solution velocityOf>
  return {speed * std::cos(q[2]), speed * std::sin(q[2]), speed / car.wheelbase * std::tan(steering)};
  // <todo>
  //| // TODO: slide 4:48. What does its third line say about a car that stands still?
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Eigen::Vector3d driven(const CarModel& car, const Eigen::Vector3d& q, const Drive& drive) {
  // <solution driven>
  // The chord of an arc has the direction halfway between the two headings, and a length of way sin(a) / a.
  const double way = drive.speed * drive.seconds, half = way * std::tan(drive.steering) / car.wheelbase / 2;
  const double chord = std::abs(half) < 1e-6 ? way : way * std::sin(half) / half;
  return {q[0] + chord * std::cos(q[2] + half), q[1] + chord * std::sin(q[2] + half), q[2] + 2 * half};
  // <todo>
  //| // TODO: the car drives on a circle, or in many small steps with velocityOf().
  //| return q;
  // </solution>
}

bool canFollow(const CarModel& car, const std::vector<Eigen::Vector3d>& path) {
  // <solution canFollow>
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Eigen::Vector3d &a = path[k - 1], &b = path[k];
    const double turn = std::remainder(b[2] - a[2], 2 * std::numbers::pi), middle = a[2] + turn / 2;
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    // The constraint of 4:49 holds for the chord of an arc with the heading in the middle of it.
    if (std::abs(dx * std::sin(middle) - dy * std::cos(middle)) > 1e-4) return false;
    const double chord = dx * std::cos(middle) + dy * std::sin(middle);
    if (std::abs(chord) < 1e-4) {
      if (std::abs(turn) > 1e-4) return false;
      continue;
    }
    const double curvature = 2 * std::sin(turn / 2) / chord, steering = std::atan(car.wheelbase * curvature);
    if (steering < car.minSteering - 0.01 || steering > car.maxSteering + 0.01) return false;
  }
  return true;
  // <todo>
  //| // TODO: between two poses lies an arc. Which direction has its chord, and how large is its radius?
  //| return true;
  // </solution>
}

double poseDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // <solution poseDistance>
  const double heading = 2 * std::sin((a[2] - b[2]) / 2);
  return std::hypot(a[0] - b[0], a[1] - b[1], heading);
  // <todo>
  //| // TODO: slide 4:59 a), and then add x and y.
  //| return 0;
  // </solution>
}

double angleDistance(double a, double b) {
  // <solution angleDistance>
  return std::abs(std::remainder(a - b, 2 * std::numbers::pi));
  // <todo>
  //| // TODO: slide 4:59 b). What if one angle is 7 turns?
  //| return 0;
  // </solution>
}

bool isFree(const CarModel& car, const Eigen::Vector3d& q, const std::vector<Block>& blocks) {
  // <solution isFree>
  // Two rectangles overlap unless one of their four sides' directions sees a gap between their shadows.
  const double a = (car.front + car.back) / 2, b = car.width / 2, ahead = (car.front - car.back) / 2;
  const double cosine = std::cos(q[2]), sine = std::sin(q[2]);
  for (const Block& block : blocks) {
    const double A = block.length / 2, B = block.width / 2;
    const double dx = block.middle[0] - q[0] - ahead * cosine, dy = block.middle[1] - q[1] - ahead * sine;
    const double reach = std::hypot(a, b) + std::hypot(A, B);
    if (dx * dx + dy * dy > reach * reach) continue;
    const double c = std::cos(block.middle[2]), s = std::sin(block.middle[2]);
    const double along = std::abs(cosine * c + sine * s), across = std::abs(cosine * s - sine * c);
    const bool gap = std::abs(dx * cosine + dy * sine) > a + A * along + B * across ||
                     std::abs(dy * cosine - dx * sine) > b + A * across + B * along ||
                     std::abs(dx * c + dy * s) > A + a * along + b * across ||
                     std::abs(dy * c - dx * s) > B + a * across + b * along;
    if (!gap) return false;
  }
  return true;
  // <todo>
  //| // TODO: do two rectangles overlap? It is not enough to look at their corners.
  //| return true;
  // </solution>
}

// <solution isFreeOnTheWay>
// Tested every 10 cm, and with a car that is 3 cm larger on all sides: it stands for what lies between.
bool isFreeOnTheWay(CarModel car, const Eigen::Vector3d& from, const Drive& drive,
                    const std::vector<Block>& blocks) {
  const int tests = std::max(1, static_cast<int>(std::ceil(10 * std::abs(drive.speed) * drive.seconds)));
  car.front += 0.03;
  car.back += 0.03;
  car.width += 0.06;
  for (int i = 1; i <= tests; ++i) {
    const Drive part{drive.speed, drive.steering, drive.seconds * i / tests};
    if (!isFree(car, driven(car, from, part), blocks)) return false;
  }
  return true;
}
// <todo>
//| // TODO: you may want a function that tests the whole path of a drive.
// </solution>

std::optional<Drive> driveTowards(const CarModel& car, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& target, double seconds,
                                  const std::vector<Block>& blocks, Rng& rng) {
  // <solution driveTowards>
  std::vector<std::pair<double, Drive>> trials;
  while (trials.size() < 20) {
    const double speed = rng.index(2) == 0 ? 1 : -1;
    const Drive drive{speed, rng.uniform(car.minSteering, car.maxSteering), seconds};
    trials.emplace_back(poseDistance(driven(car, from, drive), target), drive);
  }
  std::ranges::sort(trials, {}, [](const auto& trial) { return trial.first; });
  for (const auto& [distance, drive] : trials)
    if (isFreeOnTheWay(car, from, drive, blocks)) return drive;
  return {};
  // <todo>
  //| // TODO: which of 20 random controls leads nearest to the target without a collision?
  //| return {};
  // </solution>
}

std::vector<CarNode> growTree(const CarModel& car, const World& world, Rng& rng) {
  std::vector<CarNode> tree{{world.start, -1, {}}};
  // <solution growTree>
  for (int i = 0; i < 300000 && poseDistance(tree.back().q, world.goal) > 0.59; ++i) {
    if (tree.size() > 3000) tree.resize(1);  // most trees need fewer; a new one is cheaper than a larger one
    Eigen::Vector3d target(rng.uniform(world.lower.x(), world.upper.x()),
                           rng.uniform(world.lower.y(), world.upper.y()), rng.uniform(-4, 4));
    if (rng.index(10) == 0) target = world.goal;
    int near = 0;
    double least = 1e9;
    for (std::size_t i = 0; i < tree.size(); ++i) {
      const double distance = poseDistance(tree[i].q, target);
      if (distance >= least) continue;
      least = distance;
      near = static_cast<int>(i);
    }
    const Eigen::Vector3d from = tree[static_cast<std::size_t>(near)].q;
    const auto drive = driveTowards(car, from, target, rng.uniform(0.3, 2), world.blocks, rng);
    if (drive) tree.push_back({driven(car, from, *drive), near, *drive});
  }
  // <todo>
  //| // TODO: slide 4:58. Aim at the goal now and then.
  // </solution>
  return tree;
}

std::optional<std::array<double, 3>> dubinsLengths(DubinsWord word, const Eigen::Vector3d& from,
                                                   const Eigen::Vector3d& to, double radius) {
  // <solution dubinsLengths>
  const auto left = [&](char letter) { return letter == 'L' ? 1 : -1; };
  const char* letters = std::array{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"}[static_cast<std::size_t>(word)];
  const int first = left(letters[0]), last = left(letters[2]);
  // From the centre of the first circle to that of the last.
  const double dx = to[0] - last * radius * std::sin(to[2]) - from[0] + first * radius * std::sin(from[2]);
  const double dy = to[1] + last * radius * std::cos(to[2]) - from[1] - first * radius * std::cos(from[2]);
  const double distance = std::hypot(dx, dy), direction = std::atan2(dy, dx);
  // Between 0 and 2 pi; what rounding pushes below 0 is no whole turn.
  const auto turn = [](double angle) {
    const double rest = angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi));
    return rest > 2 * std::numbers::pi - 1e-9 ? 0 : rest;
  };
  if (letters[1] == 'S') {
    // Outside of both circles, or across from one to the other: then the way and two radii span a triangle.
    const double across = first == last ? 0 : 2 * radius;
    if (distance < across) return {};
    const double straight = std::sqrt(distance * distance - across * across);
    const double heading = direction + first * std::atan2(across, straight);
    return std::array{radius * turn(first * (heading - from[2])), straight,
                      radius * turn(last * (to[2] - heading))};
  }
  // A third circle touches both: its centre is 2 r away from both of theirs.
  if (distance > 4 * radius) return {};
  const double middle = 2 * (std::numbers::pi - std::asin(distance / (4 * radius)));
  const double heading = direction + first * middle / 2;  // at the end of the first arc
  return std::array{radius * turn(first * (heading - from[2])), radius * middle,
                    radius * turn(first * (to[2] - heading) + middle)};
  // <todo>
  //| // TODO: where are the centres of the first and of the last circle, and how far apart?
  //| return {};
  // </solution>
}

DubinsWay shortestDubins(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  DubinsWay best;
  // <solution shortestDubins>
  double least = 1e300;
  for (int w = 0; w < 6; ++w) {
    const auto word = static_cast<DubinsWord>(w);
    const auto lengths = dubinsLengths(word, from, to, radius);
    if (!lengths) continue;
    const double length = (*lengths)[0] + (*lengths)[1] + (*lengths)[2];
    if (length >= least) continue;
    least = length;
    best = {word, *lengths};
  }
  // <todo>
  //| // TODO: ask for all six.
  // </solution>
  return best;
}

// <solution waysToPark>
// The shortest Dubins curve that the car can drive and that nothing blocks, forward or backward. Driven
// backward, a car moves like one that looks the other way and steers to the other side.
std::vector<Drive> curveTo(const CarModel& car, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                           const std::vector<Block>& blocks) {
  const double steering = car.minSteering < 0 ? std::min(car.maxSteering, -car.minSteering) : car.maxSteering;
  const double radius = car.wheelbase / std::tan(steering);
  std::vector<std::pair<double, std::vector<Drive>>> curves;
  for (const double speed : {1., -1.}) {
    const Eigen::Vector3d turned(0, 0, speed > 0 ? 0 : std::numbers::pi);
    for (int w = 0; w < 6; ++w) {
      const auto lengths = dubinsLengths(static_cast<DubinsWord>(w), from + turned, to + turned, radius);
      if (!lengths) continue;
      const std::string letters =
          std::array{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"}[static_cast<std::size_t>(w)];
      std::vector<Drive> drives;
      double way = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double angle = letters[k] == 'S' ? 0 : letters[k] == 'L' ? speed * steering : -speed * steering;
        if ((*lengths)[k] > 0) drives.push_back({speed, angle, (*lengths)[k]});
        way += (*lengths)[k];
      }
      if (std::ranges::all_of(drives, [&](const Drive& d) { return d.steering >= car.minSteering; }))
        curves.emplace_back(way, drives);
    }
  }
  std::ranges::sort(curves, {}, [](const auto& curve) { return curve.first; });
  for (const auto& [way, drives] : curves) {
    Eigen::Vector3d q = from;
    if (std::ranges::all_of(drives, [&](const Drive& drive) {
          const Eigen::Vector3d before = q;
          q = driven(car, q, drive);
          return isFreeOnTheWay(car, before, drive, blocks);
        }))
      return drives;
  }
  return {};
}

// Out of the space is easier than in: a tree grows from there, cheapest nodes first, until a curve leads from
// the start to one of them. Every way out is a way in, driven backward.
std::vector<Drive> parkInSteps(const CarModel& car, const World& lot, double step) {
  struct Way {
    double cost;
    std::size_t node;
    bool operator<(const Way& other) const { return cost > other.cost; }
  };
  std::vector<CarNode> tree{{lot.goal, -1, {}}};
  std::priority_queue<Way> open;
  open.push({0, 0});
  std::set<std::array<double, 3>> seen;
  while (!open.empty() && tree.size() < 100000) {
    const auto [cost, at] = open.top();
    open.pop();
    const CarNode from = tree[at];
    std::vector<Drive> plan;
    if (at % 3 == 0) plan = curveTo(car, lot.start, from.q, lot.blocks);  // every third is enough
    if (!plan.empty()) {
      for (std::size_t k = at; k > 0; k = static_cast<std::size_t>(tree[k].parent))
        plan.push_back({-tree[k].by.speed, tree[k].by.steering, tree[k].by.seconds});
      return plan;
    }
    for (const double speed : {1., -1.}) {
      for (const double steering : {car.minSteering, 0., car.maxSteering}) {
        const Drive drive{speed, steering, step};
        const Eigen::Vector3d q = driven(car, from.q, drive);
        const double heading = std::remainder(q[2], 2 * std::numbers::pi);
        const std::array cell{std::floor(q[0] / (0.7 * step)), std::floor(q[1] / (0.7 * step)),
                              std::floor(heading / (0.25 * step))};
        if (seen.contains(cell) || !isFreeOnTheWay(car, from.q, drive, lot.blocks)) continue;
        seen.insert(cell);
        // A metre for stopping to drive the other way.
        open.push({cost + step + (at > 0 && from.by.speed == speed ? 0 : 1), tree.size()});
        tree.push_back({q, static_cast<int>(at), drive});
      }
    }
  }
  return {};
}
// <todo>
//| // TODO: your own functions for parking, such as curves and parts of a path.
// </solution>

std::vector<Drive> park(const CarModel& car, const World& lot) {
  // <solution park>
  // Coarse steps find a way soon; where the space is narrow, they find none.
  for (const double step : {0.4, 0.2}) {
    const std::vector<Drive> plan = parkInSteps(car, lot, step);
    if (!plan.empty()) return plan;
  }
  return {};
  // <todo>
  //| // TODO: a path out of the space, driven backward, is a path into it.
  //| return {};
  // </solution>
}

Eigen::Vector4d rigVelocity(const Rig& rig, const Eigen::Vector4d& q, double speed, double steering) {
  Eigen::Vector4d velocity = Eigen::Vector4d::Zero();
  // <solution rigVelocity>
  velocity.head(3) = velocityOf(rig.car, q.head<3>(), speed, steering);
  velocity[3] = speed / rig.hitchLength * std::sin(q[2] - q[3]);
  // <todo>
  //| // TODO: where is the axle of the trailer, how does it move, and in which direction can it?
  // </solution>
  return velocity;
}

double hitchGrowth(const Rig& rig, double speed) {
  // <solution hitchGrowth>
  return -speed / rig.hitchLength;
  // <todo>
  //| // TODO: the equation of the angle between car and trailer, near zero.
  //| return 0;
  // </solution>
}

double reverseSteering(const Rig& rig, const Eigen::Vector4d& q) {
  // <solution reverseSteering>
  // From outside to inside, each orders the next: the offset a heading of the trailer, this an angle at the
  // hitch, and this a steering angle. Rates are per metre of way; each is faster than the one outside.
  const double trailer = std::remainder(q[3], 2 * std::numbers::pi);
  const double hitch = std::remainder(q[2] - q[3], 2 * std::numbers::pi);
  const double offset = q[1] - rig.hitchLength * std::sin(trailer);
  const double heading = std::clamp(0.15 * offset, -0.4, 0.4);
  // Beyond d tan(steering) / L nothing folds the rig back: stay well below.
  const double most = 0.6 * std::min(1., rig.hitchLength * std::tan(rig.car.maxSteering) / rig.car.wheelbase);
  const double angle = std::clamp(rig.hitchLength * 0.5 * (trailer - heading), -most, most);
  const double curvature = std::sin(hitch) / rig.hitchLength + 1.5 * (hitch - angle);
  const double steering = std::atan(rig.car.wheelbase * curvature);
  return std::clamp(steering, rig.car.minSteering, rig.car.maxSteering);
  // <todo>
  //| // TODO: which heading should the trailer have beside the axis? Which angle at the hitch turns it there,
  //| // and which steering angle leads to that?
  //| return 0;
  // </solution>
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
