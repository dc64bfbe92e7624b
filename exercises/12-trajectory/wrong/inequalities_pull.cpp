// caught by: multipliers, known-minima
// mistake: multipliers of inequalities may become negative.

// <solution nextMultipliers>
return term.role == Role::cost ? multipliers : Eigen::VectorXd(multipliers + 2 * mu * term.y);
// </solution>
