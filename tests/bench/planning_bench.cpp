#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/rng.h"
#include "bench/ompl_peer.h"
#include "bench/row.h"
#include "planning/dubins.h"
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

}  // namespace

std::vector<Row> planningRows() {
  const auto poses = std::make_shared<const std::vector<Eigen::Vector3d>>(randomPoses());
  const auto dubins = [](const auto& from, const auto& to) { return dubinsLength(from, to, 1); };
  const auto reedsShepp = [](const auto& from, const auto& to) { return reedsSheppLength(from, to, 1); };
  const CurvePeer ompl = omplCurvePeer();
  requireSame(*poses, dubins, ompl.dubins);
  requireSame(*poses, reedsShepp, ompl.reedsShepp);
  return {{"dubins", perWay(poses, dubins), "OMPL", perWay(poses, ompl.dubins), 0.3},
          {"reeds-shepp", perWay(poses, reedsShepp), "OMPL", perWay(poses, ompl.reedsShepp), 0.3}};
}

}  // namespace rex::bench
