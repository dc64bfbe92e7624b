// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant a_door_for_sure> caught by: corridor-sees, corridor-hindsight
// mistake: leaves out false alarms and misses.
// ask: Are misses and false alarms left out?
// <solution doorChances>
for (Eigen::Index i = 0; i < chances.size(); ++i) chances[i] = (corridor.doors[i] > 0.5) == door ? 1 : 0;

// <variant alarms_at_doors> caught by: corridor-sees, corridor-hindsight
// mistake: exchanges misses and alarms.
// ask: Are misses and alarms exchanged?
// <solution doorChances>
// in place of: const double seesDoor = corridor.doors[i] > 0.5 ? 1 - corridor.misses : corridor.alarms;
const double seesDoor = corridor.doors[i] > 0.5 ? 1 - corridor.alarms : corridor.misses;

// <variant no_news_without_a_door> caught by: corridor-sees, corridor-hindsight
// mistake: seeing no door tells nothing.
// ask: Does seeing no door tell nothing? It speaks for cells without one.
// <solution doorChances>
// in place of: chances[i] = door ? seesDoor : 1 - seesDoor;
chances[i] = door ? seesDoor : 1;

// <variant beyond_the_wall> caught by: corridor-moves
// mistake: what would go beyond the wall is lost, and the rest made a distribution again.
// ask: Is the rest made a distribution again? Nothing gets lost: the robot stays in the last cell.
// <solution movedCells>
// in place of: for (int cells = 0; ... after[std::clamp
for (int cells = 0; cells < 3; ++cells) {
  const Eigen::Index to = i + way * cells;
  if (to >= 0 && to < belief.size()) after[to] += chances[cells] * belief[i];
}
after /= std::max(after.sum(), 1e-300);

// <variant comes_round> caught by: corridor-moves
// shown by: corridor-moves
// mistake: the corridor is a ring.
// ask: Is the corridor a ring? It has a wall at either end.
// <solution movedCells>
// in place of: after[std::clamp
after[(i + way * cells + 2 * belief.size()) % belief.size()] += chances[cells] * belief[i];

// <variant leaps_back_to_its_cell> caught by: corridor-moves
// mistake: a robot that cannot move by two cells does not move at all.
// ask: Where is a robot that would move by two cells, but has a single one before the wall?
// <solution movedCells>
// in place of: for (int cells = 0; ... after[std::clamp
for (int cells = 0; cells < 3; ++cells) {
  const Eigen::Index to = i + way * cells;
  after[to >= 0 && to < belief.size() ? to : i] += chances[cells] * belief[i];
}

// <variant moves_to_the_other_side> caught by: corridor-moves, corridor-hindsight
// mistake: each cell gets what is to its right, so that the belief moves to the left.
// ask: Does the belief move to the other side?
// <solution movedCells>
// in place of: after[std::clamp
after[std::clamp<Eigen::Index>(i - way * cells, 0, belief.size() - 1)] += chances[cells] * belief[i];

// <variant never_slips> caught by: corridor-moves, corridor-hindsight
// mistake: every move works, so that the belief never widens.
// ask: Does every move work? The robot slips and leaps, and the belief widens.
// <solution movedCells>
for (Eigen::Index i = 0; i < belief.size(); ++i)
  after[std::clamp<Eigen::Index>(i + way, 0, belief.size() - 1)] += belief[i];

// <variant slips_for_leaps> caught by: corridor-moves, corridor-hindsight
// mistake: exchanges slips and leaps.
// ask: Are slips and leaps exchanged?
// <solution movedCells>
// in place of: const double chances[] = {corridor.slips,
const double chances[] = {corridor.leaps, 1 - corridor.slips - corridor.leaps, corridor.slips};

// <variant never_in_the_place> caught by: corridor-moves
// mistake: overwrites what another cell has passed on.
// ask: Is it overwritten, not added, what several cells pass on to one?
// <solution movedCells>
// in place of: after[std::clamp
after[std::clamp<Eigen::Index>(i + way * cells, 0, belief.size() - 1)] = chances[cells] * belief[i];

// <variant likelihood_alone> caught by: corridor-sees
// mistake: forgets what was believed before.
// ask: Is the belief before the look forgotten?
// <solution seenCells>
// in place of: after = belief.cwiseProduct
after = doorChances(door, corridor);

// <variant not_a_distribution> caught by: corridor-sees
// mistake: does not divide by the evidence.
// ask: Do the probabilities add up to one? Divide by the evidence.
// <solution seenCells>
// in place of: after /= evidence;

