#include "estimation/scan_matching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/require.h"
#include "estimation/pose_edge_internal.h"
#include "estimation/range_scan_internal.h"
#include "estimation/scan_checks_internal.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

// A straight wall fitted to neighbours of a scan: the distance of x from it is n . (x - center).
struct Wall {
  int first = 0, last = -1;  // the neighbours; if there are none, no wall
  Eigen::Vector2d center = Eigen::Vector2d::Zero(), n = Eigen::Vector2d::Zero();
  double spread = 0;  // sum of squares of the neighbours along the wall
  bool isWall() const { return last >= first; }
  Eigen::Vector2d along() const { return {-n.y(), n.x()}; }
};

constexpr int kNeighbours = 4;  // to each side

Wall fitWall(const Eigen::Matrix2Xd& points, int first, int last, double deviation) {
  Wall wall{first, last};
  const int count = last - first + 1;
  for (int i = first; i <= last; ++i) wall.center += points.col(i);
  wall.center /= count;
  double xx = 0, xy = 0, yy = 0;
  for (int i = first; i <= last; ++i) {
    const Eigen::Vector2d offset = points.col(i) - wall.center;
    xx += offset.x() * offset.x();
    xy += offset.x() * offset.y();
    yy += offset.y() * offset.y();
  }
  // The eigenvectors of [xx xy; xy yy] point along and across the wall.
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy), half = std::hypot(0.5 * (xx - yy), xy);
  wall.n = {-std::sin(angle), std::cos(angle)};
  wall.spread = 0.5 * (xx + yy) + half;
  // Corners are not straight, and points in a clump have no direction.
  const double off = std::sqrt(std::max(0., 0.5 * (xx + yy) - half) / count);
  const bool isStraight = off < 2 * deviation && std::sqrt(wall.spread / count) > 3 * std::max(off, 1e-6);
  if (!isStraight) wall.last = first - 1;
  return wall;
}

std::vector<Wall> wallsOf(const Eigen::Matrix2Xd& points, const ScanMatchOptions& options) {
  std::vector<Wall> walls(static_cast<std::size_t>(points.cols()));
  const int count = static_cast<int>(points.cols());
  const auto isGap = [&](int i) { return (points.col(i + 1) - points.col(i)).norm() > options.maxGap; };
  for (int i = 0; i < count; ++i) {
    int first = i, last = i;
    while (first > 0 && i - first < kNeighbours && !isGap(first - 1)) --first;
    while (last + 1 < count && last - i < kNeighbours && !isGap(last)) ++last;
    if (last - first >= 2)
      walls[static_cast<std::size_t>(i)] = fitWall(points, first, last, options.deviation);
  }
  return walls;
}

// A moving point x (in the frame of the reference), the wall it belongs to, and how far it is from it.
struct Partner {
  int point = 0, wall = 0;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  double distance = 0, weight = 1;
};

// The normal equations of all partners for steps u: a shift, and a turn about the mean of the points, times
// their radius, so that all three are metres.
struct Equations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double radius = 1;

  Eigen::Vector3d slope(const Wall& wall, const Eigen::Vector2d& x) const {
    const Eigen::Vector2d arm = (x - mean) / radius;
    return {wall.n.x(), wall.n.y(), wall.n.y() * arm.x() - wall.n.x() * arm.y()};
  }
  // What a step u does to a motion: change of x, y and heading.
  Eigen::Matrix3d toMotion(const Eigen::Vector3d& motion) const {
    Eigen::Matrix3d S = Eigen::Matrix3d::Identity();
    const Eigen::Vector2d arm = (motion.head<2>() - mean) / radius;
    S.col(2) << -arm.y(), arm.x(), 1 / radius;
    return S;
  }
};

class Alignment {
 public:
  Alignment(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
            const ScanMatchOptions& options)
      : reference_(reference), moving_(moving), options_(options), walls_(wallsOf(reference, options)) {}

  ScanMatch run(const Eigen::Vector3d& guess) {
    ScanMatch match;
    match.motion = guess;
    bool isSettled = false;  // then partners stay, so that the last steps cannot jump to and fro
    for (; match.iterations < options_.maxIterations; ++match.iterations) {
      isSettled ? place(match.motion) : findPartners(match.motion);
      if (partners_.size() < 3) return tooFew(match, guess);
      const Equations equations = weigh();
      const Eigen::Vector3d u = step(equations);
      move(match.motion, equations, u);
      if (u.norm() < 1e-9) break;
      isSettled = isSettled || u.norm() < 0.1 * options_.deviation;
    }
    return report(match, guess);
  }

 private:
  void findPartners(const Eigen::Vector3d& motion) {
    partners_.clear();
    lost_ = 0;
    const Eigen::Matrix2d R = internal::planarRotation(motion[2]);
    for (int k = 0; k < moving_.cols(); ++k) {
      const Eigen::Vector2d x = R * moving_.col(k) + motion.head<2>();
      Eigen::Index nearest = 0;
      const double squared = (reference_.colwise() - x).colwise().squaredNorm().minCoeff(&nearest);
      if (squared > options_.maxDistance * options_.maxDistance)
        ++lost_;
      else if (walls_[static_cast<std::size_t>(nearest)].isWall())
        partners_.push_back({k, static_cast<int>(nearest), x, 0, 1});
    }
    measure();
  }

