// caught by: forbidden-call
// mistake: asks the library to learn.

// <solution headers>
#include "learning/q_learning.h"
// </solution>

// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& e : steps)
  learnFrom(learned, {e.state, e.action, e.reward, e.ended ? std::nullopt : std::optional(e.next)},
            std::nullopt, stepSize, discount);
return learned;
// </solution>
