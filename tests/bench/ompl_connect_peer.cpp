#include <memory>
#include <stdexcept>

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "bench/arm_plans.h"
#include "bench/cpu_seconds.h"
#include "planning/path_problem.h"

namespace rex::bench {
namespace {

namespace ob = ompl::base;

// The box of a problem as a space of OMPL, whose motions are checked as finely; without a validity checker.
ob::SpaceInformationPtr omplSpace(const PathProblem& problem) {
  const auto space = std::make_shared<ob::RealVectorStateSpace>();
  for (const SpacePart& part : problem.space.parts()) space->addDimension(part.lower, part.upper);
  const auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityCheckingResolution(problem.resolution / space->getMaximumExtent());
  return information;
}

ob::ScopedState<> omplState(const ob::SpaceInformationPtr& information, const Eigen::VectorXd& q) {
  ob::ScopedState<> state(information);
  for (Eigen::Index i = 0; i < q.size(); ++i) state[static_cast<unsigned>(i)] = q[i];
  return state;
}

void copyNumbers(const ob::State& state, Eigen::VectorXd& q) {
  const double* numbers = state.as<ob::RealVectorStateSpace::StateType>()->values;
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = numbers[i];
}

ob::SpaceInformationPtr informationOf(const ContactScene& scene, const ArmPlan& plan) {
  const ob::SpaceInformationPtr information = omplSpace(plan.problem);
  information->setStateValidityChecker([model = std::make_shared<const Model>(scene.model),
                                        touches = fclContact(scene), q = Eigen::VectorXd(plan.problem.start),
                                        poses = BodyPoses()](const ob::State* state) mutable {
    copyNumbers(*state, q);
    forwardKinematics(*model, q, poses);
    return !touches(poses);
  });
  information->setup();
  return information;
}

}  // namespace

Measurement omplConnect(const ContactScene& scene, const ArmPlan& plan) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  static const bool kIsSeeded = (ompl::RNG::setSeed(1), true);  // before its first number, and never again
  static_cast<void>(kIsSeeded);
  const ob::SpaceInformationPtr information = informationOf(scene, plan);
  const auto definition = std::make_shared<ob::ProblemDefinition>(information);
  definition->setStartAndGoalStates(omplState(information, plan.problem.start),
                                    omplState(information, plan.problem.goal));
  return [=] {
    definition->clearSolutionPaths();
    ompl::geometric::RRTConnect planner(information);
    planner.setRange(plan.range);
    planner.setProblemDefinition(definition);
    planner.setup();
    const double before = cpuSeconds();
    // Never, and not a limit of time: that starts a thread that looks at the clock.
    const ob::PlannerStatus status = planner.solve(ob::plannerNonTerminatingCondition());
    const double seconds = cpuSeconds() - before;
    if (status != ob::PlannerStatus::EXACT_SOLUTION) throw std::logic_error("OMPL finds no path to the hole");
    return seconds;
  };
}

}  // namespace rex::bench
