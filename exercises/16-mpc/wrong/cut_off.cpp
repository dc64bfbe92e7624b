// caught by: box, more-boxes, plan, more-plans
// shown by: box, plan
// mistake: cuts off the minimum without bounds.

// <solution boxed>
return Eigen::VectorXd(-solve(cost.H, cost.g)).cwiseMax(lower).cwiseMin(upper);
// </solution>
