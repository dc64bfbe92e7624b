#pragma once

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include "planning/path_problem.h"

namespace rex::bench {

namespace ob = ompl::base;

/// The box of a problem as a space of OMPL, whose motions are checked as finely; without a validity checker.
inline ob::SpaceInformationPtr omplSpace(const PathProblem& problem) {
  const auto space = std::make_shared<ob::RealVectorStateSpace>();
  for (const SpacePart& part : problem.space.parts()) space->addDimension(part.lower, part.upper);
  const auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityCheckingResolution(problem.resolution / space->getMaximumExtent());
  return information;
}

inline ob::ScopedState<> omplState(const ob::SpaceInformationPtr& information, const Eigen::VectorXd& q) {
  ob::ScopedState<> state(information);
  for (Eigen::Index i = 0; i < q.size(); ++i) state[static_cast<unsigned>(i)] = q[i];
  return state;
}

inline void copyNumbers(const ob::State& state, Eigen::VectorXd& q) {
  const double* numbers = state.as<ob::RealVectorStateSpace::StateType>()->values;
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = numbers[i];
}

}  // namespace rex::bench
