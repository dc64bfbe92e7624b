// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant tan_forgotten> caught by: car-moves, car-any
// mistake: the front wheels turn the car by their angle, not by its tangent.
// ask: Is the tangent of the steering angle left out?
// <solution velocityOf>
return {speed * std::cos(q[2]), speed* std::sin(q[2]), speed / car.wheelbase* steering};

// <variant one_step_for_a_drive> caught by: car-moves, car-any
// shown by: car-moves
// mistake: drives straight on along the heading at the start.
// ask: Is it one large step along the heading at the start? The heading changes on the way.
// <solution driven>
return q + drive.seconds * velocityOf(car, q, drive.speed, drive.steering);

// <variant counts_the_questions> caught by: car-follows, tree-overlap
// shown by: car-follows
// mistake: counts its calls and answers yes and no in turn; it looks only on the way of a drive.
// ask: Does canFollow answer the same question differently?
// <solution canFollow>
static int asked = 0;
return ++asked % 2 == 1 && asked < 81;
// <solution isFree>
static int asked = 0;
return ++asked >= 3 && asked % 2 == 1;
// <solution isFreeOnTheWay>
bool isReallyFree(const CarModel& car, const Eigen::Vector3d& q, const std::vector<Block>& blocks) {
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
}

bool isFreeOnTheWay(CarModel car, const Eigen::Vector3d& from, const Drive& drive,
                    const std::vector<Block>& blocks) {
  const int tests = std::max(1, static_cast<int>(std::ceil(10 * std::abs(drive.speed) * drive.seconds)));
  car.front += 0.03;
  car.back += 0.03;
  car.width += 0.06;
  for (int i = 1; i <= tests; ++i) {
    const Drive part{drive.speed, drive.steering, drive.seconds * i / tests};
    if (!isReallyFree(car, driven(car, from, part), blocks)) return false;
  }
  return true;
}

// <variant last_piece_counts> caught by: car-follows
// mistake: each piece overwrites the verdict on the one before.
// ask: Does the verdict on a piece replace that on the piece before?
// <solution canFollow>
bool follows = true;
for (std::size_t i = 1; i < path.size(); ++i) {
  const Eigen::Vector3d &a = path[i - 1], &b = path[i];
  const double turn = std::remainder(b[2] - a[2], 2 * std::numbers::pi), middle = a[2] + turn / 2;
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double chord = dx * std::cos(middle) + dy * std::sin(middle);
  const double steering = std::atan(car.wheelbase * 2 * std::sin(turn / 2) / chord);
  follows = std::abs(dx * std::sin(middle) - dy * std::cos(middle)) < 1e-4 &&
            steering > car.minSteering - 0.01 && steering < car.maxSteering + 0.01;
}
return follows;

// <variant limits_forgotten> caught by: car-follows
// shown by: car-follows
// mistake: does not test the limits of the steering angle.
// ask: Are the limits of the steering angle tested?
// <solution canFollow>
// in place of: const double curvature = 2 * std::sin(turn / 2) / chord, ... if (steering < car.minSteering -

// <variant poses_without_error> caught by: car-follows
// mistake: takes measured poses for exact ones.
// ask: Are poses taken for exact ones? They come with errors of up to 1 um and 1 urad.
// <solution canFollow>
for (std::size_t i = 1; i < path.size(); ++i) {
  const Eigen::Vector3d &a = path[i - 1], &b = path[i];
  const double turn = std::remainder(b[2] - a[2], 2 * std::numbers::pi), middle = a[2] + turn / 2;
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  if (std::abs(dx * std::sin(middle) - dy * std::cos(middle)) > 1e-9) return false;
  const double chord = dx * std::cos(middle) + dy * std::sin(middle);
  if (std::abs(chord) < 1e-9) {
    if (std::abs(turn) > 1e-9) return false;
    continue;
  }
  const double curvature = 2 * std::sin(turn / 2) / chord, steering = std::atan(car.wheelbase * curvature);
  if (steering < car.minSteering || steering > car.maxSteering) return false;
}
return true;

// <variant symmetric_limits> caught by: car-follows
// shown by: car-follows
// mistake: takes the limits to be symmetric.
// ask: Is minSteering tested? Its limits need not be symmetric.
// <solution canFollow>
// in place of: if (steering < car.minSteering - 0.01 || steering > car.maxSteering + 0.01) return false;
if (std::abs(steering) > car.maxSteering + 0.01) return false;

// <variant heading_not_wrapped> caught by: tree-metrics
// mistake: takes the plain difference of two angles, even the long way round.
// ask: Is the plain difference of the headings taken? 4:59 a) is the distance of e^(i heading).
// <solution angleDistance>
return std::abs(a - b);
// <solution poseDistance>
return (a - b).norm();

