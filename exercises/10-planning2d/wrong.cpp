// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant leaves_anywhere> caught by: bug-known-maps
// shown by: bug-known-maps
// mistake: goes back to the m-line wherever it meets it, as on the first slides of Bug 2: it runs in circles.
// <solution bugTwo>
// in place of: const auto onLine = std::find(mLine.begin() + static_cast<std::ptrdiff_t>(hit), mLine.end(),
const auto onLine = std::find(mLine.begin(), mLine.end(), cell);

// <variant round_too_early> caught by: bug-known-maps
// mistake: takes passing the cell where it met the obstacle for a full circuit.
// <solution bugTwo>
// in place of: const int first = heading;
// in place of: if (at == hit && cell == mLine[hit] && ((heading - first) & 3) == 0) return trail;
if (cell == mLine[hit]) return trail;

// <variant calls_the_library> caught by: forbidden-call
// mistake: lets the library number the cells.
// <solution headers>
#include "planning/grid_map.h"
// <solution waveNumbers>
GridMap grid(map.width, map.height);
for (std::size_t place = 0; place < numbers.size(); ++place)
  grid.setBlocked({map.cellAt(place).x, map.cellAt(place).y}, numbers[place] != 0);
numbers = wavefront(grid, {goal.x, goal.y}, Connectivity::kEight);

// <variant sides_only> caught by: grid-wave
// mistake: only the four neighbours at the sides get a number.
// ask: Are the diagonal neighbours left out?
// <solution waveNumbers>
// in place of: if (!map.isFree({x, y}) || numbers[map.placeOf({x, y})] != 0) continue;
if ((x != cell.x && y != cell.y) || !map.isFree({x, y}) || numbers[map.placeOf({x, y})] != 0) continue;

// <variant arc_twice> caught by: grid-network
// mistake: one arc of each cell replaces its last one: the number of arcs is right, but one occurs twice.
// <solution cellNetwork>
for (std::size_t here = 0; here < network.size(); ++here) {
  const MapCell at = map.cellAt(here);
  for (int y = at.y - 1; map.isFree(at) && y <= at.y + 1; ++y) {
    for (int x = at.x - 1; x <= at.x + 1; ++x) {
      const bool hasRoom = map.isFree({x, at.y}) && map.isFree({at.x, y});
      if (MapCell{x, y} == at || !map.isFree({x, y}) || !hasRoom) continue;
      network[here].push_back({map.placeOf({x, y}), x != at.x && y != at.y ? std::numbers::sqrt2 : 1});
    }
  }
  if (network[here].size() > 1) network[here].back() = network[here].front();
}

// <variant corners_cut> caught by: grid-network, grid-any-map
// shown by: grid-network
// mistake: diagonal arcs cut corners, as on the slides of the wavefront.
// <solution cellNetwork>
for (std::size_t place = 0; place < network.size(); ++place) {
  const MapCell at = map.cellAt(place);
  for (int y = at.y - 1; map.isFree(at) && y <= at.y + 1; ++y)
    for (int x = at.x - 1; x <= at.x + 1; ++x)
      if (map.isFree({x, y}) && MapCell{x, y} != at)
        network[place].push_back({map.placeOf({x, y}), x != at.x && y != at.y ? std::numbers::sqrt2 : 1});
}

// <variant diagonals_for_one> caught by: grid-network, grid-any-map
// mistake: every step counts one, a diagonal one too.
// <solution cellNetwork>
for (std::size_t place = 0; place < network.size(); ++place) {
  const MapCell at = map.cellAt(place);
  for (int y = at.y - 1; map.isFree(at) && y <= at.y + 1; ++y)
    for (int x = at.x - 1; x <= at.x + 1; ++x)
      if (map.isFree({x, y}) && map.isFree({x, at.y}) && map.isFree({at.x, y}) && MapCell{x, y} != at)
        network[place].push_back({map.placeOf({x, y}), 1});
}

// <variant lowest_neighbour> caught by: grid-way
// shown by: grid-way
// mistake: goes to the lowest neighbour, as slide 4:25 says; if arcs differ in length, that is a detour.
// <solution wayDown>
// in place of: const auto total = [&](const Arc& arc) { return arc.length + ... [&](const Arc& a, const Arc&
const auto best = std::min_element(
    arcs.begin(), arcs.end(), [&](const Arc& a, const Arc& b) { return distances[a.to] < distances[b.to]; });

// <variant pushes_without_end> caught by: field-potential
// mistake: blocks beyond their reach push, too: the square hides the sign.
// ask: Do blocks beyond their reach push, too? The square hides the sign.
// <solution fieldPotential>
// in place of: const double distance = (p - nearestPoint(block, p)).norm(); ... const double excess = 1 /
const double excess = 1 / (p - nearestPoint(block, p)).norm() - 1 / gains.reach;
// <solution fieldGradient>
// in place of: const double distance = away.norm(); ... const double excess = 1 / distance - 1 / gains.reach;
const double distance = away.norm(), excess = 1 / distance - 1 / gains.reach;

