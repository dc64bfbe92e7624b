#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

Eigen::Vector2i cellAt(const Grid& grid, const Eigen::Vector2d& p) {
  // <solution cellAt>
  return {static_cast<int>(std::floor((p.x() - grid.origin.x()) / grid.cell)),
          static_cast<int>(std::floor((p.y() - grid.origin.y()) / grid.cell))};
  // <todo>
  //| // TODO: how many cells from the origin, rounded down?
  //| return Eigen::Vector2i::Zero();
  // </solution>
}

std::vector<Eigen::Vector2i> cellsAlong(const Grid& grid, const Eigen::Vector2d& from,
                                        const Eigen::Vector2d& to) {
  // <solution cellsAlong>
  Eigen::Vector2i cell = cellAt(grid, from);
  const Eigen::Vector2i last = cellAt(grid, to);
  const Eigen::Vector2d way = to - from;
  // Where on the way the next border along x and the next one along y are, and from one to the next.
  Eigen::Vector2d next, gap;
  for (const int k : {0, 1}) {
    const double border = grid.origin[k] + grid.cell * (cell[k] + (way[k] > 0 ? 1 : 0));
    next[k] = way[k] == 0 ? 2 : (border - from[k]) / way[k];
    gap[k] = way[k] == 0 ? 2 : grid.cell / std::abs(way[k]);
  }
  std::vector<Eigen::Vector2i> cells{cell};
  for (int left = (last - cell).cwiseAbs().sum(); left > 0; --left) {
    const int axis = next[0] < next[1] ? 0 : 1;
    cell[axis] += way[axis] > 0 ? 1 : -1;
    next[axis] += gap[axis];
    cells.push_back(cell);
  }
  return cells;
  // <todo>
  //| // TODO: step from grid line to grid line. Is the next crossing along x or along y?
  //| return {};
  // </solution>
}

Grid observed(const Grid& map, const Eigen::Vector3d& pose, const Scan& scan, const CellEvidence& evidence) {
  Grid after = map;
  // <solution observed>
  const Eigen::Vector2d p(pose[0], pose[1]);
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(map.values.rows(), map.values.cols());
  for (Eigen::Index ray = 0; ray < scan.angles.size(); ++ray) {
    const bool isHit = scan.ranges[ray] < scan.maxRange;
    const double direction = pose[2] + scan.angles[ray];
    const double range = std::min(scan.ranges[ray], scan.maxRange);
    const auto cells =
        cellsAlong(map, p, p + range * Eigen::Vector2d(std::cos(direction), std::sin(direction)));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const int x = cells[i][0], y = cells[i][1];
      if (x < 0 || y < 0 || x >= change.rows() || y >= change.cols()) continue;
      if (isHit && i + 1 == cells.size())
        change(x, y) = evidence.hit;
      else if (change(x, y) != evidence.hit)
        change(x, y) = evidence.miss;
    }
  }
  after.values = (map.values + change).cwiseMax(-evidence.bound).cwiseMin(evidence.bound);
  // <todo>
  //| // TODO: follow each ray, and note for each cell whether a ray ends in it, or only passes.
  // </solution>
  return after;
}

Grid wallDistances(const Grid& map, double reach) {
  Grid distances = map;
  distances.values.setConstant(reach);
  // <solution wallDistances>
  const Eigen::Index width = map.values.rows(), height = map.values.cols();
  const auto around = static_cast<Eigen::Index>(std::ceil(reach / map.cell));
  for (Eigen::Index j = 0; j < height; ++j)
    for (Eigen::Index i = 0; i < width; ++i) {
      if (map.values(i, j) <= 0) continue;
      for (Eigen::Index y = std::max<Eigen::Index>(j - around, 0); y <= std::min(j + around, height - 1); ++y)
        for (Eigen::Index x = std::max<Eigen::Index>(i - around, 0); x <= std::min(i + around, width - 1);
             ++x)
          distances.values(x, y) =
              std::min(distances.values(x, y),
                       map.cell * std::sqrt(static_cast<double>((x - i) * (x - i) + (y - j) * (y - j))));
    }
  // <todo>
  //| // TODO: which cells are nearer to an occupied cell than `reach`?
  // </solution>
  return distances;
}

