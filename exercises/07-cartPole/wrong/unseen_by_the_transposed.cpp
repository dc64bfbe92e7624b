// caught by: observer, other-sensors
// mistake: the powers of A in the place of those of its transpose.

// <solution unseen>
const Plant dual{A, C.transpose()};
return svd(reachMatrix(dual)).U.rightCols(A.rows() - reachable(dual));
// </solution>