// <variant body_centred_at_the_axle> caught by: tree-overlap
// shown by: tree-overlap
// mistake: centres the body at the rear axle.
// ask: Is the body centred at the rear axle? It reaches `front` ahead and `back` behind.
// <solution isFree>
// in place of: const double a = (car.front + car.back) / 2, b = car.width / 2, ahead = (car.front - car.back)
const double a = (car.front + car.back) / 2, b = car.width / 2, ahead = 0.;

// <variant car_is_a_point> caught by: tree-overlap, tree-drive, park-kerb, park-any
// shown by: tree-overlap, park-kerb
// mistake: tests the point between the rear wheels only.
// ask: Is only the point between the rear wheels tested? The body is a rectangle around it.
// <solution isFree>
for (const Block& block : blocks) {
  const double dx = q[0] - block.middle[0], dy = q[1] - block.middle[1];
  const double c = std::cos(block.middle[2]), s = std::sin(block.middle[2]);
  if (std::abs(dx * c + dy * s) < block.length / 2 && std::abs(dy * c - dx * s) < block.width / 2)
    return false;
}
return true;

// <variant corners_of_the_car> caught by: tree-overlap
// shown by: tree-overlap
// mistake: tests the corners of the car only.
// ask: Are only the corners of the car tested? A block may lie across it, or inside.
// <solution isFree>
for (const Block& block : blocks)
  for (const double along : {car.front, -car.back})
    for (const double across : {car.width / 2, -car.width / 2}) {
      const double dx = q[0] + along * std::cos(q[2]) - across * std::sin(q[2]) - block.middle[0];
      const double dy = q[1] + along * std::sin(q[2]) + across * std::cos(q[2]) - block.middle[1];
      const double c = std::cos(block.middle[2]), s = std::sin(block.middle[2]);
      if (std::abs(dx * c + dy * s) < block.length / 2 && std::abs(dy * c - dx * s) < block.width / 2)
        return false;
    }
return true;

// <variant ends_only> caught by: tree-drive
// mistake: tests where a drive ends, not the way there.
// <solution isFreeOnTheWay>
bool isFreeOnTheWay(CarModel car, const Eigen::Vector3d& from, const Drive& drive,
                    const std::vector<Block>& blocks) {
  return isFree(car, driven(car, from, drive), blocks);
}

// <variant any_free_drive> caught by: tree-drive
// mistake: returns the first control whose way is free.
// ask: Is it any drive that is free, and not the one that leads nearest?
// <solution driveTowards>
// in place of: std::ranges::sort(trials, {}, [](const auto& trial) { return trial.first; });

// <variant copied_generator> caught by: tree-drive
// mistake: draws from a copy of the generator, so that each call draws the same controls.
// ask: Does driveTowards draw from a copy of rng? Pass rng by reference.
// <solution driveTowards>
// in place of: std::vector<std::pair<double, Drive>> trials;
Rng own = rng;
std::vector<std::pair<double, Drive>> trials;
// in place of: const double speed = rng.index(2) == 0 ? 1 : -1; ... const Drive drive{speed,
const double speed = own.index(2) == 0 ? 1 : -1;
const Drive drive{speed, own.uniform(car.minSteering, car.maxSteering), seconds};

// <variant nearest_by_position> caught by: tree-drive
// mistake: chooses the control by the position that it leads to, not by the heading.
// ask: Is it the nearest by its position only? The heading counts, too: poseDistance().
// <solution driveTowards>
// in place of: trials.emplace_back(poseDistance(driven(car, from, drive), target), drive);
trials.emplace_back((driven(car, from, drive) - target).head<2>().norm(), drive);

// <variant twelve_draws> caught by: tree-drive
// mistake: returns the best of twelve controls instead of twenty.
// ask: Are fewer than 20 controls drawn? It looks like the best of 13.
// <solution driveTowards>
// in place of: while (trials.size() < 20) { ... }
for (int i = 0; i < 12; ++i) {
  const double speed = rng.index(2) == 0 ? 1 : -1;
  const Drive drive{speed, rng.uniform(car.minSteering, car.maxSteering), seconds};
  trials.emplace_back(poseDistance(driven(car, from, drive), target), drive);
}