double valueAt(const Grid& grid, const Eigen::Vector2d& p) {
  // <solution valueAt>
  const Eigen::Vector2d share = ((p - grid.origin) / grid.cell).array() - .5;
  const double x = std::clamp(share[0], 0., static_cast<double>(grid.values.rows() - 1)),
               y = std::clamp(share[1], 0., static_cast<double>(grid.values.cols() - 1));
  const Eigen::Index i = std::min(static_cast<Eigen::Index>(x), grid.values.rows() - 2),
                     j = std::min(static_cast<Eigen::Index>(y), grid.values.cols() - 2);
  const double a = x - static_cast<double>(i), b = y - static_cast<double>(j);
  return (1 - b) * ((1 - a) * grid.values(i, j) + a * grid.values(i + 1, j)) +
         b * ((1 - a) * grid.values(i, j + 1) + a * grid.values(i + 1, j + 1));
  // <todo>
  //| // TODO: the centre of cell (0, 0) is half a cell from the origin. Which four centres are around p?
  //| return 0;
  // </solution>
}

double fit(const Grid& distances, const Eigen::Vector3d& pose, const Scan& scan, double deviation) {
  // <solution fit>
  double sum = 0;
  for (Eigen::Index ray = 0; ray < scan.angles.size(); ++ray) {
    if (scan.ranges[ray] >= scan.maxRange) continue;
    const double direction = pose[2] + scan.angles[ray];
    const double d = valueAt(distances, {pose[0] + scan.ranges[ray] * std::cos(direction),
                                         pose[1] + scan.ranges[ray] * std::sin(direction)});
    sum += d * d;
  }
  return -sum / (2 * deviation * deviation);
  // <todo>
  //| // TODO: where do the rays end, seen from this pose, and how far from a wall is that?
  //| return 0;
  // </solution>
}

Eigen::Vector3d matched(const Grid& distances, const Scan& scan, double deviation,
                        const Eigen::Vector3d& guess, const Eigen::Vector2d& window) {
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
  // A coarse search, so that no small hill near the guess is taken for the summit; then uphill.
  for (int n = 0; n < 125; ++n)
    take(guess + 2. / 5 * Eigen::Vector3d(n % 5 - 2, n / 5 % 5 - 2, n / 25 - 2).cwiseProduct(half));
  for (double part = 1. / 5; part > .01;) {
    bool isBetter = false;
    for (int n = 0; n < 6; ++n) {
      Eigen::Vector3d pose = best;
      pose[n / 2] += (n % 2 == 0 ? part : -part) * half[n / 2];
      isBetter = take(pose) || isBetter;
    }
    if (!isBetter) part /= 2;
  }
  return best;
  // <todo>
  //| // TODO: try poses around the guess, and around the best one so far in smaller and smaller steps.
  //| return guess;
  // </solution>
}

Eigen::Matrix3Xd moved(const Eigen::Vector3d& pose, const Eigen::Vector3d& motion,
                       const Eigen::Vector3d& deviations, int count, Rng& rng) {
  Eigen::Matrix3Xd poses = pose.replicate(1, count);
  // <solution moved>
  const double cosine = std::cos(pose[2]), sine = std::sin(pose[2]);
  for (int k = 0; k < count; ++k) {
    Eigen::Vector3d way = motion;
    for (int i = 0; i < 3; ++i) way[i] += deviations[i] * rng.normal();
    poses.col(k) += Eigen::Vector3d(cosine * way[0] - sine * way[1], sine * way[0] + cosine * way[1], way[2]);
  }
  // <todo>
  //| // TODO: add noise to the motion, and turn it into the world frame.
  // </solution>
  return poses;
}

Eigen::VectorXd weightsOf(const std::vector<Particle>& particles) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(particles.size()));
  // <solution weightsOf>
  for (std::size_t i = 0; i < particles.size(); ++i)
    weights[static_cast<Eigen::Index>(i)] = particles[i].logWeight;
  weights = (weights.array() - weights.maxCoeff()).exp().eval();
  weights /= weights.sum();
  // <todo>
  //| // TODO: exp(), in a way that never divides zero by zero.
  //| weights.setZero();
  // </solution>
  return weights;
}

double effectiveSize(const Eigen::VectorXd& weights) {
  // <solution effectiveSize>
  return 1 / weights.squaredNorm();
  // <todo>
  //| // TODO
  //| return 0;
  // </solution>
}

