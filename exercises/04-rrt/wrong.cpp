// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant density_of_the_angle> caught by: reach-radius, reach-any-arm
// mistake: counts one of the two angles that lead to the same radius.
// ask: Is only one angle of the second joint counted? Its negative leads to the same r.
// <solution radiusDensity>
const double cosine = (r * r - l1 * l1 - l2 * l2) / (2 * l1 * l2);
if (std::abs(cosine) >= 1) return 0;
return r / (2 * std::numbers::pi * l1 * l2 * std::sqrt(1 - cosine * cosine));

// <variant sum_of_differences> caught by: step-nearest
// shown by: step-nearest
// mistake: the distance is the sum of the differences of the coordinates.
// ask: Is the distance the sum of the differences? Wanted is the length |qa - qb|.
// <solution nearestNode>
// in place of: const double distance2 = (nodes[i] - target).squaredNorm(); ... least = distance2;
const double distance = (nodes[i] - target).cwiseAbs().sum();
if (distance >= least) continue;
least = distance;

// <variant step_not_clamped> caught by: step-nearest
// mistake: line 5 of slide 4:39 as printed: it overshoots near targets, and divides by zero at the target.
// ask: Does the step go beyond the target? It stops there.
// <solution stepTowards>
return from + stepSize / (target - from).norm() * (target - from);

// <variant target_up_to_rounding> caught by: step-nearest
// mistake: a near target is reached only up to rounding, so that it goes unnoticed when the trees meet.
// ask: Is it the target up to rounding? Wanted is `target` itself, to the last bit.
// <solution stepTowards>
const double distance = (target - from).norm();
return distance > 0 ? from + std::min(distance, stepSize) * ((target - from) / distance) : target;

// <variant one_number_for_all> caught by: step-target
// mistake: one random number for all coordinates: targets on the diagonal of the box.
// ask: Does one random number serve for all coordinates?
// <solution drawTarget>
if (rng.uniform() < settings.goalBias) return aim;
return settings.lower + rng.uniform() * (settings.upper - settings.lower);

// <variant randomness_from_elsewhere> caught by: step-target
// mistake: targets from rand(), which no seed of the grader reaches.
// ask: Is there other randomness, as from rand()? All randomness comes from rng.
// <solution drawTarget>
const auto number = [] { return std::rand() / (RAND_MAX + 1.); };
if (number() < settings.goalBias) return aim;
Eigen::VectorXd target = settings.lower;
for (Eigen::Index i = 0; i < target.size(); ++i)
  target[i] += number() * (settings.upper[i] - settings.lower[i]);
return target;

// <variant answer_ignored> caught by: step-plane, step-corners, backward-plane
// shown by: step-plane
// mistake: edgeFree is called, but its answer is not used.
// ask: Is the answer of edgeFree ignored?
// <solution rrtStep>
// in place of: if (!edgeFree(from, q)) return {};
edgeFree(from, q);

// <variant nodes_tested_not_edges> caught by: step-plane, step-corners, backward-worlds, connect-worlds
// mistake: lines 6 and 7 of the slides as printed: only the new node has to be free.
// ask: Is only the new node tested? What lies between two free nodes may be blocked.
// <solution rrtStep>
const int nearest = nearestNode(tree.nodes, target);
const Eigen::VectorXd q = stepTowards(tree.nodes[static_cast<std::size_t>(nearest)], target, stepSize);
if (!edgeFree(q, q)) return {};
return NewNode{q, nearest};

// <variant way_not_reversed> caught by: backward-way, backward-arm, backward-worlds, connect-joined
// mistake: parents are followed from the node to the root, and the path keeps that order.
// ask: Is the path in the reverse order?
// <solution wayFromRoot>
for (int i = node; i >= 0; i = tree.parents[static_cast<std::size_t>(i)])
  path.push_back(tree.nodes[static_cast<std::size_t>(i)]);

// <variant bias_of_a_half> caught by: backward-plane, backward-worlds
// shown by: backward-plane
// mistake: a hard-coded bias.
// ask: Is the goalBias of the settings ignored? There are as many nodes with 0.1 as with 0.4.
// <solution growBackward>
// in place of: Tree& tree = search.tree;
SearchSettings typedIn = settings;
typedIn.goalBias = 0.5;
Tree& tree = search.tree;
// in place of: rrtStep(tree, drawTarget(settings, start, rng), settings.stepSize, edgeFree);
rrtStep(tree, drawTarget(typedIn, start, rng), settings.stepSize, edgeFree);

