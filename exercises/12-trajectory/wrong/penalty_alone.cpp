// caught by: known-minima, unseen-minima
// shown by: known-minima
// mistake: squared penalties with one mu, and no multipliers: constraints are violated.

// <solution minimised>
Minimum result{start, {}, {}, {}};
for (const Term& term : terms(start))
  result.multipliers.push_back(Eigen::VectorXd::Zero(term.role == Role::cost ? 0 : term.y.size()));
const Terms penalised = [&](const Eigen::MatrixXd& X) {
  std::vector<Term> all = terms(X);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = asCost(all[i], result.multipliers[i], 100 * mu);
  return all;
};
result.X = descended(penalised, start, accuracy.gradient).back();
result.cost = result.violation = {0};
return result;
// </solution>