std::vector<Particle> resampled(const std::vector<Particle>& particles, Rng& rng) {
  std::vector<Particle> copies;
  // <solution resampled>
  const Eigen::VectorXd shares = weightsOf(particles);
  const auto count = static_cast<double>(particles.size());
  // Points one apart, along a line on which particle i is N weight_i long.
  double point = rng.uniform(), end = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    end += count * shares[static_cast<Eigen::Index>(i)];
    const bool isLast = i + 1 == particles.size();
    for (; copies.size() < particles.size() && (isLast || point < end); point += 1)
      copies.push_back({particles[i].path, particles[i].map, 0});
  }
  // <todo>
  //| // TODO: how often each particle occurs: one random number is enough for all.
  //| copies = particles;
  // </solution>
  return copies;
}

std::vector<Particle> slamStep(const std::vector<Particle>& particles, const Eigen::Vector3d& motion,
                               const Scan& scan, const Settings& settings, Rng& rng) {
  std::vector<Particle> after = particles;
  // <solution slamStep>
  for (Particle& particle : after) {
    Eigen::Vector3d pose = moved(particle.path.back(), motion, settings.odometry, 1, rng).col(0);
    const Grid distances = wallDistances(particle.map, settings.reach);
    if (settings.matches) pose = matched(distances, scan, settings.deviation, pose, settings.window);
    particle.logWeight += fit(distances, pose, scan, settings.deviation) / settings.temper;
    particle.path.push_back(pose);
    particle.map = observed(particle.map, pose, scan, settings.evidence);
  }
  // <todo>
  //| // TODO: for each particle: a pose, what the scan says about it, and the map.
  // </solution>
  return after;
}

Mapped mapped(const Log& log, const Grid& empty, const Settings& settings, int count, Rng& rng) {
  std::vector<Particle> particles(static_cast<std::size_t>(count), Particle{{log.start}, empty, 0});
  std::vector<double> sizes;
  // <solution mapped>
  for (Particle& one : particles) one.map = observed(empty, log.start, log.scans[0], settings.evidence);
  for (std::size_t t = 0; t < log.motions.size(); ++t) {
    // Before the next step, so that the weights of the last one tell which particle is best.
    if (!sizes.empty() && sizes.back() < settings.threshold * count) particles = resampled(particles, rng);
    particles = slamStep(particles, log.motions[t], log.scans[t + 1], settings, rng);
    sizes.push_back(effectiveSize(weightsOf(particles)));
  }
  // <todo>
  //| // TODO: the first scan, then step after step, with particles resampled where they are too unequal.
  // </solution>
  const auto best =
      std::max_element(particles.begin(), particles.end(),
                       [](const Particle& a, const Particle& b) { return a.logWeight < b.logWeight; });
  return {best->path, best->map, sizes};
}

Eigen::Vector3d located(const Grid& map, const Scan& scan, const Settings& settings) {
  // <solution located>
  // Wide enough that a pose half a cell beside the right one still fits better than most.
  const Grid wide = wallDistances(map, 2 * settings.reach), distances = wallDistances(map, settings.reach);
  std::vector<std::pair<double, Eigen::Vector3d>> candidates;
  for (Eigen::Index i = 0; i < map.values.rows(); i += 2)
    for (Eigen::Index j = 0; j < map.values.cols(); j += 2)
      for (int k = 0; k < 36 && map.values(i, j) < 0; ++k) {
        const Eigen::Vector3d coarse(map.origin[0] + map.cell * (static_cast<double>(i) + .5),
                                     map.origin[1] + map.cell * (static_cast<double>(j) + .5),
                                     std::acos(-1) / 18 * k);
        candidates.emplace_back(fit(wide, coarse, scan, 2 * settings.deviation), coarse);
      }
  std::sort(candidates.begin(), candidates.end(),
            [](const auto& one, const auto& other) { return one.first > other.first; });
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double score = -1e300;
  for (std::size_t k = 0; k < std::min<std::size_t>(candidates.size(), 30); ++k) {
    const Eigen::Vector3d match =
        matched(distances, scan, settings.deviation, candidates[k].second, {1.5 * map.cell, .15});
    const double value = fit(distances, match, scan, settings.deviation);
    if (value > score) best = match, score = value;
  }
  return best;
  // <todo>
  //| // TODO: which free cell, with which heading, fits best? Then match.
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  const Office office = officeOfShow();
  // Part 1: one scan, and the map if all poses were known.
  showScan(office);
  // Part 2: how far walls are, and how well a scan fits around its true pose.
  showFit(office);
  // Part 3: from which guesses the match converges to the true pose.
  showMatches(office);
  // Part 4: maps by odometry, by particles, and the truth; a film of how one grows.
  showMaps(office);
  // Part 5: a robot that wakes up anywhere.
  showAnywhere(office);
}
