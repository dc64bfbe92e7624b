// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant nearest_corner> caught by: rays
// mistake: rounds to the nearest corner of a cell.
// <solution cellAt>
return {static_cast<int>(std::round((p.x() - grid.origin.x()) / grid.cell)),
        static_cast<int>(std::round((p.y() - grid.origin.y()) / grid.cell))};

// <variant no_origin> caught by: rays
// mistake: the grid begins at (0, 0).
// <solution cellAt>
return {static_cast<int>(std::floor(p.x() / grid.cell)), static_cast<int>(std::floor(p.y() / grid.cell))};

// <variant rounds_towards_zero> caught by: rays, more-rays
// mistake: a cast to int, which is one cell too far left of the origin.
// <solution cellAt>
return {static_cast<int>((p.x() - grid.origin.x()) / grid.cell),
        static_cast<int>((p.y() - grid.origin.y()) / grid.cell)};

// <variant bresenham> caught by: rays, more-rays
// shown by: rays
// mistake: a line as it is drawn on screens: from cell to cell, also diagonally.
// <solution cellsAlong>
// in place of: const Eigen::Vector2d way = to - from; ... }
// in place of: for (int left = (last - cell).cwiseAbs().sum(); left > 0; ... }
const int dx = std::abs(last[0] - cell[0]), dy = -std::abs(last[1] - cell[1]);
for (int error = dx + dy; cell != last;) {
  const int twice = 2 * error;
  if (twice >= dy) error += dy, cell[0] += last[0] > cell[0] ? 1 : -1;
  if (twice <= dx) error += dx, cell[1] += last[1] > cell[1] ? 1 : -1;
  cells.push_back(cell);
}

// <variant ends_before_the_end> caught by: rays
// mistake: the last cell is left out.
// <solution cellsAlong>
// in place of: return cells;
if (cells.size() > 1) cells.pop_back();
return cells;

// <variant steps_of_a_cell> caught by: rays, more-rays
// mistake: looks once per side of a cell.
// <solution cellsAlong>
std::vector<Eigen::Vector2i> cells{cellAt(grid, from)};
const int count = static_cast<int>(std::ceil((to - from).norm() / grid.cell));
for (int k = 1; k <= count; ++k) {
  const Eigen::Vector2i cell = cellAt(grid, from + (to - from) * k / count);
  if (cell != cells.back()) cells.push_back(cell);
}
return cells;

// <variant adds_for_each_ray> caught by: more-updates
// mistake: near the robot each ray adds its own.
// <solution observed>
// in place of: if (isHit && i + 1 == cells.size()) ... change(x, y) = evidence.miss;
if (isHit && i + 1 == cells.size())
  change(x, y) += evidence.hit;
else
  change(x, y) += evidence.miss;

// <variant calls_the_library> caught by: forbidden-call
// mistake: lets the library follow the rays.
// <solution headers>
#include "estimation/occupancy_map.h"
// <solution observed>
OccupancyMap cells(static_cast<int>(map.values.rows()), static_cast<int>(map.values.cols()), map.cell,
                   map.origin);
const RangeScanner scanner{{scan.angles.data(), scan.angles.data() + scan.angles.size()}, scan.maxRange};
cells.observe(scanner, pose, scan.ranges);
for (int i = 0; i < cells.width(); ++i)
  for (int j = 0; j < cells.height(); ++j)
    after.values(i, j) = std::clamp(map.values(i, j) + cells.logOdds(i, j), -evidence.bound, evidence.bound);

// <variant clockwise> caught by: update, more-updates
// mistake: angles of rays grow to the right.
// <solution observed>
// in place of: const double direction = pose[2] + scan.angles[ray];
const double direction = pose[2] - scan.angles[ray];

// <variant ignores_maximum> caught by: update, more-updates
// mistake: rays that hit nothing are left out.
// <solution observed>
// in place of: const double direction = pose[2] + scan.angles[ray];
if (!isHit) continue;
const double direction = pose[2] + scan.angles[ray];

// <variant never_limited> caught by: update, more-updates
// mistake: log odds grow without a limit.
// <solution observed>
// in place of: after.values = (map.values + change).cwiseMax(-evidence.bound).cwiseMin(evidence.bound);
after.values = (map.values + change);

// <variant the_last_ray_wins> caught by: update, more-updates
// mistake: a ray that passes clears a cell in which another one ended.
// <solution observed>
// in place of: if (isHit && i + 1 == cells.size()) ... change(x, y) = evidence.miss;
if (isHit && i + 1 == cells.size())
  change(x, y) = evidence.hit;
