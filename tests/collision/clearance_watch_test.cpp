#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/motion_clearance.h"
#include "formats/scene_file.h"
#include "kinematics/forward_kinematics.h"
#include "physics/small_scenes.h"
#include "support/paths.h"

namespace rex::clearance_watch_test {

double smallestDistance(const Model& model, const ContactModel& contacts, const Eigen::VectorXd& q) {
  double smallest = 1;
  for (const Proxy& proxy : proxies(contacts, forwardKinematics(model, q), 1.))
    smallest = std::min(smallest, proxy.proximity.distance);
  return smallest;
}

// Along motions of an arm among its own parts, what is proven is asked of the exact distances, at the corners
// of the box in which q may be.
TEST(ClearanceWatch, ProvesOnlyWhatIsTrue) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  const ContactModel contacts(model);
  ClearanceWatch watch(model);
  ASSERT_TRUE(watch.isAble());
  constexpr double kReserve = 2e-3, kDistance = 5e-3;
  int proven = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    Eigen::VectorXd q = rng.uniformVector(model.nq(), -2.5, 2.5);
    const Eigen::VectorXd v = rng.uniformVector(model.nv(), -3, 3);
    for (int i = 0; i < 300; ++i, q += 5e-3 * v) {
      const bool isApart = watch.isApart(model, q, v, kReserve, kDistance);
      (isApart ? proven : refused) += 1;
      if (!isApart) continue;
      const Eigen::VectorXd corner =
          q + kReserve * v.cwiseProduct(rng.uniformVector(model.nv(), -1, 1).cwiseSign());
      ASSERT_GT(smallestDistance(model, contacts, corner), kDistance) << "seed " << seed << ", step " << i;
    }
  }
  EXPECT_GT(proven, 1000);
  EXPECT_GT(refused, 100);
}

TEST(ClearanceWatch, IsAsNewAfterAReset) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  ClearanceWatch used(model), fresh(model);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.nq());
  EXPECT_FALSE(used.isApart(model, zero, zero, 0, 10));    // nothing is so far away
  EXPECT_FALSE(used.isApart(model, zero, zero, 0, 1e-3));  // it does not measure for a while
  used.reset();
  EXPECT_TRUE(used.isApart(model, zero, zero, 0, 1e-3));
  EXPECT_TRUE(fresh.isApart(model, zero, zero, 0, 1e-3));
}

TEST(ClearanceWatch, CannotFollowWhatFlies) {
  SceneSpec spec;
  addLoose(spec, "ball", 1, ballShape(0.1), {});
  EXPECT_FALSE(ClearanceWatch(compile(spec)).isAble());
}

}  // namespace rex::clearance_watch_test