// <variant blocks_unfelt> caught by: field-potential, field-gradient
// mistake: leaves out the repulsion.
// ask: Is the repulsion left out?
// <solution fieldPotential>
U = gains.attraction * (p - goal).squaredNorm() / 2;
// <solution fieldGradient>
gradient = gains.attraction * (p - goal);

// <variant repulsion_subtracted> caught by: field-potential
// mistake: the potential is lower near blocks.
// ask: Is the repulsion subtracted?
// <solution fieldPotential>
// in place of: U += gains.repulsion * excess * excess / 2;
U -= gains.repulsion * excess * excess / 2;

// <variant repulsion_not_halved> caught by: field-potential
// mistake: forgets one half.
// ask: Is the repulsion not halved?
// <solution fieldPotential>
// in place of: U += gains.repulsion * excess * excess / 2;
U += gains.repulsion * excess * excess;

// <variant attraction_not_halved> caught by: field-potential
// mistake: forgets the other half.
// ask: Is the attraction not halved?
// <solution fieldPotential>
// in place of: U = gains.attraction * (p - goal).squaredNorm() / 2;
U = gains.attraction * (p - goal).squaredNorm();

// <variant push_doubled> caught by: field-gradient
// mistake: the gradient of a repulsion that is not halved.
// ask: Is the repulsion twice too large?
// <solution fieldGradient>
// in place of: gradient -= gains.repulsion * excess / (distance * distance * distance) * away;
gradient -= 2 * gains.repulsion * excess / (distance * distance * distance) * away;

// <variant blocks_attract> caught by: field-gradient, field-slide, field-any-yard
// shown by: field-slide
// mistake: the repulsion has the wrong sign.
// ask: Do blocks attract? Their repulsion has the wrong sign.
// <solution fieldGradient>
// in place of: gradient -= gains.repulsion * excess / (distance * distance * distance) * away;
gradient += gains.repulsion * excess / (distance * distance * distance) * away;
// <solution slideDown>
while ((trail.points.back() - goal).norm() > stepSize && trail.points.size() < 1000) {
  const Eigen::Vector2d p = trail.points.back(), gradient = fieldGradient(yard, goal, gains, p);
  if (gradient.norm() < 0.01 * gains.attraction) return trail;
  trail.points.push_back(p - std::min(stepSize / gradient.norm(), 0.1) * gradient);
}
trail.ending = Ending::kAtGoal;

// <variant push_limited> caught by: field-gradient
// mistake: the distance to a block counts as 0.1 m at least, lest the push explode.
// <solution fieldGradient>
// in place of: const double distance = away.norm(); ... gradient -= gains.repulsion * excess / (distance *
const double d = std::max(.1, away.norm());
if (d < gains.reach) gradient -= gains.repulsion * (1 / d - 1 / gains.reach) / (d * d) * away / d;

// <variant stuck_is_success> caught by: field-slide, field-any-yard
// mistake: takes every point where the gradient vanishes for the goal.
// <solution slideDown>
while (fieldGradient(yard, goal, gains, trail.points.back()).norm() >= 0.01 * gains.attraction) {
  const Eigen::Vector2d p = trail.points.back(), gradient = fieldGradient(yard, goal, gains, p);
  const double slope = gradient.norm(), U = fieldPotential(yard, goal, gains, p);
  double step = std::min(stepSize, slope / gains.attraction);
  const auto next = [&] { return Eigen::Vector2d(p - step / slope * gradient); };
  while (!(fieldPotential(yard, goal, gains, next()) < U - 0.1 * slope * step)) step /= 2;
  trail.points.push_back(next());
}
trail.ending = Ending::kAtGoal;

// <variant end_left_out> caught by: prm-straight
// mistake: tests from the beginning on, but not the end.
// <solution straightIsFree>
const double length = (b - a).norm();
for (double s = 0; s < length; s += resolution)
  if (!isFree(yard, a + s / length * (b - a))) return false;
return true;

// <variant only_ends_tested> caught by: prm-straight, prm-join
// shown by: prm-straight, prm-join
// mistake: tests the ends of an edge, not what lies between.
// <solution straightIsFree>
return isFree(yard, a) && isFree(yard, b);

// <variant normal_not_uniform> caught by: prm-samplers
// mistake: normal numbers around the middle of the yard, limited to it.
// <solution uniformSample>
Eigen::Vector2d q = yard.size / 2 + yard.size.cwiseProduct(rng.normalVector(2)) / std::sqrt(12.);
q = q.cwiseMax(0).cwiseMin(yard.size);
if (isFree(yard, q)) return q;
return std::nullopt;