else
  change(x, y) = evidence.miss;

// <variant walls_at_maximum> caught by: update, more-updates
// shown by: update
// mistake: a ray that hits nothing ends at a wall.
// <solution observed>
// in place of: const bool isHit = scan.ranges[ray] < scan.maxRange;
const bool isHit = scan.ranges[ray] > 0;

// <variant blocks> caught by: distances, more-fits
// shown by: distances
// mistake: the way along x and then along y.
// <solution wallDistances>
const Eigen::Index width = map.values.rows(), height = map.values.cols();
const auto around = static_cast<Eigen::Index>(std::ceil(reach / map.cell));
for (Eigen::Index j = 0; j < height; ++j)
  for (Eigen::Index i = 0; i < width; ++i) {
    if (map.values(i, j) <= 0) continue;
    for (Eigen::Index y = std::max<Eigen::Index>(j - around, 0); y <= std::min(j + around, height - 1); ++y)
      for (Eigen::Index x = std::max<Eigen::Index>(i - around, 0); x <= std::min(i + around, width - 1); ++x)
        distances.values(x, y) = std::min(distances.values(x, y),
                                          map.cell * static_cast<double>(std::abs(x - i) + std::abs(y - j)));
  }

// <variant in_cells> caught by: distances, more-fits
// mistake: distances are counted in cells.
// <solution wallDistances>
const Eigen::Index width = map.values.rows(), height = map.values.cols();
const auto around = static_cast<Eigen::Index>(std::ceil(reach / map.cell));
for (Eigen::Index j = 0; j < height; ++j)
  for (Eigen::Index i = 0; i < width; ++i) {
    if (map.values(i, j) <= 0) continue;
    for (Eigen::Index y = std::max<Eigen::Index>(j - around, 0); y <= std::min(j + around, height - 1); ++y)
      for (Eigen::Index x = std::max<Eigen::Index>(i - around, 0); x <= std::min(i + around, width - 1); ++x)
        distances.values(x, y) = std::min(
            distances.values(x, y), std::sqrt(static_cast<double>((x - i) * (x - i) + (y - j) * (y - j))));
  }

// <variant unknown_is_wall> caught by: distances, more-fits
// mistake: unknown cells are occupied.
// <solution wallDistances>
// in place of: if (map.values(i, j) <= 0) continue;
if (map.values(i, j) < 0) continue;

// <variant value_of_the_cell> caught by: fits, more-fits
// mistake: the value of the cell, in steps.
// <solution valueAt>
const Eigen::Vector2i cell = cellAt(grid, p);
return grid.values(std::clamp<Eigen::Index>(cell[0], 0, grid.values.rows() - 1),
                   std::clamp<Eigen::Index>(cell[1], 0, grid.values.cols() - 1));

// <variant values_at_corners> caught by: fits, more-fits
// mistake: values belong to the lower left corners of cells.
// <solution valueAt>
// in place of: const Eigen::Vector2d share = ((p - grid.origin) / grid.cell).array() - .5;
const Eigen::Vector2d share = ((p - grid.origin) / grid.cell).array() - 0.;

// <variant counts_maximum> caught by: fits, more-fits
// mistake: rays that hit nothing should end at walls as well.
// <solution fit>
// in place of: if (scan.ranges[ray] >= scan.maxRange) continue;

// <variant linear_cost> caught by: fits
// mistake: distances are not squared.
// <solution fit>
// in place of: sum += d * d;
sum += d;

// <variant angles_in_degrees> caught by: fits
// mistake: converts angles, as if they were degrees.
// <solution fit>
// in place of: const double direction = pose[2] + scan.angles[ray];
const double direction = (pose[2] + scan.angles[ray]) * std::acos(-1) / 180;

// <variant seen_by_the_robot> caught by: fits
// mistake: the heading is subtracted.
// <solution fit>
// in place of: const double direction = pose[2] + scan.angles[ray];
const double direction = scan.angles[ray] - pose[2];

// <variant leaves_the_window> caught by: match, more-matches
// mistake: climbs on beyond the window.
// <solution matched>
// in place of: if (((pose - guess).cwiseAbs() - half).maxCoeff() > 0) return false;
if (((pose - guess).cwiseAbs() - 2 * half).maxCoeff() > 0) return false;

// <variant y_like_the_heading> caught by: match
// mistake: window[1] limits y.
// <solution matched>
// in place of: const Eigen::Vector3d half(window[0], window[0], window[1]);
const Eigen::Vector3d half(window[0], window[1], window[1]);