  void place(const Eigen::Vector3d& motion) {
    const Eigen::Matrix2d R = internal::planarRotation(motion[2]);
    for (Partner& partner : partners_) partner.x = R * moving_.col(partner.point) + motion.head<2>();
    measure();
  }

  void measure() {
    for (Partner& partner : partners_) {
      const Wall& wall = wallOf(partner);
      partner.distance = wall.n.dot(partner.x - wall.center);
    }
  }

  const Wall& wallOf(const Partner& partner) const { return walls_[static_cast<std::size_t>(partner.wall)]; }

  // The scale of the weights follows the median distance down to what noise explains.
  Equations weigh() {
    std::vector<double> sizes;
    for (const Partner& partner : partners_) sizes.push_back(std::abs(partner.distance));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double scale = std::max(3 * *middle, 4 * options_.deviation);
    Equations equations;
    double sum = 0, squares = 0;
    for (Partner& partner : partners_) {
      const double ratio = partner.distance / scale;
      partner.weight = 1 / ((1 + ratio * ratio) * (1 + ratio * ratio));
      equations.mean += partner.weight * partner.x;
      sum += partner.weight;
    }
    equations.mean /= sum;
    for (const Partner& partner : partners_)
      squares += partner.weight * (partner.x - equations.mean).squaredNorm();
    equations.radius = std::max(std::sqrt(squares / sum), 1e-6);
    for (const Partner& partner : partners_) {
      const Eigen::Vector3d slope = equations.slope(wallOf(partner), partner.x);
      const Eigen::Vector3d weighted = partner.weight * slope;
      equations.H += weighted * slope.transpose();
      equations.g += partner.weight * partner.distance * slope;
    }
    return equations;
  }