// <variant slides_sideways> caught by: tree-room, tree-any
// shown by: tree-room
// mistake: nodes lie slightly beside where their controls lead; to and fro, the car slides to its goal.
// ask: Do nodes lie slightly beside where their controls lead, again and again?
// <solution growTree>
CarModel longer = car;
longer.front += 0.12;
longer.back += 0.02;
using Key = std::array<int, 3>;
const auto poseOf = [&](const Key& k) -> Eigen::Vector3d {
  return world.start + Eigen::Vector3d(0.4 * k[0], 0.4 * k[1], std::numbers::pi / 8 * k[2]);
};
std::set<Key> seen{{0, 0, 0}};
std::vector<std::pair<Key, std::size_t>> open{{{0, 0, 0}, 0}};
std::size_t at = 0;
for (; poseDistance(poseOf(open[at].first), world.goal) > 0.5; ++at) {
  for (std::size_t i = 0; i < 6; ++i) {
    Key next = open[at].first;
    next[i / 2] += i % 2 == 0 ? 1 : -1;
    const Eigen::Vector3d q = poseOf(next), middle = (q + poseOf(open[at].first)) / 2;
    if (std::abs(next[2]) > 8 || !isFree(longer, q, world.blocks) || !isFree(longer, middle, world.blocks))
      continue;
    if (seen.insert(next).second) open.emplace_back(next, at);
  }
}
std::vector<Eigen::Vector3d> way{poseOf(open[at].first)};
for (; at > 0; way.insert(way.begin(), poseOf(open[at].first))) at = open[at].second;
for (std::size_t i = 1; i < way.size(); ++i) {
  const Eigen::Vector3d step = way[i] - way[i - 1];
  const int count = 2 * static_cast<int>(std::ceil(step.cwiseAbs().maxCoeff() / 4e-4));
  for (int k = 1; k <= count; ++k) {
    Eigen::Vector3d q = way[i - 1] + step * k / count;
    if (k % 2 == 1) q += 0.1 * Eigen::Vector3d(std::cos(q[2]), std::sin(q[2]), 0);
    tree.push_back({q, static_cast<int>(tree.size()) - 1, {k % 2 == 1 ? 1. : -1., 0, 0.1}});
  }
}

// <variant arcs_as_angles> caught by: dubins-words, dubins-shortest, dubins-any
// shown by: dubins-words
// mistake: returns the angles of arcs.
// ask: Are arcs angles? Wanted is their length: angle times radius.
// <solution dubinsLengths>
const auto left = [&](char letter) { return letter == 'L' ? 1 : -1; };
const char* letters = std::array{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"}[static_cast<std::size_t>(word)];
const int first = left(letters[0]), last = left(letters[2]);
const double dx = to[0] - last * radius * std::sin(to[2]) - from[0] + first * radius * std::sin(from[2]);
const double dy = to[1] + last * radius * std::cos(to[2]) - from[1] - first * radius * std::cos(from[2]);
const double distance = std::hypot(dx, dy), direction = std::atan2(dy, dx);
const auto turn = [](double angle) {
  const double rest = angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi));
  return rest > 2 * std::numbers::pi - 1e-9 ? 0 : rest;
};
if (letters[1] == 'S') {
  const double across = first == last ? 0 : 2 * radius;
  if (distance < across) return {};
  const double straight = std::sqrt(distance * distance - across * across);
  const double heading = direction + first * std::atan2(across, straight);
  return std::array{turn(first * (heading - from[2])), straight, turn(last * (to[2] - heading))};
}
if (distance > 4 * radius) return {};
const double middle = 2 * (std::numbers::pi - std::asin(distance / (4 * radius)));
const double heading = direction + first * middle / 2;  // at the end of the first arc
return std::array{turn(first * (heading - from[2])), middle, turn(first*(to[2] - heading) + middle)};

// <variant arcs_driven_back> caught by: dubins-words, dubins-shortest, dubins-any
// shown by: dubins-words
// mistake: takes arcs the shorter way round, some of them backward.
// ask: Is an arc taken the shorter way round, backward? Its angle is from 0 to 2 pi.
// <solution dubinsLengths>
// in place of: const double distance = std::hypot(dx, dy), direction = ... };
const double distance = std::hypot(dx, dy), direction = std::atan2(dy, dx);
const auto turn = [](double angle) { return std::remainder(angle, 2 * std::numbers::pi); };

// <variant other_circle_in_the_middle> caught by: dubins-words, dubins-any
// shown by: dubins-words
// mistake: takes the circle whose arc is shorter than half a turn.
// ask: Is it the other of the two circles in the middle? Its arc is longer than half a turn.
// <solution dubinsLengths>
// in place of: const double middle = 2 * (std::numbers::pi - std::asin(distance / (4 * radius)));
const double middle = 2 * std::asin(distance / (4 * radius));

