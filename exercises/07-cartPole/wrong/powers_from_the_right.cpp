// caught by: reach, reaches-others
// mistake: B A^T for A B.

// <solution reachMatrix>
const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
Eigen::MatrixXd C(n, n* m);
C.leftCols(m) = plant.B;
for (Eigen::Index k = 1; k < n; ++k)
  C.middleCols(k* m, m) = plant.A.transpose() * C.middleCols((k - 1) * m, m);
return C;
// </solution>
