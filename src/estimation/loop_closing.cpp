#include "estimation/loop_closing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "estimation/pose_edge_internal.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

constexpr Eigen::Index kMostPoses = 2000;

Eigen::Vector3d composed(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Vector3d c;
  c.head<2>() = a.head<2>() + internal::planarRotation(a[2]) * b.head<2>();
  c[2] = wrapAngle(a[2] + b[2]);
  return c;
}

Eigen::Vector3d inverted(const Eigen::Vector3d& a) {
  Eigen::Vector3d c;
  c.head<2>() = -(internal::planarRotation(-a[2]) * a.head<2>());
  c[2] = -a[2];
  return c;
}

// A motion with the covariance of its small error in its own end frame: X (1 + error).
struct UncertainMotion {
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

// Maps an error at the start of `motion` to the one at its end: Ad of the inverse.
Eigen::Matrix3d carriedThrough(const Eigen::Vector3d& motion) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  A.topLeftCorner<2, 2>() = internal::planarRotation(-motion[2]);
  A.topRightCorner<2, 1>() = internal::planarRotation(-motion[2]) * Eigen::Vector2d(-motion[1], motion[0]);
  return A;
}

UncertainMotion operator*(const UncertainMotion& a, const UncertainMotion& b) {
  const Eigen::Matrix3d A = carriedThrough(b.motion);
  return {composed(a.motion, b.motion), A * a.covariance * A.transpose() + b.covariance};
}

UncertainMotion inverse(const UncertainMotion& a) {
  const Eigen::Matrix3d A = carriedThrough(inverted(a.motion));
  return {inverted(a.motion), A * a.covariance * A.transpose()};
}

double squaredMahalanobis(const UncertainMotion& cycle) {
  const Eigen::MatrixXd P = cycle.covariance;
  const Eigen::VectorXd x = cycle.motion, weighted = P.ldlt().solve(x);
  return x.dot(weighted);
}

// The motions between all pairs of poses along the chain, from the earlier to the later.
class Chain {
 public:
  explicit Chain(const std::vector<UncertainMotion>& links) : count_(links.size() + 1) {
    motions_.resize(count_ * count_);
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = i + 1; j < count_; ++j)
        motions_[i * count_ + j] = motions_[i * count_ + j - 1] * links[j - 1];
  }

  UncertainMotion between(int from, int to) const {
    const auto i = static_cast<std::size_t>(from), j = static_cast<std::size_t>(to);
    return i <= j ? motions_[i * count_ + j] : inverse(motions_[j * count_ + i]);
  }

 private:
  std::size_t count_;
  std::vector<UncertainMotion> motions_;
};

void requireChain(const PlanarPoseGraph& odometry, std::size_t scans) {
  const Eigen::Index poses = odometry.poses.cols();
  if (poses < 1 || poses > kMostPoses || static_cast<Eigen::Index>(odometry.edges.size()) != poses - 1)
    throw Error({.what = "closing loops: graph of odometry",
                 .found = fmt::format("{} poses and {} edges", poses, odometry.edges.size()),
                 .wanted = fmt::format("1 to {} poses, and one edge from each to the next", kMostPoses)});
  if (static_cast<Eigen::Index>(scans) != poses)
    throw Error({.what = "closing loops: scans",
                 .found = fmt::format("{}", scans),
                 .wanted = fmt::format("{}, one for each pose", poses)});
  internal::requireSound(odometry);
  for (std::size_t k = 0; k < odometry.edges.size(); ++k) {
    const PlanarEdge& edge = odometry.edges[k];
    if (edge.from != static_cast<int>(k) || edge.to != edge.from + 1)
      throw Error({.what = fmt::format("closing loops: edge {}", k),
                   .found = fmt::format("one from {} to {}", edge.from, edge.to),
                   .wanted = fmt::format("one from {} to {}", k, k + 1)});
    const Eigen::MatrixXd information = edge.information;
    if (information.llt().info() != Eigen::Success)
      throw Error({.what = fmt::format("closing loops: edge {}", k),
                   .found = "information that is not positive definite",
                   .wanted = "odometry that determines x, y and heading"});
  }
}

