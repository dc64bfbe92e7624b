#include <limits>

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>

#include "bench/cpu_seconds.h"
#include "bench/ompl_space.h"
#include "bench/rrt_star_peer.h"

namespace rex::bench {

Measurement omplStarLength(const std::shared_ptr<const PathProblem>& problem, double stepSize) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  const ob::SpaceInformationPtr information = omplSpace(*problem);
  information->setStateValidityChecker(
      [problem, q = Eigen::VectorXd(problem->start)](const ob::State* state) mutable {
        copyNumbers(*state, q);
        return problem->allValid(q);
      });
  information->setup();
  const auto definition = std::make_shared<ob::ProblemDefinition>(information);
  definition->setStartAndGoalStates(omplState(information, problem->start),
                                    omplState(information, problem->goal));
  definition->setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(information));
  return [=] {
    definition->clearSolutionPaths();
    ompl::geometric::RRTstar planner(information);
    planner.setRange(stepSize);
    planner.setProblemDefinition(definition);
    planner.setup();
    const double before = cpuSeconds();
    planner.solve(ob::PlannerTerminationCondition([&] { return cpuSeconds() - before > kStarSeconds; }));
    return definition->hasExactSolution() ? definition->getSolutionPath()->length()
                                          : std::numeric_limits<double>::infinity();
  };
}

}  // namespace rex::bench
