// caught by: table, bayes-elsewhere
// mistake: Forgets to divide by P(Y), so this is the joint and not the conditional.

// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = P_XY;
answers.independent = (P_XY - answers.PX * answers.PY.transpose()).cwiseAbs().maxCoeff() < 1e-9;
// </solution>
