// caught by: hope, more-hope
// shown by: hope
// mistake: believes one try too late.

// <solution optimisticValues>
LearnedWorld hoped = model;
for (Eigen::Index s = 0; s < model.R.rows(); ++s)
  for (Eigen::Index a = 0; a < model.R.cols(); ++a) {
    if (model.visits(s, a) > known) continue;
    hoped.R(s, a) = maxReward / (1 - discount);
    hoped.P[static_cast<std::size_t>(a)].row(s).setZero();
  }
return plannedValues(hoped, discount);
// </solution>