// <variant never_turns> caught by: match, more-matches
// mistake: only positions are tried.
// <solution matched>
Eigen::Vector3d best = guess;
double score = fit(distances, guess, scan, deviation);
for (int i = -20; i <= 20; ++i)
  for (int j = -20; j <= 20; ++j) {
    const Eigen::Vector3d pose = guess + Eigen::Vector3d(i, j, 0) * window[0] / 20;
    const double value = fit(distances, pose, scan, deviation);
    if (value > score) best = pose, score = value;
  }
return best;

// <variant one_coarse_search> caught by: match, more-matches
// mistake: the best of 27 poses, without going on from there.
// <solution matched>
const Eigen::Vector3d half(window[0], window[0], window[1]);
Eigen::Vector3d best = guess;
double score = fit(distances, best, scan, deviation);
const auto take = [&](const Eigen::Vector3d& pose) {
  if (((pose - guess).cwiseAbs() - half).maxCoeff() > 0) return false;
  const double value = fit(distances, pose, scan, deviation);
  if (value <= score) return false;
  best = pose;
  score = value;
  return true;
};
for (int n = 0; n < 27; ++n)
  take(guess + 2. / 3 * Eigen::Vector3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1).cwiseProduct(half));
for (double part = 1. / 3; part > 1;) {
  bool isBetter = false;
  for (int n = 0; n < 6; ++n) {
    Eigen::Vector3d pose = best;
    pose[n / 2] += (n % 2 == 0 ? part : -part) * half[n / 2];
    isBetter = take(pose) || isBetter;
  }
  if (!isBetter) part /= 2;
}
return best;

// <variant one_round> caught by: match
// mistake: one number after the other, once.
// <solution matched>
Eigen::Vector3d best = guess;
for (int i = 0; i < 3; ++i) {
  double score = fit(distances, best, scan, deviation);
  for (int k = -20; k <= 20; ++k) {
    Eigen::Vector3d pose = best;
    pose[i] = guess[i] + window[i / 2] * k / 20;
    const double value = fit(distances, pose, scan, deviation);
    if (value > score) best = pose, score = value;
  }
}
return best;

// <variant in_the_world> caught by: motion
// mistake: the motion is not rotated.
// <solution moved>
// in place of: poses.col(k) += Eigen::Vector3d(cosine * way[0] - sine * way[1], sine * way[0] + cosine *
poses.col(k) += way;

// <variant no_noise> caught by: motion
// mistake: odometry is right.
// <solution moved>
// in place of: for (int i = 0; i < 3; ++i) way[i] += deviations[i] * rng.normal();
for (int i = 0; i < 3; ++i) way[i] += 0 * deviations[i] * rng.normal();

// <variant one_noise_for_all_poses> caught by: motion
// mistake: draws the noise once.
// <solution moved>
const double cosine = std::cos(pose[2]), sine = std::sin(pose[2]);
Eigen::Vector3d way = motion;
for (int i = 0; i < 3; ++i) way[i] += deviations[i] * rng.normal();
for (int k = 0; k < count; ++k)
  poses.col(k) += Eigen::Vector3d(cosine * way[0] - sine * way[1], sine* way[0] + cosine * way[1], way[2]);

// <variant noise_in_the_world> caught by: motion
// mistake: noise is added after the rotation.
// <solution moved>
const double c = std::cos(pose[2]), s = std::sin(pose[2]);
for (int k = 0; k < count; ++k) {
  poses.col(k) += Eigen::Vector3d(c * motion[0] - s * motion[1], s * motion[0] + c * motion[1], motion[2]);
  for (int i = 0; i < 3; ++i) poses(i, k) += deviations[i] * rng.normal();
}

// <variant rotated_back> caught by: motion
// shown by: motion
// mistake: rotated by the transpose.
// <solution moved>
// in place of: poses.col(k) += Eigen::Vector3d(cosine * way[0] - sine * way[1], sine * way[0] + cosine *
poses.col(k) += Eigen::Vector3d(cosine * way[0] + sine * way[1], cosine* way[1] - sine * way[0], way[2]);

// <variant variances> caught by: motion
// mistake: deviations are taken for variances, the wrong way round.
// <solution moved>
// in place of: for (int i = 0; i < 3; ++i) way[i] += deviations[i] * rng.normal();
for (int i = 0; i < 3; ++i) way[i] += deviations[i] * deviations[i] * rng.normal();

