// caught by: observer, other-sensors
// mistake: returns the directions that y shows.

// <solution unseen>
const Plant dual{A.transpose(), C.transpose()};
return svd(reachMatrix(dual)).U.leftCols(reachable(dual));
// </solution>
