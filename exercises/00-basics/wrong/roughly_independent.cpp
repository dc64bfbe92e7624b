// caught by: table, bayes-elsewhere
// mistake: The tolerance of isApprox is a thousandth of the whole table.

// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = P_XY * answers.PY.cwiseInverse().asDiagonal();
const Eigen::MatrixXd expected = answers.PX * answers.PY.transpose();
answers.independent = expected.isApprox(P_XY, 1e-3);
// </solution>
