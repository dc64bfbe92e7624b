// caught by: lyapunov, judges-others
// mistake: looks at one point of the first axis and at one corner of the box.

// <solution counterexample>
Eigen::VectorXd x = Eigen::VectorXd::Zero(high.size());
x[0] = high[0];
for (int i = 0; i < 2; ++i, x = high)
  if (x.dot(P * x) <= 0 || x.dot(P * f(x)) >= 0) return x;
return {};
// </solution>
