// caught by: table, bayes-elsewhere
// mistake: Independence is tested for the first entry only, which is enough for tables of 2 x 2.

// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = P_XY * answers.PY.cwiseInverse().asDiagonal();
answers.independent = std::abs(P_XY(0, 0) - answers.PX(0) * answers.PY(0)) <= 1e-9;
// </solution>
