// caught by: table, bayes-elsewhere
// mistake: Compares rounded numbers for equality.

// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = P_XY * answers.PY.cwiseInverse().asDiagonal();
answers.independent = P_XY == answers.PX * answers.PY.transpose();
// </solution>
