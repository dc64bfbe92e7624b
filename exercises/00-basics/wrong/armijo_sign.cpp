// caught by: descent, descent-elsewhere
// shown by: descent
// mistake: The slope is taken with the wrong sign, so steps that lead uphill are accepted.

// <solution backtracking>
namespace {

double backtracked(const ScalarFunction& f, const Eigen::VectorXd& x, const Eigen::VectorXd& d, double slope,
                   double alpha, const SearchOptions& options) {
  const double fx = f(x);
  while (!(f(x + alpha * d) <= fx - options.decrease * alpha * slope)) alpha *= options.shrink;
  return alpha;
}

}  // namespace
// </solution>