void requireOptions(const LoopOptions& options) {
  if (options.radius > 0 && std::isfinite(options.radius) && options.leastGap >= 2 &&
      options.candidates >= 1 && options.leastOverlap >= 0 && options.leastOverlap <= 1 && options.bound > 0)
    return;
  throw Error(
      {.what = "closing loops: options",
       .found = fmt::format("radius {:g}, leastGap {}, candidates {}, leastOverlap {:g}, bound {:g}",
                            options.radius, options.leastGap, options.candidates, options.leastOverlap,
                            options.bound),
       .wanted = "a radius and a bound above 0, leastGap >= 2, candidates >= 1, an overlap of 0 to 1"});
}

bool isMatch(const ScanMatch& match) { return match.status == ScanMatchStatus::kConverged; }

// The small error of b as seen from a, with both covariances.
UncertainMotion difference(const UncertainMotion& a, const UncertainMotion& b) { return inverse(a) * b; }

// Fuses a measured motion with that of a scan, each weighted by its information; adds the edge of the scan to
// the graph if it fits.
UncertainMotion linkWithScans(PlanarPoseGraph& graph, const PlanarEdge& edge, const ScanMatch& match,
                              const LoopOptions& options) {
  const UncertainMotion odometry{edge.motion, edge.information.inverse()};
  const bool isUsable = isMatch(match) || match.status == ScanMatchStatus::kUnobservable;
  if (!isUsable || match.overlap < options.leastOverlap) return odometry;
  // From odometry towards the scan, as far as the scan determines the motion.
  const Eigen::Vector3d apart = composed(inverted(edge.motion), match.motion);
  const Eigen::Matrix3d sum = edge.information + match.information;
  const Eigen::Matrix3d covariance = sum.inverse();
  const Eigen::Vector3d step = covariance * (match.information * apart);
  const double squared = apart.dot(edge.information * step);
  if (squared > options.bound) return odometry;
  graph.edges.push_back({edge.from, edge.to, match.motion, match.information});
  return {composed(edge.motion, step), covariance};
}

// Earlier poses that may be near pose j, nearest first, and no two of them next to each other.
std::vector<int> nearbyPoses(const Chain& chain, int j, const LoopOptions& options) {
  std::vector<std::pair<double, int>> near;
  for (int i = 0; i + options.leastGap <= j; ++i) {
    const UncertainMotion between = chain.between(i, j);
    const double distance = between.motion.head<2>().norm();
    const double deviation = std::sqrt(between.covariance.topLeftCorner<2, 2>().trace());
    if (distance < options.radius + 2 * deviation) near.emplace_back(distance, i);
  }
  std::sort(near.begin(), near.end());
  std::vector<int> chosen;
  for (const auto& [distance, i] : near) {
    const bool isFar =
        std::all_of(chosen.begin(), chosen.end(), [&, i = i](int other) { return std::abs(other - i) > 2; });
    if (isFar && static_cast<int>(chosen.size()) < options.candidates) chosen.push_back(i);
  }
  return chosen;
}

LoopCandidate tried(const Chain& chain, const std::vector<Eigen::Matrix2Xd>& scans, int i, int j,
                    const LoopOptions& options) {
  LoopCandidate loop{.from = i, .to = j};
  const UncertainMotion between = chain.between(i, j);
  const SearchWindow window{
      std::min(5., 0.5 + 3 * std::sqrt(between.covariance.topLeftCorner<2, 2>().trace() / 2)),
      std::min(1.5, 0.1 + 3 * std::sqrt(between.covariance(2, 2)))};
  loop.match = searchAlignment(scans[static_cast<std::size_t>(i)], scans[static_cast<std::size_t>(j)],
                               between.motion, window, options.matching);
  if (!isMatch(loop.match)) {
    loop.reason = loop.match.message;
    return loop;
  }
  if (loop.match.overlap < options.leastOverlap) {
    loop.verdict = LoopVerdict::kLittleOverlap;
    loop.reason = fmt::format("{:.0f} % of the points fit", 100 * loop.match.overlap);
    return loop;
  }
  loop.mahalanobis =
      squaredMahalanobis(difference(between, {loop.match.motion, loop.match.information.inverse()}));
  const bool isLikely = loop.mahalanobis <= options.bound;
  loop.verdict = isLikely ? LoopVerdict::kAccepted : LoopVerdict::kUnlikely;
  if (!isLikely)
    loop.reason = fmt::format("{:.1f} deviations from the motions in between", std::sqrt(loop.mahalanobis));
  return loop;
}