// <variant counts_nodes> caught by: backward-plane, backward-worlds
// mistake: maxSamples limits the nodes instead of the targets.
// ask: Do only targets count that give a node? maxSamples limits all of them.
// <solution growBackward>
Tree& tree = search.tree;
while (static_cast<int>(tree.nodes.size()) < settings.maxSamples) {
  const auto made = rrtStep(tree, drawTarget(settings, start, rng), settings.stepSize, edgeFree);
  if (!made) continue;
  tree.nodes.push_back(made->q);
  tree.parents.push_back(made->parent);
  if ((made->q - start).norm() > settings.stepSize || !edgeFree(made->q, start)) continue;
  search.path = wayFromRoot(tree, static_cast<int>(tree.nodes.size()) - 1);
  search.path.push_back(start);
  std::reverse(search.path.begin(), search.path.end());
  break;
}

// <variant last_piece_not_tested> caught by: backward-plane, backward-worlds
// mistake: The edge from the last node to the start is not tested.
// ask: Was edgeFree never asked about it?
// <solution growBackward>
// in place of: const std::optional<NewNode> made = ... rrtStep(tree, drawTarget(settings, start, rng),
const auto made = rrtStep(tree, drawTarget(settings, start, rng), settings.stepSize, edgeFree);
// in place of: if ((made->q - start).norm() > settings.stepSize || !edgeFree(made->q, start)) continue;
if ((made->q - start).norm() > settings.stepSize) continue;

// <variant start_missing> caught by: backward-plane, backward-arm, backward-worlds
// shown by: backward-plane
// mistake: the path ends with the node beside the start.
// ask: Is the start missing?
// <solution growBackward>
// in place of: search.path.push_back(start);

// <variant way_by_heart> caught by: backward-arm, backward-worlds
// mistake: postures of a path that was found once; the edges are tested, but the answers ignored.
// ask: Is the answer of edgeFree ignored?
// <solution growBackward>
constexpr double kWay[][7] = {{1.02826, 0.01644, -1.70668, 0.94866, 2.06370, -0.64979, -1.63454},
                              {1.03890, -0.04396, -1.66967, 0.99432, 2.04121, -0.64385, -1.65567},
                              {1.04541, -0.08494, -1.64533, 1.02449, 2.02635, -0.63800, -1.66958},
                              {1.05907, -0.17225, -1.59370, 1.08855, 1.99480, -0.62497, -1.69910},
                              {1.06665, -0.25729, -1.54777, 1.14852, 1.96825, -0.60540, -1.72752},
                              {1.06803, -0.38567, -1.48607, 1.23479, 1.93555, -0.56371, -1.76985},
                              {1.06770, -0.39736, -1.48079, 1.24246, 1.93290, -0.55937, -1.77368},
                              {1.06009, -0.49972, -1.43773, 1.31059, 1.90654, -0.51777, -1.80670},
                              {1.05525, -0.54637, -1.41901, 1.34192, 1.89361, -0.49776, -1.82160},
                              {1.04429, -0.57877, -1.41100, 1.36530, 1.87957, -0.47807, -1.83113},
                              {1.02630, -0.58148, -1.42155, 1.37087, 1.86704, -0.46340, -1.83008}};
Tree& tree = search.tree;
const auto go = [&](const Eigen::VectorXd& place) {
  while (tree.nodes.back() != place) {
    const Eigen::VectorXd from = tree.nodes.back();
    tree.nodes.push_back(stepTowards(from, place, settings.stepSize));
    tree.parents.push_back(static_cast<int>(tree.parents.size()) - 1);
    edgeFree(from, tree.nodes.back());
  }
};
if (goal.size() == 7)
  for (const auto& place : kWay) go(Eigen::Map<const Eigen::VectorXd>(place, 7));
go(start);
search.path.assign(tree.nodes.rbegin(), tree.nodes.rend());

// <variant meeting_node_twice> caught by: connect-joined, connect-arm, connect-worlds
// shown by: connect-joined, connect-arm
// mistake: the node where the trees meet belongs to both, and so it is in the path twice.
// ask: Is the node where the trees meet there twice? It belongs to both.
// <solution joinedPath>
path = wayFromRoot(fromStart, a);
const Path rest = wayFromRoot(fromGoal, b);
path.insert(path.end(), rest.rbegin(), rest.rend());

// <variant second_path_not_turned> caught by: connect-joined, connect-plane, connect-worlds
// shown by: connect-joined
// mistake: the path of the second tree is appended as it is, from the goal to the middle.
// ask: Is the path of the second tree not reversed? It leads to the goal.
// <solution joinedPath>
// in place of: path.insert(path.end(), rest.rbegin(), rest.rend());
path.insert(path.end(), rest.begin(), rest.end());

