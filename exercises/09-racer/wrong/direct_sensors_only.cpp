// caught by: stays
// mistake: searches on (1, y) only, which do not show how fast the wheel turns.

// <solution searchedPolicy>
constexpr int kSearches = 3, kSamples = 20, kRepeats = 4, kTests = 50, kSearched = 5;
Eigen::VectorXd deviations = Eigen::VectorXd::Constant(kSearched, .3);
const int generations = (budget / kSearches - kTests) / (kSamples * kRepeats);
Eigen::MatrixXd found = Eigen::MatrixXd::Zero(kFeatures, kSearches);
for (int k = 0; k < kSearches; ++k) {
  SearchCma cma(rng.next());
  cma.init(Eigen::VectorXd::Zero(kSearched), -1, kSamples, deviations);
  Eigen::MatrixXd samples, W = Eigen::MatrixXd::Zero(kFeatures, kSamples);
  Eigen::VectorXd values;
  for (int i = 0; i < generations; ++i) {
    cma.step(samples, values);
    W.topRows(kSearched) = samples.transpose();
    const int steps = std::min(kLongestRide, static_cast<int>(50 * std::pow(30., 1. * i / generations)));
    values.setZero();
    for (int j = 0; j < kRepeats; ++j) values += rides(W, steps);
  }
  cma.step(samples, values);
  found.col(k).head(kSearched) = cma.getMean();
}
Eigen::VectorXd costs = Eigen::VectorXd::Zero(kSearches);
for (int j = 0; j < kTests; ++j) costs += rides(found, kLongestRide);
int best = 0;
costs.minCoeff(&best);
return found.col(best);
// </solution>