// Whether two loops agree: along one, then the chain, back along the other, and the chain again.
bool doAgree(const Chain& chain, const LoopCandidate& a, const LoopCandidate& b, double bound) {
  const UncertainMotion there{a.match.motion, a.match.information.inverse()},
      back{b.match.motion, b.match.information.inverse()};
  const UncertainMotion direct = chain.between(b.from, a.from) * there * chain.between(a.to, b.to);
  return squaredMahalanobis(difference(direct, back)) <= bound;
}

void keepAgreeing(const Chain& chain, std::vector<LoopCandidate>& candidates, double bound) {
  std::vector<LoopCandidate*> loops;
  for (LoopCandidate& candidate : candidates)
    if (candidate.verdict == LoopVerdict::kAccepted) loops.push_back(&candidate);
  const auto count = static_cast<Eigen::Index>(loops.size());
  Eigen::Matrix<bool, -1, -1> agree(count, count);
  for (Eigen::Index a = 0; a < count; ++a)
    for (Eigen::Index b = 0; b <= a; ++b)
      agree(a, b) = agree(b, a) = a == b || doAgree(chain, *loops[static_cast<std::size_t>(a)],
                                                    *loops[static_cast<std::size_t>(b)], bound);
  std::vector<bool> isKept(loops.size());
  const std::vector<int> kept = agreeingSet(agree);
  for (const int k : kept) isKept[static_cast<std::size_t>(k)] = true;
  for (std::size_t k = 0; k < loops.size(); ++k)
    if (!isKept[k]) {
      loops[k]->verdict = LoopVerdict::kInconsistent;
      loops[k]->reason = fmt::format("contradicts a larger set of {} loops", kept.size());
    }
}

}  // namespace

std::vector<int> agreeingSet(const Eigen::Matrix<bool, -1, -1>& agree) {
  if (agree.rows() != agree.cols() || agree != agree.transpose())
    throw Error({.what = "agreeing set",
                 .found = fmt::format("a {} x {} matrix", agree.rows(), agree.cols()),
                 .wanted = "a square and symmetric one"});
  std::vector<int> order(static_cast<std::size_t>(agree.rows())), best;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return agree.col(a).count() > agree.col(b).count(); });
  for (const int first : order) {
    std::vector<int> set{first};
    for (const int next : order) {
      const bool fits =
          next != first && std::all_of(set.begin(), set.end(), [&](int k) { return agree(k, next); });
      if (fits) set.push_back(next);
    }
    if (set.size() > best.size()) best = set;
  }
  std::sort(best.begin(), best.end());
  return best;
}

LoopClosing closeLoops(const PlanarPoseGraph& odometry, const std::vector<Eigen::Matrix2Xd>& scans,
                       const LoopOptions& options) {
  requireChain(odometry, scans.size());
  requireOptions(options);
  LoopClosing result{.graph = odometry};
  PlanarPoseGraph& graph = result.graph;
  std::vector<UncertainMotion> links;
  for (std::size_t k = 0; k < odometry.edges.size(); ++k) {
    const PlanarEdge& edge = odometry.edges[k];
    const ScanMatch match = alignScans(scans[k], scans[k + 1], edge.motion, options.matching);
    links.push_back(linkWithScans(graph, edge, match, options));
    graph.poses.col(edge.to) = composed(graph.poses.col(edge.from), links.back().motion);
  }
  const Chain chain(links);
  for (int j = 0; j < static_cast<int>(graph.poses.cols()); ++j)
    for (const int i : nearbyPoses(chain, j, options))
      result.candidates.push_back(tried(chain, scans, i, j, options));
  keepAgreeing(chain, result.candidates, options.bound);
  for (const LoopCandidate& loop : result.candidates)
    if (loop.verdict == LoopVerdict::kAccepted) {
      graph.edges.push_back({loop.from, loop.to, loop.match.motion, loop.match.information});
      ++result.accepted;
    }
  return result;
}

}  // namespace rex