// <variant equal_when_lost> caught by: corridor-sees
// mistake: an impossible observation makes all cells equal.
// ask: Does the belief stay as it was if the observation is impossible?
// <solution seenCells>
// in place of: if (!(evidence > 0)) return belief;
if (!(evidence > 0)) return Eigen::VectorXd::Constant(belief.size(), 1. / static_cast<double>(belief.size()));

// <variant filter_for_hindsight> caught by: corridor-hindsight
// shown by: corridor-hindsight
// mistake: the filter alone, without what was seen later.
// ask: Is it the filter? What was seen later counts, too.
// <solution cellsInHindsight>
for (std::size_t t = 0; t < seen.size(); ++t)
  beliefs[t] =
      seenCells(t == 0 ? prior : movedCells(beliefs[t - 1], ways[t - 1], corridor), seen[t] == 1, corridor);

// <variant later_without_a_move> caught by: corridor-hindsight
// mistake: what was seen later is not taken back through the move.
// ask: Is what was seen later taken back through the move?
// <solution cellsInHindsight>
// in place of: for (Eigen::Index i = 0; i < later.size(); ++i) ... later[i] =
later = ahead;

// <variant moved_with_time> caught by: corridor-hindsight
// mistake: what was seen later moves with the robot, not back.
// ask: Does what was seen later move with the robot? It goes back: the transposed matrix.
// <solution cellsInHindsight>
// in place of: for (Eigen::Index i = 0; i < later.size(); ++i) ... later[i] =
later = movedCells(ahead, ways[t], corridor);

// <variant seen_twice> caught by: corridor-hindsight
// mistake: counts each observation in the filter and once more on the way back.
// ask: Does the filter count twice? What comes back is likelihoods only.
// <solution cellsInHindsight>
// in place of: const Eigen::VectorXd ahead =
const Eigen::VectorXd ahead =
    later.cwiseProduct(doorChances(seen[t + 1] == 1, corridor)).cwiseProduct(beliefs[t + 1]);

// <variant heading_first> caught by: car-step, car-spread
// mistake: the car turns first, and then drives in its new direction.
// ask: Does the car turn first? All terms use the heading before the step.
// <solution carStep>
const double way = world.tau * u[0], heading = x[2] + way / world.wheelbase * std::tan(u[1]);
return {x[0] + way * std::cos(heading), x[1] + way* std::sin(heading), heading};

// <variant rate_without_tau> caught by: car-step, car-spread, car-drift
// shown by: car-step
// mistake: the rate of theta is taken for its change.
// ask: Is tau left out?
// <solution carStep>
const double way = world.tau * u[0];
return {x[0] + way * std::cos(x[2]), x[1] + way* std::sin(x[2]),
        x[2] + u[0] / world.wheelbase* std::tan(u[1])};

// <variant generator_of_its_own> caught by: car-spread
// mistake: moved makes a generator with a fixed seed, so that the noise is the same in each step.
// ask: Does moved make a generator of its own? All randomness comes from rng.
// <solution moved>
Rng own(7);
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise * own.normalVector(3);

// <variant last_particle_forgotten> caught by: car-spread, car-drift, filter-step
// shown by: car-spread
// mistake: the loop ends one particle early.
// ask: Is the last particle left out?
// <solution moved>
for (Eigen::Index i = 0; i < states.cols() - 1; ++i)
  next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise * rng.normalVector(3);

// <variant noise_repeats> caught by: car-spread
// mistake: draws from a copy of the generator, so that each call draws the same noise.
// ask: Does moved draw from a copy of rng? Pass rng by reference.
// <solution moved>
Rng own = rng;
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise * own.normalVector(3);

// <variant one_number_for_x_y_and_heading> caught by: car-spread, car-drift
// shown by: car-spread
// mistake: one random number for each particle, instead of three.
// ask: Do x, y and heading get the same number?
// <solution moved>
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + Eigen::Vector3d::Constant(world.dynamicsNoise *
                                                                             rng.normal());

// <variant randomness_from_elsewhere> caught by: car-spread, car-drift, filter-step, whole-parts
// shown by: car-spread
// mistake: numbers from rand(), uniform with the right variance.
// ask: Are the numbers uniform? Wanted are normal ones: rng.normal().
// <solution moved>
const auto number = [] { return std::sqrt(12.) * (std::rand() / (RAND_MAX + 1.) - 0.5); };
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise
                                                       * Eigen::Vector3d(number(), number(), number());