// <variant not_normalised> caught by: weights
// mistake: the sum is not one.
// <solution weightsOf>
// in place of: weights /= weights.sum();

// <variant zero_by_zero> caught by: weights
// mistake: exp() of large negative numbers is zero for all.
// <solution weightsOf>
// in place of: weights = (weights.array() - weights.maxCoeff()).exp().eval();
weights = weights.array().exp().eval();

// <variant sum_of_squares> caught by: weights
// mistake: the sum of the squares, not one over it.
// <solution effectiveSize>
return weights.squaredNorm();

// <variant each_by_itself> caught by: copies, more-copies
// mistake: each copy is drawn by itself.
// <solution resampled>
const Eigen::VectorXd weights = weightsOf(particles);
for (std::size_t n = 0; n < particles.size(); ++n) {
  double point = rng.uniform();
  std::size_t k = 0;
  while (k + 1 < particles.size() && point >= weights[static_cast<Eigen::Index>(k)])
    point -= weights[static_cast<Eigen::Index>(k++)];
  copies.push_back({particles[k].path, particles[k].map, 0});
}

// <variant a_number_for_each_copy> caught by: copies, more-copies
// mistake: draws a new random number for each copy.
// <solution resampled>
// in place of: copies.push_back({particles[i].path, particles[i].map, 0});
copies.push_back({particles[i].path, particles[i].map, 0}), point = std::floor(point) + rng.uniform();

// <variant the_next_particle> caught by: copies, more-copies
// mistake: copies particle i + 1 instead of i.
// <solution resampled>
// in place of: copies.push_back({particles[i].path, particles[i].map, 0});
copies.push_back({particles[(i + 1) % particles.size()].path, particles[(i + 1) % particles.size()].map, 0});

// <variant maps_stay> caught by: copies, more-copies
// mistake: paths are copied, and maps stay where they are.
// <solution resampled>
// in place of: copies.push_back({particles[i].path, particles[i].map, 0});
copies.push_back({particles[i].path, particles[copies.size()].map, 0});

// <variant weights_are_kept> caught by: copies
// mistake: copies keep the weight that they were chosen for.
// <solution resampled>
// in place of: copies.push_back({particles[i].path, particles[i].map, 0});
copies.push_back({particles[i].path, particles[i].map, particles[i].logWeight});

// <variant maps_of_the_drawn_pose> caught by: step
// shown by: step
// mistake: the scan is drawn at the pose before the match.
// <solution slamStep>
// in place of: if (settings.matches) pose = matched(distances, scan, settings.deviation, pose,
const Eigen::Vector3d drawn = pose;
if (settings.matches) pose = matched(distances, scan, settings.deviation, pose, settings.window);
// in place of: particle.map = observed(particle.map, pose, scan, settings.evidence);
particle.map = observed(particle.map, drawn, scan, settings.evidence);

// <variant never_matches> caught by: step
// mistake: poses are those of the motion.
// <solution slamStep>
// in place of: if (settings.matches) pose = matched(distances, scan, settings.deviation, pose,

// <variant always_matches> caught by: step
// mistake: matches, whatever the settings say.
// <solution slamStep>
// in place of: if (settings.matches) pose = matched(distances, scan, settings.deviation, pose,
pose = matched(distances, scan, settings.deviation, pose, settings.window);

// <variant no_temper> caught by: step
// mistake: rays count as if they were independent.
// <solution slamStep>
// in place of: particle.logWeight += fit(distances, pose, scan, settings.deviation) / settings.temper;
particle.logWeight += fit(distances, pose, scan, settings.deviation);

// <variant one_map_for_all> caught by: step
// mistake: all particles share the map of the first one.
// <solution slamStep>
// in place of: const Grid distances = wallDistances(particle.map, settings.reach);
const Grid distances = wallDistances(particles[0].map, settings.reach);
// in place of: particle.map = observed(particle.map, pose, scan, settings.evidence);
particle.map = observed(particles[0].map, pose, scan, settings.evidence);

// <variant same_motion_for_all> caught by: step
// mistake: noise is drawn once for all particles.
// <solution slamStep>
const Rng same = rng;
for (Particle& particle : after) {
  rng = same;
  Eigen::Vector3d pose = moved(particle.path.back(), motion, settings.odometry, 1, rng).col(0);
  const Grid distances = wallDistances(particle.map, settings.reach);
  if (settings.matches) pose = matched(distances, scan, settings.deviation, pose, settings.window);
  particle.logWeight += fit(distances, pose, scan, settings.deviation) / settings.temper;
  particle.path.push_back(pose);
  particle.map = observed(particle.map, pose, scan, settings.evidence);
}

