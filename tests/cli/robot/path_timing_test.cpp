#include "cli/robot/path_timing.h"

#include <gtest/gtest.h>

#include "planning/robot_problem.h"
#include "scene/ors_reader.h"

namespace rex::cli::path_timing_test {

// Joints of which the first `limited` have limits of velocity and effort.
PathTask chain(int joints, int limited) {
  std::string text = "body b0 { mass=1 }\n";
  for (int i = 1; i <= joints; ++i)
    text += "body b" + std::to_string(i) + " { mass=1 }\njoint j" + std::to_string(i) + " (b" +
            std::to_string(i - 1) + " b" + std::to_string(i) + ") { type=hingeX limits=[-3 3] }\n";
  SceneSpec spec = parseOrs(text, "chain").spec;
  for (std::size_t i = 0; i < static_cast<std::size_t>(limited); ++i)
    spec.joints[i].maxVelocity = 2, spec.joints[i].maxEffort = 100;
  Model model = compile(spec);
  ContactModel contacts(model);
  PathProblem problem =
      robotProblem(model, contacts, Eigen::VectorXd::Zero(joints), Eigen::VectorXd::Ones(joints));
  return {std::move(model), std::move(contacts), std::move(problem)};
}

PathTiming timed(const PathTask& task, const PlanOptions& options) {
  FoundPath found;
  Eigen::MatrixXd path(task.model.nq(), 2);
  path << task.problem.start, task.problem.goal;
  found.curve = straightCurve(task.problem.space, path);
  return timingOf(task, options, found);
}

TEST(PathTiming, KeepsToTheScene) {
  const PathTask task = chain(1, 1);
  const PathTiming timing = timed(task, {.ramp = .25});
  ASSERT_TRUE(timing.isFound());
  EXPECT_NEAR(timing.result.motion.duration(), .5 + .25, 1e-3);
  EXPECT_EQ(assumptionsOf(timing, {}), "");
  EXPECT_EQ(limitsTextOf(timing, {.ramp = .25}),
            "velocities of the scene; accelerations that reach them in 0.25 s");
  EXPECT_EQ(limitsTextOf(timing, {.effort = true}),
            "velocities of the scene; accelerations that reach them in 0.5 s; efforts of the scene");
}

TEST(PathTiming, SaysWhatItAssumes) {
  const PlanOptions options{.velocity = .7, .effort = true};
  EXPECT_EQ(
      assumptionsOf(timed(chain(2, 1), options), options),
      "no velocity limit for 'j2': assuming 0.7 rad/s or m/s, see --velocity; no effort limit for 'j2': "
      "assuming any effort");
  EXPECT_EQ(
      limitsTextOf(timed(chain(2, 1), options), options),
      "velocities of the scene, for 1 of 2 coordinates 0.7 rad/s or m/s; accelerations that reach them in "
      "0.5 s; efforts of the scene");
  EXPECT_EQ(assumptionsOf(timed(chain(8, 0), {}), {}),
            "no velocity limit for 'j1', 'j2', 'j3', 'j4', 'j5', 'j6' and 2 more: assuming 1 rad/s or m/s, "
            "see --velocity");
  EXPECT_EQ(limitsTextOf(timed(chain(2, 0), {}), {}),
            "velocities 1 rad/s or m/s; accelerations that reach them in 0.5 s");
}

}  // namespace rex::cli::path_timing_test
