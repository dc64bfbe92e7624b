// caught by: observer, other-sensors
// mistake: singular values that are zero up to rounding count.

// <solution unseen>
const SingularValues all = svd(reachMatrix({A.transpose(), C.transpose()}));
return all.U.rightCols(A.rows() - (all.s.array() > 0).count());
// </solution>
