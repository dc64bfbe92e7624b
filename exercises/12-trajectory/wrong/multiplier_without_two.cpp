// caught by: multipliers, unseen-minima
// mistake: mu y where the gradient has 2 mu y. Multipliers stay behind.

// <solution nextMultipliers>
if (term.role == Role::cost) return multipliers;
const Eigen::VectorXd next = multipliers + mu * term.y;
return term.role == Role::equality ? next : Eigen::VectorXd(next.cwiseMax(0));
// </solution>