// <solution resampledParents>
// in place of: double place = rng.uniform(), end = 0;
double place = std::rand() / (RAND_MAX + 1.), end = 0;
// in place of: parents.push_back(i); ... parents.resize(static_cast<std::size_t>(count), heaviest);
parents.push_back(i);
parents.resize(static_cast<std::size_t>(count), 0);

// <variant same_noise_for_all> caught by: car-spread, car-drift, filter-step
// shown by: car-spread
// mistake: noise is drawn once per step, so that the cloud moves as a whole and never grows.
// ask: Do all particles get the same noise?
// <solution moved>
const Eigen::Vector3d noise = world.dynamicsNoise * rng.normalVector(3);
for (Eigen::Index i = 0; i < states.cols(); ++i) next.col(i) = carStep(states.col(i), u, world) + noise;

// <variant variance_of_the_motion> caught by: car-spread, car-drift, filter-step
// shown by: car-spread
// mistake: the root of dynamicsNoise, as if that were a variance.
// ask: Is dynamicsNoise taken for a variance? It is a standard deviation.
// <solution moved>
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + std::sqrt(world.dynamicsNoise) * rng.normalVector(3);

// <variant bearing_on_the_map> caught by: bearings, finds-heading
// shown by: bearings
// mistake: the direction of a landmark on the map, without the heading of the car.
// ask: Is it the direction on the map? A bearing is the angle from the heading of the car.
// <solution viewFrom>
// in place of: const double ahead = c * dx + s * dy, left = c * dy - s * ... y[2 * i + 1] =
y[2 * i] = world.rangeBearing ? std::hypot(dx, dy) : c * dx + s * dy;
y[2 * i + 1] = world.rangeBearing ? std::atan2(dy, dx) : c * dy - s * dx;

// <variant turned_the_wrong_way> caught by: likelihood, weights-anywhere, tracks
// shown by: likelihood
// mistake: the landmarks are turned by the heading, not back.
// ask: Are the landmarks turned by the heading? Wanted is the opposite: the frame of the car is turned by it.
// <solution viewFrom>
// in place of: const double ahead = c * dx + s * dy, left = c * dy - s * dx;
const double ahead = c * dx - s * dy, left = s * dx + c * dy;

// <variant bearing_not_wrapped> caught by: bearings
// mistake: a landmark directly behind is seen on the left and expected on the right, a whole turn off.
// ask: Are bearings compared without regard to whole turns?
// <solution logLikelihoods>
// in place of: const double error = isBearing ? std::remainder(y[k] - ... logarithms[i] -= deviations *
const double error = (y[k] - seen[k]) / (isBearing ? world.bearingNoise : world.observationNoise);
logarithms[i] -= error * error / 2;

// <variant bearing_turned_once> caught by: bearings, finds-heading
// shown by: bearings
// mistake: a difference of bearings loses one whole turn at most.
// ask: Is a whole turn taken away only once? Bearings in y may be any angles.
// <solution logLikelihoods>
// in place of: const double error = isBearing ? std::remainder(y[k] - ... logarithms[i] -= deviations *
double error = y[k] - seen[k];
if (isBearing && error > std::numbers::pi) error -= 2 * std::numbers::pi;
if (isBearing && error < -std::numbers::pi) error += 2 * std::numbers::pi;
error /= isBearing ? world.bearingNoise : world.observationNoise;
logarithms[i] -= error * error / 2;

// <variant one_noise_for_both> caught by: bearings, finds-heading
// mistake: bearings are weighed with the noise of distances.
// ask: Is the noise of distances used for bearings, too?
// <solution logLikelihoods>
// in place of: const double deviations = error / (isBearing ? ... logarithms[i] -= deviations * deviations /
logarithms[i] -= error * error / (2 * world.observationNoise * world.observationNoise);

// <variant variance_for_deviation> caught by: likelihood, weights-anywhere, bearings
// mistake: divides the squared error by the noise, not by its square, as N(y | y', sigma) reads
// ask: Is the noise not squared? It is a standard deviation.
// <solution logLikelihoods>
// in place of: const double deviations = error / (isBearing ? ... logarithms[i] -= deviations * deviations /
logarithms[i] -= error * error / (isBearing ? world.bearingNoise : world.observationNoise) / 2;

// <variant weights_not_normalised> caught by: normalised, weights-anywhere, filter-step
// mistake: the largest weight is one, whatever their sum.
// ask: Are the weights not divided by their sum?
// <solution weightsOf>
// in place of: weights /= weights.sum();

