// caught by: hope, more-hope
// shown by: hope
// mistake: believes a single try.

// <solution optimisticValues>
LearnedWorld hoped = model;
for (Eigen::Index s = 0; s < model.R.rows(); ++s)
  for (Eigen::Index a = 0; a < model.R.cols(); ++a) {
    if (known > 0 && model.visits(s, a) > 0) continue;
    hoped.R(s, a) = maxReward / (1 - discount);
    hoped.P[static_cast<std::size_t>(a)].row(s).setZero();
  }
return plannedValues(hoped, discount);
// </solution>
