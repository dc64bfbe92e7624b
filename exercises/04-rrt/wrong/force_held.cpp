// caught by: phase-whole-step, phase-step
// shown by: phase-whole-step
// mistake: the first force is held during the whole step.

// <solution phaseStep>
double least = std::numeric_limits<double>::infinity();
for (std::size_t i = 0; i < states.size(); ++i) {
  const double needed = effort(states[i], target, T);
  if (needed >= least) continue;
  least = needed;
  node.parent = static_cast<int>(i);
}
const Eigen::Vector2d& x = states[static_cast<std::size_t>(node.parent)];
const double u = forceAt(x, target, T, 0);
node.x = {x[0] + tau * x[1] + tau * tau / 2 * u, x[1] + tau* u};
// </solution>