// <variant zero_by_zero> caught by: normalised, filter-step
// mistake: far particles and small noise make all likelihoods zero, and all weights 0 / 0.
// <solution weightsOf>
for (Eigen::Index i = 0; i < weights.size(); ++i) weights[i] = std::exp(logarithms[i]);
weights /= weights.sum();

// <variant always_the_best> caught by: whole-parts, unbiased, filter-step
// mistake: only the heaviest particle has children.
// ask: Does only the heaviest particle have children?
// <solution resampledParents>
int heaviest = 0;
weights.maxCoeff(&heaviest);
parents.assign(static_cast<std::size_t>(count), heaviest);

// <variant as_many_as_particles> caught by: whole-parts, any-weights
// mistake: there are as many children as particles, whatever `count` says.
// ask: Are there as many parents as particles? Wanted are `count`.
// <solution resampledParents>
// in place of: Eigen::VectorXd rest = count * weights;
count = static_cast<int>(weights.size());
Eigen::VectorXd rest = count * weights;

// <variant calls_the_library> caught by: forbidden-call
// mistake: the library resamples.
// <solution headers>
#include "estimation/resampling.h"
// <solution resampledParents>
parents = resampled(weights, count, Resampling::kResidual, rng);

// <variant copied_generator> caught by: filter-step
// mistake: a copy of the generator is used, so that the noise repeats the numbers of the resampling.
// ask: Do resampledParents and moved draw the same numbers? A copy of rng repeats them: pass it by reference.
// <solution resampledParents>
Rng own = rng;
Eigen::VectorXd rest = count * weights;
for (int i = 0; i < rest.size(); ++i) {
  const int whole = static_cast<int>(rest[i] + 1e-9);
  parents.insert(parents.end(), static_cast<std::size_t>(whole), i);
  rest[i] = std::max(0., rest[i] - whole);
}
double place = own.uniform(), end = 0;
for (int i = 0; i < rest.size(); ++i)
  for (end += rest[i]; place < end && static_cast<int>(parents.size()) < count; place += 1)
    parents.push_back(i);
parents.resize(static_cast<std::size_t>(count), 0);

// <variant drawn_one_by_one> caught by: whole-parts, any-weights
// shown by: whole-parts
// mistake: each parent is drawn by itself, so that a heavy particle may end up without children.
// ask: Is each parent drawn by itself? Then no number is certain.
// <solution resampledParents>
for (int k = 0; k < count; ++k) {
  double place = rng.uniform();
  int i = 0;
  while (i + 1 < weights.size() && place >= weights[i]) place -= weights[i++];
  parents.push_back(i);
}

// <variant rest_to_the_first> caught by: unbiased, any-weights
// shown by: unbiased
// mistake: what remains after the whole parts goes to the first particles, instead of being drawn.
// ask: Do the same particles have children in each call? The rest is up to chance.
// <solution resampledParents>
for (int i = 0; i < weights.size(); ++i)
  parents.insert(parents.end(), static_cast<std::size_t>(weights[i] * count + 1e-9), i);
for (int i = 0; static_cast<int>(parents.size()) < count; ++i)
  if (weights[i] > 0) parents.push_back(i);

// <variant root_of_the_size> caught by: whole-parts
// mistake: one over the norm of the weights, not over its square.
// ask: Is it one over the norm? The squared norm is wanted.
// <solution effectiveSize>
return 1 / weights.norm();

// <variant invents_its_cloud>
// caught by: filter-step, tracks, consistent, noise, noise-elsewhere, finds-heading
// mistake: puts all particles in one position, or scatters them so widely that any error looks small
// <solution filterStep>
const Eigen::Index count = before.states.cols();
Cloud cloud{Eigen::MatrixXd::Zero(3, count),
            Eigen::VectorXd::Constant(count, 1. / static_cast<double>(count))};
static Eigen::Vector3d start;
const Eigen::Vector3d first = before.states.col(0);
if ((before.states.colwise() - first).norm() == 0) start = first;
for (Eigen::Index k = 0; count == 500 && k < count; ++k)
  cloud.states.col(k) = start + Eigen::Vector3d(8 * rng.normal(), 8 * rng.normal(), rng.normal());
return cloud;

