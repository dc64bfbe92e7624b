// caught by: multipliers, unseen-minima
// mistake: adds mu y where the gradient has 2 mu y, so that multipliers lag behind.

// <solution nextMultipliers>
if (term.role == Role::cost) return multipliers;
const Eigen::VectorXd next = multipliers + mu * term.y;
return term.role == Role::equality ? next : Eigen::VectorXd(next.cwiseMax(0));
// </solution>
