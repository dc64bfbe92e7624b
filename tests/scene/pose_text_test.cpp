#include "scene/pose_text.h"

#include <numbers>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::pose_text_test {

TEST(PoseText, IsReadFromLeftToRight) {
  const Pose read = parsePose("<T t(1 2 3) d(90 0 0 1) t(1 0 0)>", "pose");
  const Pose wanted =
      translation(1, 2, 3) * rotation(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()) * translation(1, 0, 0);
  EXPECT_TRUE(isApprox(read, wanted, 1e-15));
  EXPECT_TRUE(isApprox(parsePose(" <T> # nowhere", "pose"), Pose{}, 0));
  EXPECT_TRUE(isApprox(parsePose("<T q(1e308 0 0 0) q(1e-308 0 0 0)>", "pose"), Pose{}, 0));
  EXPECT_TRUE(isApprox(parsePose("<T\n0 0 1 2 0 0 0>", "pose"), translation(0, 0, 1), 1e-15));
}

TEST(PoseText, ThatIsNoneIsRefused) {
  EXPECT_REX_ERROR(parsePose("", "hand"), "hand:1:1: not a pose: found nothing, wanted one pose <T ...>");
  EXPECT_REX_ERROR(parsePose(" [1 2]", "hand"), "hand:1:2: not a pose: found an array of 2");
  EXPECT_REX_ERROR(parsePose("rel=<T>", "hand"), "hand:1:1: not a pose: found 'rel'");
  EXPECT_REX_ERROR(parsePose("(a)<T>", "hand"), "hand:1:1: not a pose: found a pose <T ...>");
  EXPECT_REX_ERROR(parsePose("<T>\n<T>", "hand"), "hand:2:1: text after a pose: wanted one pose <T ...>");
  EXPECT_REX_ERROR(parsePose("<T t(1 2)>", "hand"), "hand:1:9: too few numbers in a pose");
  EXPECT_REX_ERROR(parsePose("<T t(1e308 0 0) t(1e308 0 0)>", "hand"),
                   "hand:1:1: pose: found a place farther than numbers reach, wanted metres");
}

}  // namespace rex::pose_text_test
