#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/rng.h"
#include "bench/arm_plans.h"
#include "bench/ompl_peer.h"
#include "bench/row.h"
#include "planning/dubins.h"
#include "planning/nearest_neighbors.h"
#include "planning/reeds_shepp.h"

namespace rex::bench {
namespace {

constexpr int kPoses = 1000;

std::vector<Eigen::Vector3d> randomPoses() {
  Rng rng(1);
  std::vector<Eigen::Vector3d> poses;
  for (int i = 0; i <= kPoses; ++i)
    poses.emplace_back(rng.uniform(-5, 5), rng.uniform(-5, 5),
                       rng.uniform(-std::numbers::pi, std::numbers::pi));
  return poses;
}

// The mean over ways from each pose to the next.
Measurement perWay(const std::shared_ptr<const std::vector<Eigen::Vector3d>>& poses,
                   const CurvePeer::Length& length) {
  if (!length) return {};
  const Measurement all = timed([=] {
    double sum = 0;
    for (std::size_t i = 0; i < kPoses; ++i) sum += length((*poses)[i], (*poses)[i + 1]);
    if (!(sum > 0)) throw std::logic_error("curves have no length");
  });
  return [all] { return all() / kPoses; };
}

void requireSame(const std::vector<Eigen::Vector3d>& poses, const CurvePeer::Length& a,
                 const CurvePeer::Length& b) {
  if (!b) return;
  for (std::size_t i = 0; i < kPoses; ++i)
    if (std::abs(a(poses[i], poses[i + 1]) - b(poses[i], poses[i + 1])) > 1e-9)
      throw std::logic_error("lengths of curves differ from ours");
}

// The nearest of 1000 points in seven dimensions, by the tree and by a look at all: the mean over many
// questions.
Row nearestRow() {
  constexpr int kDimension = 7, kPoints = 1000, kQuestions = 200;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(kDimension);
  const Space space = Space::box(-ones, ones);
  const auto tree = std::make_shared<NearestNeighbors>(space);
  Rng rng(2);
  Eigen::MatrixXd points(kDimension, kPoints), questions(kDimension, kQuestions);
  for (Eigen::Index k = 0; k < kPoints; ++k) {
    space.sample(rng, points.col(k));
    tree->add(points.col(k));
  }
  for (Eigen::Index k = 0; k < kQuestions; ++k) space.sample(rng, questions.col(k));
  const auto byTree = [=](Eigen::Index k) { return tree->nearest(questions.col(k)); };
  const auto byLook = [=](Eigen::Index k) {
    int nearest = 0;
    (points.colwise() - questions.col(k)).colwise().squaredNorm().minCoeff(&nearest);
    return nearest;
  };
  for (Eigen::Index k = 0; k < kQuestions; ++k)
    if (byTree(k) != byLook(k)) throw std::logic_error("the nearest point is another");
  const auto perQuestion = [](const auto& ask) -> Measurement {
    const Measurement all = timed([=] {
      long sum = 0;
      for (Eigen::Index k = 0; k < kQuestions; ++k) sum += ask(k);
      if (sum == 0) throw std::logic_error("all questions have the same answer");
    });
    return [all] { return all() / kQuestions; };
  };
  return {"nearest-7d", perQuestion(byTree), "look at all", perQuestion(byLook), 1.};
}

// A seed is soon done or takes long: medians need many.
Row connectRow(const std::string& name, const ArmPlan& plan, const ContactScene& scene, double target,
               int seeds) {
  return {name, ourConnect(plan), "OMPL+FCL", omplConnect(scene, plan), target, "ms", seeds, true};
}

}  // namespace

std::vector<Row> planningRows() {
  const auto poses = std::make_shared<const std::vector<Eigen::Vector3d>>(randomPoses());
  const auto dubins = [](const auto& from, const auto& to) { return dubinsLength(from, to, 1); };
  const auto reedsShepp = [](const auto& from, const auto& to) { return reedsSheppLength(from, to, 1); };
  const CurvePeer ompl = omplCurvePeer();
  const ContactScene scene;
  requireSame(*poses, dubins, ompl.dubins);
  requireSame(*poses, reedsShepp, ompl.reedsShepp);
  return {{"dubins", perWay(poses, dubins), "OMPL", perWay(poses, ompl.dubins), 0.3},
          {"reeds-shepp", perWay(poses, reedsShepp), "OMPL", perWay(poses, ompl.reedsShepp), 0.3},
          nearestRow(),
          connectRow("rrt-connect-tip", tipInHole(scene), scene, 0.1, 201),
          connectRow("rrt-connect-peg", pegInHole(scene), scene, 0.25, 41)};
}

}  // namespace rex::bench