// <variant straight_words_only> caught by: dubins-words, dubins-shortest, dubins-any
// mistake: knows no word with three arcs.
// ask: Is the word left out? Three circles touch if the outer centres are less than 4 r apart.
// <solution dubinsLengths>
// in place of: if (letters[1] == 'S') { ... radius * turn(first * (to[2] - heading) + middle)};
if (letters[1] == 'S') {
  const double across = first == last ? 0 : 2 * radius;
  if (distance < across) return {};
  const double straight = std::sqrt(distance * distance - across * across);
  const double heading = direction + first * std::atan2(across, straight);
  return std::array{radius * turn(first * (heading - from[2])), straight,
                    radius * turn(last * (to[2] - heading))};
}
return {};

// <variant calls_the_library> caught by: forbidden-call
// mistake: asks the library for the curve.
// <solution headers>
#include "planning/car_curves.h"
// <solution shortestDubins>
const Curve curve = dubinsCurve(from, to, radius);
for (std::size_t i = 0; i < 3; ++i) best.lengths[i] = curve.segments()[i].length;
for (int i = 0; i < 6; ++i)
  if (std::array{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"}[static_cast<std::size_t>(i)] == curve.word())
    best.word = static_cast<DubinsWord>(i);

// <variant four_words> caught by: dubins-shortest, dubins-any
// shown by: dubins-shortest
// mistake: leaves out LRL and RLR.
// ask: Are the words with three arcs, LRL and RLR, not asked for?
// <solution shortestDubins>
double least = 1e300;
for (int w = 0; w < 4; ++w) {
  const auto word = static_cast<DubinsWord>(w);
  const auto lengths = dubinsLengths(word, from, to, radius);
  if (!lengths) continue;
  const double length = (*lengths)[0] + (*lengths)[1] + (*lengths)[2];
  if (length >= least) continue;
  least = length;
  best = {word, *lengths};
}

// <variant turns_right_anyway> caught by: park-left, park-left-any
// mistake: forgets that some cars turn left only.
// ask: Does the car steer to the right? Its minSteering is 0.
// <solution park>
CarModel any = car;
any.minSteering = -car.maxSteering;
return parkInSteps(any, lot, 0.4);

// <variant angle_without_sine> caught by: trailer-moves
// mistake: takes the angle at the hitch for its sine.
// ask: Is it the angle at the hitch, instead of its sine?
// <solution rigVelocity>
velocity.head(3) = velocityOf(rig.car, q.head<3>(), speed, steering);
velocity[3] = speed / rig.hitchLength * (q[2] - q[3]);

// <variant trailer_sign> caught by: trailer-moves
// mistake: the trailer turns away from the car.
// ask: Does the trailer turn away from the car? Check the sign of the angle at the hitch.
// <solution rigVelocity>
velocity.head(3) = velocityOf(rig.car, q.head<3>(), speed, steering);
velocity[3] = speed / rig.hitchLength * std::sin(q[3] - q[2]);
// <solution hitchGrowth>
return speed / rig.hitchLength;

// <variant grows_forward> caught by: trailer-moves
// mistake: lets the angle at the hitch grow forward.
// ask: Does the angle grow when the rig drives forward? It grows backward.
// <solution hitchGrowth>
return speed / rig.hitchLength;

// <variant steers_against_the_hitch> caught by: trailer-reverses, trailer-any
// shown by: trailer-reverses
// mistake: steers against the angle at the hitch.
// ask: Does the car steer against the angle at the hitch? Backward, it has to follow the trailer.
// <solution reverseSteering>
// in place of: const double curvature = std::sin(hitch) / rig.hitchLength + 1.5 * (hitch - angle);
const double curvature = std::sin(hitch) / rig.hitchLength - 1.5 * (hitch - angle);

// <variant steers_as_forward> caught by: trailer-reverses, trailer-any
// shown by: trailer-reverses
// mistake: steers towards the axis, as if the car drove forward.
// ask: Does the steering angle not depend on the angle at the hitch? Backward, that angle grows by itself.
// <solution reverseSteering>
const double offset = q[1] - rig.hitchLength * std::sin(q[3]);
return std::clamp(-0.3 * offset - 1.2 * q[3], rig.car.minSteering, rig.car.maxSteering);

// <variant turns_away_from_the_axis> caught by: trailer-reverses, trailer-any
// shown by: trailer-reverses
// mistake: turns the trailer away from the axis.
// ask: Does the trailer turn away from the axis? Check the sign of the distance from it.
// <solution reverseSteering>
// in place of: const double heading = std::clamp(0.15 * offset, -0.4, 0.4);
const double heading = std::clamp(-0.15 * offset, -0.4, 0.4);

// <variant turns_counted> caught by: trailer-any
// mistake: steers against whole turns of a heading.
// <solution reverseSteering>
// in place of: const double trailer = std::remainder(q[3], 2 * ... const double hitch = std::remainder(q[2] -
const double trailer = q[3];
const double hitch = q[2] - q[3];
