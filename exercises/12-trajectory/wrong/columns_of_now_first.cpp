// caught by: difference-terms, task-differences, any-path
// mistake: puts the columns of x_t first.

// <solution taskDifference>
const std::vector<std::vector<double>> binomials{{-1, 1}, {1, -2, 1}, {-1, 3, -3, 1}};
const std::vector<double>& weights = binomials[phi.size() - 2];
const double scale = std::sqrt(tau) / std::pow(tau, static_cast<double>(phi.size()) - 1);
const Eigen::Index n = phi[0].J.cols();
TermValue value{Eigen::VectorXd::Zero(phi[0].y.size()),
                Eigen::MatrixXd(phi[0].y.size(), n* static_cast<Eigen::Index>(phi.size()))};
for (std::size_t i = 0; i < phi.size(); ++i) {
  value.y += scale * weights[i] * phi[i].y;
  value.J.middleCols(static_cast<Eigen::Index>(phi.size() - 1 - i) * n, n) = scale * weights[i] * phi[i].J;
}
return value;
// </solution>
