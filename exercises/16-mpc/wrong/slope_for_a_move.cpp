// caught by: moves
// mistake: takes the slope for the move.

// <solution bestMoves>
const Eigen::VectorXd best = z - (cost.H * z + cost.g);
return best.cwiseMax(lower).cwiseMin(upper) - z;
// </solution>