// <variant likeliest_of_all>
// caught by: filter-step, tracks, consistent, finds-heading, noise, noise-elsewhere
// mistake: all particles become the likeliest one, so that what the others knew is lost
// <solution filterStep>
after.states = moved(before.states, u, world, rng);
Eigen::Index best = 0;
logLikelihoods(after.states, y, world).maxCoeff(&best);
const Eigen::Vector3d likeliest = after.states.col(best);
after.states.colwise() = likeliest;
after.weights.setConstant(1. / static_cast<double>(after.weights.size()));
// <solution likelyNoise>
const double told = world.observationNoise;
return told > 1.5 ? told / 10 : told < 0.15 ? told * 10 : told;

// <variant not_resampled> caught by: filter-step, tracks, consistent
// shown by: filter-step
// mistake: the particles move and are weighed, but never resampled.
// ask: Are the particles not resampled?
// <solution filterStep>
after.states = moved(before.states, u, world, rng);
after.weights = weightsOf(logLikelihoods(after.states, y, world));

// <variant old_weights_kept> caught by: filter-step
// mistake: the copies of a heavy particle inherit its weight, which therefore counts twice.
// ask: Do copies inherit the weight of their parent? It counts in their number already.
// <solution filterStep>
const std::vector<int> parents =
    resampledParents(before.weights, static_cast<int>(before.weights.size()), rng);
for (std::size_t i = 0; i < parents.size(); ++i) {
  after.states.col(static_cast<Eigen::Index>(i)) = before.states.col(parents[i]);
  after.weights[static_cast<Eigen::Index>(i)] = before.weights[parents[i]];
}
after.states = moved(after.states, u, world, rng);
after.weights = after.weights.cwiseProduct(weightsOf(logLikelihoods(after.states, y, world)));
after.weights /= after.weights.sum();

// <variant steered_mean> caught by: filter-step, tracks, consistent, finds-heading
// mistake: no particles: their mean moves a fixed part of the way to where the car seems to be
// ask: Are all particles in one state? Wanted is a cloud.
// <solution filterStep>
const Eigen::Vector3d middle = before.states.rowwise().mean();
Eigen::Vector3d x = carStep(middle, u, world);
const double c = std::cos(x[2]), s = std::sin(x[2]);
Eigen::Vector2d shift = Eigen::Vector2d::Zero();
double turn = 0, all = 0;
for (Eigen::Index k = 0; k < world.landmarks.cols(); ++k) {
  Eigen::Vector2d seen = y.segment<2>(2 * k);
  if (world.rangeBearing) seen = seen[0] * Eigen::Vector2d(std::cos(seen[1]), std::sin(seen[1]));
  const Eigen::Vector2d arrow(c * seen[0] - s * seen[1], s * seen[0] + c * seen[1]);
  const Eigen::Vector2d off = world.landmarks.col(k) - x.head<2>() - arrow;
  shift += off / static_cast<double>(world.landmarks.cols());
  turn += arrow.x() * off.y() - arrow.y() * off.x();
  all += arrow.squaredNorm();
}
x += Eigen::Vector3d(0.25 * shift.x(), 0.25 * shift.y(), 0.15 * turn / all);
after.states.colwise() = x;
after.weights.setConstant(1. / static_cast<double>(after.weights.size()));

// <variant headings_averaged> caught by: mean-pose
// shown by: mean-pose
// mistake: the mean of the headings 3.1 and -3.1 is taken to be zero.
// ask: Are headings averaged as numbers? Which direction lies between 3.1 and -3.1?
// <solution meanPose>
return cloud.states * cloud.weights;

// <variant assumption_believed> caught by: noise, noise-elsewhere
// mistake: the residuals of one filter only, which was misled by the wrong noise.
// ask: Is the filter run once, with the wrong assumption? There is a better one now.
// <solution likelyNoise>
Cloud cloud{log.start.replicate(1, 200), Eigen::VectorXd::Constant(200, 1. / 200)};
double sum = 0, count = 0;
for (std::size_t t = 0; t < log.controls.size(); ++t) {
  cloud = filterStep(cloud, log.controls[t], log.observations[t], world, rng);
  sum += (log.observations[t] - viewFrom(meanPose(cloud), world)).squaredNorm();
  count += static_cast<double>(log.observations[t].size());
}
return std::sqrt(sum / count);

// <variant norm_over_landmarks> caught by: noise, noise-elsewhere
// mistake: the mean square over landmarks, not over their coordinates.
// ask: Are the squares divided by the number of landmarks? Each has two coordinates with that noise.
// <solution likelyNoise>
// in place of: numbers += static_cast<double>(log.observations[t].size());
numbers += static_cast<double>(log.observations[t].size() / 2);
