#include "learning/dataset_aggregation.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"

namespace rex {

std::vector<LinearClone> aggregatedClones(const ImitationTask& task, const AggregationOptions& options,
                                          Rng& rng) {
  requireCount("imitation: rounds", options.rounds, 1);
  requireCount("imitation: episodes of a round", options.episodes, 1);
  if (!(options.expertShare >= 0 && options.expertShare <= 1))
    throw Error({.what = "imitation: share of the expert",
                 .found = fmt::format("{:g}", options.expertShare),
                 .wanted = "a number from 0 to 1"});
  std::vector<LinearClone> clones;
  Eigen::MatrixXd features, actions;
  for (int round = 0; round < options.rounds; ++round) {
    const double share = std::pow(options.expertShare, round);
    const ActionOf act = [&](const VectorArg& phi) -> Eigen::VectorXd {
      if (clones.empty() || rng.uniform() < share) return task.expert(phi);
      return clones.back().weights.transpose() * phi;
    };
    for (int k = 0; k < options.episodes; ++k) {
      const Eigen::MatrixXd visited = task.episode(act, rng);
      if (visited.rows() == 0)
        throw Error({.what = "imitation: episode", .found = "no state", .wanted = "one or more"});
      if (features.size() > 0) requireSize("imitation: features", visited.cols(), features.cols());
      const Eigen::Index before = features.rows();
      features.conservativeResize(before + visited.rows(), visited.cols());
      features.bottomRows(visited.rows()) = visited;
      for (Eigen::Index i = 0; i < visited.rows(); ++i) {
        const Eigen::VectorXd action = task.expert(visited.row(i).transpose());
        actions.conservativeResize(features.rows(), action.size());
        actions.row(before + i) = action.transpose();
      }
    }
    clones.push_back(cloneLinear(features, actions, options.ridge));
  }
  return clones;
}

}  // namespace rex
