// caught by: moves
// shown by: moves
// mistake: forgets the bounds.

// <solution bestMoves>
return -Eigen::VectorXd(cost.H * z + cost.g).cwiseQuotient(cost.H.diagonal());
// </solution>
