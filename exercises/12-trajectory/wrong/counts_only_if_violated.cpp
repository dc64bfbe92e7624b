// caught by: as-cost
// mistake: an inequality counts only where it is violated, whatever its multiplier.

// <solution asCost>
if (term.role == Role::cost) return term;
Term rows{Role::cost, term.t, std::sqrt(mu) * (term.y + multipliers / (2 * mu)), std::sqrt(mu) * term.J};
if (term.role == Role::equality) return rows;
for (Eigen::Index i = 0; i < rows.y.size(); ++i) {
  if (term.y[i] > 0) continue;
  rows.y[i] = 0;
  rows.J.row(i).setZero();
}
return rows;
// </solution>
