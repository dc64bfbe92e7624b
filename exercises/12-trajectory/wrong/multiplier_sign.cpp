// caught by: multipliers, known-minima, unseen-minima
// mistake: multipliers go against the violation.

// <solution nextMultipliers>
if (term.role == Role::cost) return multipliers;
const Eigen::VectorXd next = multipliers - 2 * mu * term.y;
return term.role == Role::equality ? next : Eigen::VectorXd(next.cwiseMax(0));
// </solution>