// <variant own_generator> caught by: prm-samplers
// mistake: a generator of its own, which goes on from call to call.
// <solution uniformSample>
static Rng mine(1);
const Eigen::Vector2d q(mine.uniform(0, yard.size.x()), mine.uniform(0, yard.size.y()));
if (isFree(yard, q)) return q;
return std::nullopt;

// <variant until_free> caught by: prm-samplers
// mistake: tries until a point is free: that is more than one attempt.
// <solution uniformSample>
for (;;) {
  const Eigen::Vector2d q(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
  if (isFree(yard, q)) return q;
}

// <variant near_is_enough> caught by: prm-samplers, prm-passage
// mistake: uniform positions near a block, and uniform ones with blocks above and below; no normal numbers.
// <solution gaussianSample>
const auto q = uniformSample(yard, rng);
if (!q) return std::nullopt;
for (const Block& block : yard.blocks)
  if ((nearestPoint(block, *q) - *q).norm() < 1.254 * sigma) return q;
return std::nullopt;
// <solution bridgeSample>
const auto q = uniformSample(yard, rng);
const Eigen::Vector2d up(0, sigma / 2);
if (q && !isFree(yard, *q + up) && !isFree(yard, *q - up)) return q;
return std::nullopt;

// <variant only_the_first_point> caught by: prm-samplers, prm-passage
// mistake: only the first point can become a node, not the second.
// <solution gaussianSample>
const Eigen::Vector2d q1(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
const Eigen::Vector2d q2 = q1 + sigma * rng.normalVector(2);
if (isFree(yard, q1) && !isFree(yard, q2)) return q1;
return std::nullopt;

// <variant same_number_twice> caught by: prm-samplers
// mistake: adds the same normal number to both coordinates.
// <solution gaussianSample>
const Eigen::Vector2d q1(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
const double z = rng.normal();
const Eigen::Vector2d q2 = q1 + sigma * Eigen::Vector2d(z, z);
if (isFree(yard, q1) && !isFree(yard, q2)) return q1;
if (!isFree(yard, q1) && isFree(yard, q2)) return q2;
return std::nullopt;

// <variant bridge_into_the_wall> caught by: prm-samplers, prm-passage
// mistake: both ends are blocked, so the middle is taken for a passage; it is hardly ever one.
// <solution bridgeSample>
const double x = rng.uniform(0, yard.size.x()), y = rng.uniform(0, yard.size.y());
const Eigen::Vector2d q1(x, y), q2 = q1 + sigma * rng.normalVector(2);
if (isFree(yard, q1) || isFree(yard, q2)) return std::nullopt;
return Eigen::Vector2d((q1 + q2) / 2);

// <variant bridge_kept_inside> caught by: prm-samplers
// mistake: pulls the other end back into the yard: there is no bridge to its outside.
// <solution bridgeSample>
const Eigen::Vector2d q1(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
const Eigen::Vector2d q2 = (q1 + sigma * rng.normalVector(2)).cwiseMax(0).cwiseMin(yard.size);
const Eigen::Vector2d q3 = (q1 + q2) / 2;
if (!isFree(yard, q1) && !isFree(yard, q2) && isFree(yard, q3)) return q3;
return std::nullopt;

// <variant ways_in_not_tested> caught by: prm-slot, prm-query
// mistake: joins start and goal to nodes behind blocks, too.
// <solution queryRoadmap>
Network all = roadmap;
all.resize(nodes.size() + 2);
std::vector<Eigen::Vector2d> points = nodes;
for (const Eigen::Vector2d& q : {start, goal}) {
  const std::size_t me = points.size();
  for (std::size_t j : nearestNodes(nodes, q, k)) {
    all[me].push_back({j, (q - nodes[j]).norm()});
    all[j].push_back({me, (q - nodes[j]).norm()});
  }
  points.push_back(q);
}
for (std::size_t i : wayDown(all, dijkstra(all, points.size() - 1), points.size() - 2))
  way.push_back(points[i]);

// <variant estimates_too_much> caught by: astar-estimate
// mistake: the sum of both differences, as if there were no diagonals; A* may then find a detour.
// ask: Are diagonal steps left out?
// <solution emptyMapDistance>
return std::abs(to.x - from.x) + std::abs(to.y - from.y);

// <variant straight_line> caught by: astar-estimate
// mistake: the distance as the crow flies.
// ask: Is it the straight line? Steps lead to the eight neighbours.
// <solution emptyMapDistance>
return std::hypot(to.x - from.x, to.y - from.y);

// <variant larger_difference> caught by: astar-estimate
// mistake: a diagonal step counts one.
// ask: Is a diagonal step as long as the others? It is sqrt(2) m long.
// <solution emptyMapDistance>
return std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));

// <variant estimate_forgotten> caught by: astar-known-maps, astar-anything
// mistake: uses the estimate of the start for every node: that is Dijkstra, which looks everywhere.
// <solution aStar>
// in place of: queue.emplace(length + estimates[arc.to], arc.to);
queue.emplace(length + estimates[start], arc.to);
