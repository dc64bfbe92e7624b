// caught by: search, stays, unseen-search
// shown by: search
// mistake: does not search; tries known weights with all signs of motor and sensors.

// <solution searchedPolicy>
Eigen::VectorXd known = Eigen::VectorXd::Zero(kFeatures);
known.head(9) << .037, -.986, 5.999, .726, .07, -.001, -.001, -.004, .053;
Eigen::MatrixXd W = known.replicate(1, 32);
for (int p = 0; p < 32; ++p)
  for (int i = 0; i < 9; ++i) {
    const bool isOther = i > 0 && (p >> (i - 1) % 4 & 1) == 1;
    if (isOther != (p >= 16)) W(i, p) *= -1;
  }
Eigen::VectorXd costs = Eigen::VectorXd::Zero(32);
for (int k = 0; k < 20; ++k) costs += rides(W, kLongestRide);
int best = 0;
costs.minCoeff(&best);
return W.col(best);
// </solution>
