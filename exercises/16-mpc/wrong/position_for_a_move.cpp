// caught by: moves
// mistake: returns where the numbers would go.

// <solution bestMoves>
const Eigen::VectorXd slope = cost.H * z + cost.g;
const Eigen::VectorXd best = z - slope.cwiseQuotient(cost.H.diagonal());
return best.cwiseMax(lower).cwiseMin(upper);
// </solution>
