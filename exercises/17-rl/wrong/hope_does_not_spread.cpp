// caught by: hope, more-hope
// shown by: hope
// mistake: hopes only after planning, so the neighbours do not know.

// <solution optimisticValues>
Eigen::MatrixXd Q = plannedValues(model, discount);
for (Eigen::Index s = 0; s < Q.rows(); ++s)
  for (Eigen::Index a = 0; a < Q.cols(); ++a)
    if (model.visits(s, a) < known) Q(s, a) = maxReward / (1 - discount);
return Q;
// </solution>
