// caught by: forbidden-call
// mistake: the library does the smoothing.

// <solution headers>
#include "estimation/smoother.h"
// </solution>

// <solution hindsight>
std::vector<Gaussian> beliefs;
std::vector<LinearModel> steps;
for (const Belief& belief : filtered) beliefs.push_back({belief.mean, belief.covariance});
for (std::size_t t = 0; t < controls.size(); ++t) {
  const Eigen::MatrixXd A = stepByState(car, filtered[t].mean, controls[t]);
  const Eigen::VectorXd c = predicted(car, filtered[t], controls[t]).mean - A * filtered[t].mean;
  steps.push_back({A, c, stepNoise(car)});
}
beliefs = smoothed(beliefs, steps);
for (std::size_t t = 0; t < smooth.size(); ++t) smooth[t] = {beliefs[t].mean, beliefs[t].covariance};
// </solution>