  static Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axesOf(const Equations& equations) {
    const Eigen::MatrixXd H = equations.H;
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H);
  }

  // Eigenvectors of H that are seen, one per column. Products of whole matrices of dynamic size are compiled
  // already.
  Eigen::MatrixXd seen(const Equations& equations) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes = axesOf(equations);
    int unseen = 0;
    while (unseen < 2 && axes.eigenvalues()[unseen] < options_.leastShare * axes.eigenvalues()[2]) ++unseen;
    return axes.eigenvectors().rightCols(3 - unseen);
  }

  Eigen::Vector3d step(const Equations& equations) const {
    const Eigen::MatrixXd V = seen(equations), whole = equations.H, HV = whole * V, H = V.transpose() * HV;
    const Eigen::MatrixXd slope = equations.g, g = V.transpose() * slope, along = H.ldlt().solve(g);
    const Eigen::MatrixXd u = V * along;
    return -u;
  }

  static void move(Eigen::Vector3d& motion, const Equations& equations, const Eigen::Vector3d& u) {
    const double turn = u[2] / equations.radius;
    const Eigen::Vector2d arm = motion.head<2>() - equations.mean;
    motion.head<2>() = equations.mean + internal::planarRotation(turn) * arm + u.head<2>();
    motion[2] = wrapAngle(motion[2] + turn);
  }

  // The covariance of u, from how the minimum moves with each range of both scans; all ranges have the same
  // noise.
  Eigen::Matrix3d scatter(const Equations& equations, double heading) const {
    Eigen::MatrixXd byRange = Eigen::MatrixXd::Zero(3, reference_.cols());
    Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
    const Eigen::Matrix2d R = internal::planarRotation(heading);
    for (const Partner& partner : partners_) {
      const Wall& wall = wallOf(partner);
      const Eigen::Vector3d a = partner.weight * equations.slope(wall, partner.x);
      const double cosine = wall.n.dot(R * moving_.col(partner.point).normalized());
      const Eigen::Vector3d change = cosine * cosine * a;
      M += change * a.transpose();
      const double way = wall.along().dot(partner.x - wall.center);
      for (int j = wall.first; j <= wall.last; ++j) {
        const double share = 1. / (wall.last - wall.first + 1) +
                             way * wall.along().dot(reference_.col(j) - wall.center) / wall.spread;
        byRange.col(j) -= share * wall.n.dot(reference_.col(j).normalized()) * a;
      }
    }
    const Eigen::MatrixXd ofRanges = byRange * std::as_const(byRange).transpose();
    return options_.deviation * options_.deviation * (M + ofRanges);
  }

  void addInformation(ScanMatch& match, const Equations& equations) const {
    const Eigen::MatrixXd V = seen(equations), whole = equations.H, HV = whole * V, H = V.transpose() * HV;
    const Eigen::MatrixXd moved = scatter(equations, match.motion[2]), MV = moved * V, M = V.transpose() * MV;
    // Walls seen edge on add no noise: keep M invertible.
    const double least = 1e-9 * M.trace() + 1e-300;
    const Eigen::MatrixXd noise = M + least * Eigen::MatrixXd::Identity(M.rows(), M.cols());
    const Eigen::Matrix3d S = equations.toMotion(match.motion);
    Eigen::Matrix3d E = Eigen::Matrix3d::Identity();  // from the error of an edge to the change of the motion
    E.topLeftCorner<2, 2>() = internal::planarRotation(match.motion[2]);
    // As a square, so that rounding leaves no negative eigenvalue if a direction is not seen.
    const Eigen::LLT<Eigen::MatrixXd> root(noise);
    const Eigen::MatrixXd fromMotion = S.inverse(), turned = E, change = fromMotion * turned;
    const Eigen::MatrixXd HVt = H * V.transpose(), weighted = HVt * change;
    const Eigen::MatrixXd F = root.matrixL().solve(weighted), information = F.transpose() * F;
    match.information = information;
    if (V.cols() == 3) return;
    const Eigen::Vector3d axis = axesOf(equations).eigenvectors().col(0);
    match.unseen = S * axis;
    match.unseen.normalize();
    Eigen::Index largest = 0;
    match.unseen.cwiseAbs().maxCoeff(&largest);
    if (match.unseen[largest] < 0) match.unseen = -match.unseen;
  }

  ScanMatch report(ScanMatch& match, const Eigen::Vector3d& guess) {
    findPartners(match.motion);
    if (partners_.size() < 3) return tooFew(match, guess);
    const Equations equations = weigh();
    addInformation(match, equations);
    double squares = 0;
    int fits = 0;
    for (const Partner& partner : partners_)
      if (std::abs(partner.distance) < 4 * options_.deviation) {
        squares += partner.distance * partner.distance;
        ++fits;
      }
    match.residual = std::sqrt(squares / std::max(1, fits));
    match.overlap = static_cast<double>(fits) / (static_cast<double>(partners_.size()) + lost_);
    if (match.iterations >= options_.maxIterations) {
      match.message = fmt::format("not converged in {} iterations", match.iterations);
    } else if (match.unseen.norm() > 0) {
      match.status = ScanMatchStatus::kUnobservable;
      match.message =
          fmt::format("the scans do not determine the motion along x, y, heading = ({:.3f}, {:.3f}, {:.3f})",
                      match.unseen[0], match.unseen[1], match.unseen[2]);
    } else {
      match.status = ScanMatchStatus::kConverged;
      match.message = fmt::format("converged: {:.1f} mm from the walls", 1e3 * match.residual);
    }
    return match;
  }

  ScanMatch tooFew(ScanMatch& match, const Eigen::Vector3d& guess) const {
    match.status = ScanMatchStatus::kTooFewPoints;
    match.motion = guess;
    match.message = fmt::format("{} of {} points lie near a straight wall of the other scan; at least 3 must",
                                partners_.size(), moving_.cols());
    return match;
  }

  const Eigen::Matrix2Xd &reference_, &moving_;
  const ScanMatchOptions& options_;
  std::vector<Wall> walls_;
  std::vector<Partner> partners_{};
  int lost_ = 0;  // points with nothing nearby
};

}  // namespace

void internal::requireScans(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                            const Eigen::Vector3d& guess, const ScanMatchOptions& options) {
  for (const Eigen::Matrix2Xd* scan : {&reference, &moving})
    for (Eigen::Index k = 0; k < scan->cols(); ++k)
      if (!scan->col(k).allFinite())
        requireFinite(fmt::format("{} scan: point {}", scan == &reference ? "reference" : "moving", k),
                      scan->col(k));
  requireFinite("guess of the motion", guess);
  requirePositive("matching scans: deviation", options.deviation, kMetres);
  requirePositive("matching scans: maxDistance", options.maxDistance, kMetres);
  requirePositive("matching scans: maxGap", options.maxGap, kMetres);
  requirePositive("matching scans: leastShare", options.leastShare);
  requireCount("matching scans: maxIterations", options.maxIterations, 1);
}

Eigen::Matrix2Xd scanPoints(const RangeScanner& scanner, const VectorArg& ranges) {
  internal::requireRanges(scanner, ranges);
  Eigen::Matrix2Xd points(2, ranges.size());
  int count = 0;
  for (Eigen::Index i = 0; i < ranges.size(); ++i) {
    if (ranges[i] >= scanner.maxRange) continue;
    const double angle = scanner.angles[static_cast<std::size_t>(i)];
    points.col(count++) = ranges[i] * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  points.conservativeResize(2, count);
  return points;
}

ScanMatch alignScans(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                     const Eigen::Vector3d& guess, const ScanMatchOptions& options) {
  internal::requireScans(reference, moving, guess, options);
  if (reference.cols() < 3 || moving.cols() < 3) {
    ScanMatch match;
    match.status = ScanMatchStatus::kTooFewPoints;
    match.motion = guess;
    match.message =
        fmt::format("scans of {} and {} points; at least 3 are needed", reference.cols(), moving.cols());
    return match;
  }
  return Alignment(reference, moving, options).run(guess);
}

}  // namespace rex
