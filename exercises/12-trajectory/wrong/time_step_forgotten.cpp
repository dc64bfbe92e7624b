// caught by: difference-terms, cost-of-powers, any-path
// mistake: differences as they stand on 5:4, whatever the time between two configurations.

// <solution differenceTerm>
std::vector<TermValue> identity;
for (Eigen::Index i = 0; i < window.cols(); ++i)
  identity.push_back({window.col(i), Eigen::MatrixXd::Identity(window.rows(), window.rows())});
return taskDifference(identity, 1);
// </solution>