// <variant scan_first> caught by: step
// mistake: the scan is in the map already when it is asked how well it fits.
// <solution slamStep>
// in place of: particle.logWeight += fit(distances, pose, scan, settings.deviation) / settings.temper;
particle.map = observed(particle.map, pose, scan, settings.evidence);
particle.logWeight +=
    fit(wallDistances(particle.map, settings.reach), pose, scan, settings.deviation) / settings.temper;
// in place of: particle.map = observed(particle.map, pose, scan, settings.evidence);

// <variant weight_of_the_last_scan> caught by: step
// mistake: only the last scan counts.
// <solution slamStep>
// in place of: particle.logWeight += fit(distances, pose, scan, settings.deviation) / settings.temper;
particle.logWeight = fit(distances, pose, scan, settings.deviation) / settings.temper;

// <variant first_scan_lost> caught by: rule
// mistake: the first scan is not in the maps.
// <solution mapped>
// in place of: for (Particle& one : particles) one.map = observed(empty, log.start, log.scans[0],

// <variant least_weight> caught by: rule
// mistake: returns the particle of the least weight.
// <solution mapped>
// in place of: for (std::size_t t = 0; t < log.motions.size(); ++t) { ... }
for (std::size_t t = 0; t < log.motions.size(); ++t) {
  if (!sizes.empty() && sizes.back() < settings.threshold * count) particles = resampled(particles, rng);
  particles = slamStep(particles, log.motions[t], log.scans[t + 1], settings, rng);
  sizes.push_back(effectiveSize(weightsOf(particles)));
}
for (Particle& one : particles) one.logWeight = -one.logWeight;

// <variant never_resamples> caught by: rule
// mistake: never resamples.
// <solution mapped>
// in place of: if (!sizes.empty() && sizes.back() < settings.threshold * count) particles =

// <variant sizes_after_resampling> caught by: rule
// mistake: notes the effective size after particles were resampled.
// <solution mapped>
for (Particle& one : particles) one.map = observed(empty, log.start, log.scans[0], settings.evidence);
for (std::size_t t = 0; t < log.motions.size(); ++t) {
  particles = slamStep(particles, log.motions[t], log.scans[t + 1], settings, rng);
  if (effectiveSize(weightsOf(particles)) < settings.threshold * count) particles = resampled(particles, rng);
  sizes.push_back(effectiveSize(weightsOf(particles)));
}

// <variant one_scan_late> caught by: tour, more-tours
// shown by: tour
// mistake: each motion goes with the scan before it.
// <solution mapped>
// in place of: particles = slamStep(particles, log.motions[t], log.scans[t + 1], settings, rng);
particles = slamStep(particles, log.motions[t], log.scans[t], settings, rng);

// <variant resamples_always> caught by: rule
// shown by: rule
// mistake: resamples after each step.
// <solution mapped>
// in place of: if (!sizes.empty() && sizes.back() < settings.threshold * count) particles =
if (!sizes.empty()) particles = resampled(particles, rng);

// <variant begins_in_the_middle> caught by: wake-up, more-wake-ups
// shown by: wake-up
// mistake: a match from the middle of the map.
// <solution located>
const Eigen::Vector2d middle =
    map.origin + .5 * map.cell * Eigen::Vector2d(map.values.rows(), map.values.cols());
return matched(wallDistances(map, settings.reach), scan, settings.deviation, {middle[0], middle[1], 0},
               {.4 * map.cell * static_cast<double>(map.values.rows()), 3});

// <variant one_heading> caught by: wake-up, more-wake-ups
// mistake: the robot looks along x.
// <solution located>
// in place of: for (int k = 0; k < 36 && map.values(i, j) < 0; ++k) { ... }
for (int k = 0; k < 1 && map.values(i, j) < 0; ++k) {
  const Eigen::Vector3d coarse(map.origin[0] + map.cell * (static_cast<double>(i) + .5),
                               map.origin[1] + map.cell * (static_cast<double>(j) + .5),
                               std::acos(-1) / 18 * k);
  candidates.emplace_back(fit(wide, coarse, scan, 2 * settings.deviation), coarse);
}

// <variant without_a_match> caught by: more-wake-ups
// mistake: the best pose of a coarse grid.
// <solution located>
// in place of: const Eigen::Vector3d match = ... matched(distances, scan, settings.deviation,
const Eigen::Vector3d match = candidates[k].second;