// <variant biased_in_both_trees> caught by: connect-plane, connect-worlds
// shown by: connect-plane
// mistake: the random steps of both trees aim at the start with the goalBias.
// ask: Do targets depend on goalBias? In growBoth it has no effect.
// <solution growBoth>
// in place of: SearchSettings unbiased = settings; ... unbiased.goalBias = 0;
// in place of: if (!grow(one, drawTarget(unbiased, start, rng))) continue;
if (!grow(one, drawTarget(settings, start, rng))) continue;

// <variant both_at_random> caught by: connect-plane, connect-worlds
// shown by: connect-plane
// mistake: the second tree steps towards the random target, in place of the new node.
// ask: Does the second tree step towards the random target? Its target is the new node of the other.
// <solution growBoth>
// in place of: if (!grow(one, drawTarget(unbiased, start, rng))) continue; ... }
const Eigen::VectorXd target = drawTarget(unbiased, start, rng);
if (!grow(one, target) || !grow(other, target)) continue;
if ((one.nodes.back() - other.nodes.back()).norm() <= settings.stepSize &&
    edgeFree(other.nodes.back(), one.nodes.back())) {
  search.path = joinedPath(search.fromStart, static_cast<int>(search.fromStart.nodes.size()) - 1,
                           search.fromGoal, static_cast<int>(search.fromGoal.nodes.size()) - 1);
  return search;
}

// <variant never_swapped> caught by: connect-plane, connect-worlds
// shown by: connect-plane
// mistake: only the tree from the start takes random steps; the other always follows.
// ask: Do the trees never swap? Each takes random steps in turn.
// <solution growBoth>
// in place of: Tree& one = i % 2 == 0 ? search.fromStart : search.fromGoal; ... }
if (!grow(search.fromStart, drawTarget(unbiased, start, rng))) continue;
const Eigen::VectorXd met = search.fromStart.nodes.back();
while (grow(search.fromGoal, met))
  if (search.fromGoal.nodes.back() == met) {
    search.path = joinedPath(search.fromStart, static_cast<int>(search.fromStart.nodes.size()) - 1,
                             search.fromGoal, static_cast<int>(search.fromGoal.nodes.size()) - 1);
    return search;
  }

// <variant averaged_through_walls> caught by: smooth-free, smooth-disc
// shown by: smooth-free
// mistake: moves each node to the middle of its neighbours, again and again, and never tests an edge.
// ask: Was edgeFree never asked about it?
// <solution shortened>
for (int round = 0; round < 200; ++round)
  for (std::size_t i = 1; i + 1 < better.size(); ++i) better[i] = (better[i - 1] + better[i + 1]) / 2;

// <variant calls_the_library> caught by: forbidden-call
// mistake: the library's distance in phase space.
// <solution headers>
#include "planning/phase_space.h"
// <solution effort>
return leastEffort(from, to, T);

// <variant drift_forgotten> caught by: phase-effort, phase-step
// shown by: phase-effort
// mistake: without any force the point is taken to stay where it is.
// ask: Is the drift T v left out? Without any force the point does not stay where it is.
// <solution effort>
const double position = to[0] - from[0], velocity = to[1] - from[1];
return 12 * position * position / (T * T * T) - 12 * position * velocity / (T * T) +
       4 * velocity * velocity / T;
// <solution forceAt>
// in place of: const double position = to[0] - from[0] - T * from[1], velocity = to[1] - from[1];
const double position = to[0] - from[0], velocity = to[1] - from[1];

// <variant euclidean_in_phase_space> caught by: phase-effort, phase-step
// mistake: the nearest state is the one that looks nearest in the picture.
// ask: Is it the length of the difference? What looks near may need much effort.
// <solution effort>
return (to - from).squaredNorm() / T;

// <variant force_counted_backwards> caught by: phase-effort
// shown by: phase-effort
// mistake: the slope of the force is multiplied by t, not by what is left of T.
// ask: Is it the force at T - t? A push at time t moves the end by T - t.
// <solution forceAt>
// in place of: return slope * (T - t) + last;
return slope * t + last;

// <variant force_held> caught by: phase-whole-step, phase-step
// shown by: phase-whole-step
// mistake: the first force is held during the whole step.
// ask: Is the force constant during the step? It changes linearly.
// <solution phaseStep>
// in place of: const double u = forceAt(x, target, T, 0), change = ... x[1] + tau * u + tau * tau / 2 *
const double u = forceAt(x, target, T, 0);
node.x = {x[0] + tau * x[1] + tau * tau / 2 * u, x[1] + tau* u};

