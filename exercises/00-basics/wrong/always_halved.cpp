// caught by: descent, descent-elsewhere
// mistake: Trials are halved, whatever `shrink` says.

// <solution backtracking>
namespace {

double backtracked(const ScalarFunction& f, const Eigen::VectorXd& x, const Eigen::VectorXd& d, double slope,
                   double alpha, const SearchOptions& options) {
  const double fx = f(x);
  while (!(f(x + alpha * d) <= fx + options.decrease * alpha * slope)) alpha *= 0.5;
  return alpha;
}

}  // namespace
// </solution>
