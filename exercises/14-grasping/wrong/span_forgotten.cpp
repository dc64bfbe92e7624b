// caught by: verdicts, border
// mistake: accepts weights for zero, even if all wrenches lie in a plane.

// <solution judged>
const Eigen::Index n = wrenches.cols();
const LinearSolution rest = minimizeLinear(wrenches, -wrenches.rowwise().sum(), Eigen::VectorXd::Ones(n));
if (rest.status != LinearStatus::kOptimal) return {false, -rest.y.normalized()};
const Eigen::VectorXd weights = rest.x.array() + 1;
return {true, weights / weights.sum()};
// </solution>