// <variant parent_as_printed> caught by: star-parent
// shown by: star-parent
// mistake: the slide as printed: candidates are compared with the first cost, not with the best so far.
// ask: Is each candidate compared with the first cost, as printed on the slide? The cost to beat falls with
// ask: each better parent.
// <solution bestParent>
double first = -1;
for (const int i : near) {
  const auto k = static_cast<std::size_t>(i);
  const double cost = tree.costs[k] + (tree.nodes[k] - q).norm();
  if (!edgeFree(tree.nodes[k], q)) continue;
  if (first < 0) first = cost;
  if (cost <= first) best = ParentChoice{i, cost};
}

// <variant position_in_the_list> caught by: star-parent
// shown by: star-parent
// mistake: the parent is the position in the list of near nodes, not the number of the node.
// ask: Is it the position in `near`? Wanted is the number of the node there.
// <solution bestParent>
for (std::size_t i = 0; i < near.size(); ++i) {
  const auto k = static_cast<std::size_t>(near[i]);
  const double cost = tree.costs[k] + (tree.nodes[k] - q).norm();
  if ((!best || cost < best->cost) && edgeFree(tree.nodes[k], q))
    best = ParentChoice{static_cast<int>(i), cost};
}

// <variant descendants_keep_their_cost> caught by: star-rewired, star-worlds, star-shortest
// shown by: star-rewired
// mistake: a node with a new parent becomes cheaper, but its descendants keep their old costs.
// ask: Do descendants keep their costs? With their ancestor they become cheaper, too.
// <solution rewired>
const auto n = static_cast<std::size_t>(node);
for (const int i : near) {
  const auto k = static_cast<std::size_t>(i);
  const double cost = tree.costs[n] + (tree.nodes[k] - tree.nodes[n]).norm();
  if (cost >= tree.costs[k] || !edgeFree(tree.nodes[n], tree.nodes[k])) continue;
  tree.parents[k] = node;
  tree.costs[k] = cost;
}

// <variant aims_at_a_goal_it_has> caught by: star-thin-walls, star-worlds, star-shortest
// shown by: star-thin-walls
// mistake: targets go on to aim at the goal after it has become a node.
// ask: Do targets still aim at the goal after a step ended there? Then they are wasted on it.
// <solution growStar>
// in place of: SearchSettings now = settings;
// in place of: const Eigen::VectorXd target = drawTarget(now, goal, rng);
const Eigen::VectorXd target = drawTarget(settings, goal, rng);
// in place of: if (search.goal < 0 && q == goal) { ... }
if (search.goal < 0 && q == goal) search.goal = node;

// <variant never_rewired> caught by: star-thin-walls, star-worlds, star-shortest
// shown by: star-thin-walls
// mistake: new nodes take the best parent, but nothing is rewired.
// ask: Are near nodes not rewired, or are too few of them near?
// <solution growStar>
// in place of: const int node = static_cast<int>(tree.nodes.size());
if (search.goal < 0 && q == goal) {
  search.goal = static_cast<int>(tree.nodes.size());
  now.goalBias = 0;
}
// in place of: tree = rewired(std::move(tree), near, node, edgeFree); ... }

// <variant short_way_alone> caught by: star-thin-walls, star-worlds, star-shortest
// shown by: star-thin-walls
// mistake: no RRT*, but the shortened path of two trees as a tree of one branch.
// ask: Is the tree the branch of a path? Each of maxSamples targets makes it grow.
// <solution growStar>
Path way;
double least = std::numeric_limits<double>::infinity();
for (int i = 0; i < 4; ++i) {
  Path one = growBoth(start, goal, settings, edgeFree, rng).path;
  for (int k = 0; k < 12; ++k) one = shortened(one, edgeFree, rng);
  double length = 0;
  for (std::size_t k = 1; k < one.size(); ++k) length += (one[k] - one[k - 1]).norm();
  if (length >= least) continue;
  least = length;
  way = one;
}
Tree& tree = search.tree;
for (std::size_t i = 1; i < way.size(); ++i) {
  const Eigen::VectorXd step = way[i] - way[i - 1];
  const int count = static_cast<int>(std::ceil(step.norm() / settings.stepSize));
  for (int k = 1; k <= count; ++k) {
    const Eigen::VectorXd before = tree.nodes.back(), q = k == count ? way[i] : way[i - 1] + k * step / count;
    edgeFree(before, q);
    tree.parents.push_back(static_cast<int>(tree.nodes.size()) - 1);
    tree.costs.push_back(tree.costs.back() + (q - before).norm());
    tree.nodes.push_back(q);
  }
}
search.goal = static_cast<int>(tree.nodes.size()) - 1;
search.best.assign(static_cast<std::size_t>(settings.maxSamples), tree.costs.back());
