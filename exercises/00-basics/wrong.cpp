// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant inverse_on_the_wrong_side> caught by: square-equations, any-size
// mistake: Divides from the left, though A stands to the right of X.
// ask: Is the inverse of A on the wrong side? A is to the right of X.
// <solution equationA>
const Eigen::MatrixXd Id = Eigen::MatrixXd::Identity(A.rows(), A.cols());
return inverse(A) * (Id - A.transpose());

// <variant not_transposed> caught by: square-equations, any-size
// mistake: A in place of its transpose.
// ask: Is A not transposed?
// <solution equationA>
return (Eigen::MatrixXd::Identity(A.rows(), A.cols()) - A) * inverse(A);

// <variant sign_kept> caught by: square-equations, any-size
// mistake: brings A^T to the other side, and keeps its sign.
// ask: Does A^T keep its sign on the other side?
// <solution equationA>
return (Eigen::MatrixXd::Identity(A.rows(), A.cols()) + A.transpose()) * inverse(A);

// <variant transpose_forgotten> caught by: square-equations, any-size
// mistake: Transposes X and B, but not the matrix it divides by.
// ask: Is C - 2 A^T not transposed?
// <solution equationB>
return solve(C - 2 * A.transpose(), 2 * A * B);

// <variant c_not_transposed> caught by: square-equations, any-size
// mistake: Transposes everything but C.
// ask: Is C not transposed?
// <solution equationB>
return solve(C - 2 * A, 2 * A * B);

// <variant calls_the_library> caught by: forbidden-call
// mistake: The library solves the equation, so nothing was learnt.
// <solution equationC>
return leastSquares(A, y);

// <variant regulariser_forgotten> caught by: tall-equations, any-size
// mistake: Leaves B out, as if d were c.
// ask: Is B left out?
// <solution equationD>
return solve(A.transpose() * A, A.transpose() * y);

// <variant half_of_the_product_rule> caught by: derivative, any-size
// mistake: Differentiates g and takes f for a constant.
// ask: Is f taken for a constant? It depends on x, too.
// <solution productDerivative>
return f.y.transpose() * C * g.J;

// <variant other_half_of_the_product_rule> caught by: derivative, any-size
// mistake: Differentiates f and takes g for a constant.
// ask: Is g taken for a constant? It depends on x, too.
// <solution productDerivative>
return (C * g.y).transpose() * f.J;

// <variant transposed_in_the_first_term> caught by: derivative, any-size
// mistake: Transposes C where it should not be.
// ask: Is C transposed in the term with the Jacobian of g?
// <solution productDerivative>
return f.y.transpose() * C.transpose() * g.J + (C * g.y).transpose() * f.J;

// <variant symmetric_by_assumption> caught by: derivative, any-size
// mistake: The second term lacks the transpose of C, which is right for a symmetric C only.
// ask: Is C not transposed in the term with the Jacobian of f?
// <solution productDerivative>
return f.y.transpose() * C * g.J + g.y.transpose() * C * f.J;

// <variant metric_forgotten> caught by: minimum, any-size
// mistake: The right side lacks C, so x is the minimum of another cost.
// ask: Is C left out in the term with y?
// <solution quadraticMinimum>
const Eigen::VectorXd x = solve(A.transpose() * C * A + B, A.transpose() * y);
const Eigen::VectorXd e = A * x - y;
return {x, e.dot(C* e) + x.dot(B* x)};

// <variant no_metric> caught by: minimum, any-size
// mistake: All errors cost the same.
// ask: Is C left out?
// <solution quadraticMinimum>
const Eigen::VectorXd x = solve(A.transpose() * A + B, A.transpose() * y);
const Eigen::VectorXd e = A * x - y;
return {x, e.dot(e) + x.dot(B* x)};

// <variant metric_on_the_right_only> caught by: minimum, any-size
// mistake: The left side lacks C.
// ask: Is C left out in the term with x?
// <solution quadraticMinimum>
const Eigen::VectorXd x = solve(A.transpose() * A + B, A.transpose() * C * y);
const Eigen::VectorXd e = A * x - y;
return {x, e.dot(C* e) + x.dot(B* x)};

// <variant value_without_metric> caught by: minimum, any-size
// mistake: The value lacks C.
// ask: Is C left out in the value?
// <solution quadraticMinimum>
// in place of: return {x, e.dot(C * e) + x.dot(B * x)};
return {x, e.dot(e) + x.dot(B* x)};

// <variant value_of_the_errors> caught by: minimum, any-size
// mistake: The value lacks what x itself costs.
// ask: Is the term x^T B x left out?
// <solution quadraticMinimum>
// in place of: return {x, e.dot(C * e) + x.dot(B * x)};
return {x, e.dot(C* e)};

// <variant always_halved> caught by: descent, descent-elsewhere
// mistake: Trials are halved, whatever `shrink` says.
// <solution backtracking>
// in place of: while (!(f(x + alpha * d) <= fx + options.decrease * alpha * slope)) alpha *= options.shrink;
while (!(f(x + alpha * d) <= fx + options.decrease * alpha * slope)) alpha *= 0.5;

// <variant armijo_sign> caught by: descent, descent-elsewhere
// shown by: descent
// mistake: The slope is taken with the wrong sign, so steps that lead uphill are accepted.
// <solution backtracking>
// in place of: while (!(f(x + alpha * d) <= fx + options.decrease * alpha * slope)) alpha *= options.shrink;
while (!(f(x + alpha * d) <= fx - options.decrease * alpha * slope)) alpha *= options.shrink;

// <variant direction_of_length_one> caught by: descent, descent-elsewhere
// mistake: The direction is normalised, so that alpha is the length of a step.
// <solution gradientDescent>
// in place of: const Eigen::VectorXd g = gradient(path.back());
const Eigen::VectorXd x = path.back(), g = gradient(x);
// in place of: alpha = backtracked(f, path.back(), -g, -g.squaredNorm(), ... path.push_back(path.back() -
const Eigen::VectorXd d = -g / g.norm();
while (!(f(x + alpha * d) <= f(x) + options.decrease * alpha * g.dot(d))) alpha *= options.shrink;
path.push_back(x + alpha * d);

// <variant fixed_step_size> caught by: descent, descent-elsewhere
// mistake: no line search: one small step size is too long for some functions and too short for others
// <solution gradientDescent>
// in place of: double alpha = 1;
// in place of: alpha = backtracked(f, path.back(), -g, -g.squaredNorm(), ... alpha *= options.grow;
path.push_back(path.back() - 0.01 * g);

// <variant rejected_trials_counted> caught by: descent, descent-elsewhere
// mistake: Rejected trials count as steps.
// <solution gradientDescent>
double alpha = 1;
for (int trial = 0; trial < options.maxSteps; ++trial) {
  const Eigen::VectorXd x = path.back(), g = gradient(x);
  if (g.norm() <= options.tolerance) break;
  const Eigen::VectorXd next = x - alpha * g;
  const bool isBetter = f(next) <= f(x) - options.decrease * alpha * g.squaredNorm();
  if (isBetter) path.push_back(next);
  alpha *= isBetter ? options.grow : options.shrink;
}

// <variant step_size_never_grows> caught by: descent
// mistake: The step size only shrinks, so a shallow bowl takes for ever.
// <solution gradientDescent>
// in place of: alpha *= options.grow;

// <variant factor_of_two> caught by: gauss-newton
// mistake: the gradient has its factor of two, the Hessian does not: every step is twice too long
// <solution gaussNewton>
// in place of: const Eigen::MatrixXd Jx = J(x), Jt = Jx.transpose(); ... path.push_back(x + backtracked(f, x,
const Eigen::MatrixXd Jx = J(x);
const Eigen::VectorXd g = 2 * Jx.transpose() * phi(x);
if (g.norm() <= options.tolerance) break;
const Eigen::VectorXd d = -solve(Jx.transpose() * Jx, g);
path.push_back(x + backtracked(f, x, d, g.dot(d), 1, options) * d);

// <variant full_steps_only> caught by: gauss-newton, gauss-newton-elsewhere
// shown by: gauss-newton
// mistake: Always the full step: where phi bends, it leads away.
// <solution gaussNewton>
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd x = path.back();
  const Eigen::MatrixXd Jx = J(x);
  const Eigen::VectorXd halfGradient = Jx.transpose() * phi(x);
  if (2 * halfGradient.norm() <= options.tolerance) break;
  path.push_back(x - solve(Jx.transpose() * Jx, halfGradient));
}

// <variant one_step_too_many> caught by: gauss-newton
// mistake: The loop takes one step more than maxSteps.
// <solution gaussNewton>
for (int step = 0; step <= options.maxSteps; ++step) {
  const Eigen::VectorXd x = path.back(), value = phi(x);
  const Eigen::MatrixXd Jx = J(x);
  const Eigen::VectorXd g = 2 * Jx.transpose() * value;
  if (g.norm() <= options.tolerance) break;
  const Eigen::VectorXd d = -0.5 * solve(Jx.transpose() * Jx, g);
  double alpha = 1;
  while (!(phi(x + alpha * d).squaredNorm() <= value.squaredNorm() + options.decrease * alpha * g.dot(d)))
    alpha *= options.shrink;
  path.push_back(x + alpha * d);
}

// <variant step_size_kept> caught by: gauss-newton, gauss-newton-elsewhere
// mistake: Gauss-Newton keeps its step size from step to step, as gradient descent does.
// <solution gaussNewton>
double alpha = 1;
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd x = path.back(), value = phi(x);
  const Eigen::MatrixXd Jx = J(x);
  const Eigen::VectorXd g = 2 * Jx.transpose() * value;
  if (g.norm() <= options.tolerance) break;
  const Eigen::VectorXd d = -0.5 * solve(Jx.transpose() * Jx, g);
  while (!(phi(x + alpha * d).squaredNorm() <= value.squaredNorm() + options.decrease * alpha * g.dot(d)))
    alpha *= options.shrink;
  path.push_back(x + alpha * d);
  alpha = std::min(1., alpha * options.grow);
}

// <variant clockwise> caught by: book, frames-elsewhere
// mistake: Turns the book clockwise: the rotation is transposed.
// ask: Does the book turn clockwise?
// <solution bookPose>
// in place of: X_WB << c, -s, move.x(), s, c, move.y(), 0, 0, 1;
X_WB << c, s, move.x(), -s, c, move.y(), 0, 0, 1;

// <variant turned_before_moved> caught by: book, frames-elsewhere
// mistake: Moves the book along its own axes, after turning it.
// ask: Is the move turned, too? The book is moved first, then turned about its own origin.
// <solution bookPose>
const double c = std::cos(angle), s = std::sin(angle);
Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(), shift = Eigen::Matrix3d::Identity();
turn.topLeftCorner<2, 2>() << c, -s, s, c;
shift.topRightCorner<2, 1>() = move;
return turn * shift;

// <variant turned_only> caught by: book, frames-elsewhere
// mistake: The point is turned, but not moved.
// ask: Is the translation left out?
// <solution mapped>
return (X_AB * Eigen::Vector3d(p_B.x(), p_B.y(), 0)).head(2);

// <variant inverse_translation_not_turned> caught by: frames, frames-elsewhere
// mistake: The inverse has the opposite translation, but in the axes of the wrong frame.
// ask: Is the translation only negated? It must be turned back, too.
// <solution inverted>
Eigen::Matrix3d X_BA = X_AB;
X_BA.topLeftCorner<2, 2>() = X_AB.topLeftCorner<2, 2>().transpose();
X_BA.topRightCorner<2, 1>() = -X_AB.topRightCorner<2, 1>();
return X_BA;

// <variant frames_in_the_wrong_order> caught by: frames, frames-elsewhere
// mistake: The letters in the middle do not meet: X_WB stands before X_AW.
// ask: Are the factors in the wrong order?
// <solution seenFrom>
return X_WB * inverted(X_WA);

// <variant seen_from_the_other> caught by: frames, frames-elsewhere
// mistake: A as seen from B.
// ask: Is it A as seen from B?
// <solution seenFrom>
return inverted(X_WB) * X_WA;

// <variant frames_not_inverted> caught by: frames, frames-elsewhere
// mistake: Both poses are multiplied as they are.
// ask: Is X_WA not inverted?
// <solution seenFrom>
return X_WA * X_WB;

// <variant fruit_in_one_heap> caught by: boxes, bayes-elsewhere
// mistake: counts the apples of all boxes as if a fruit were drawn: the same only for equal boxes
// ask: Is all fruit put in one heap? Each box is chosen equally often.
// <solution fruitBoxes>
double appleCount = 0, count = 0;
for (std::size_t i = 0; i < apples.size(); ++i) {
  appleCount += apples[i];
  count += apples[i] + oranges[i];
}
fruit.apple = appleCount / count;
for (std::size_t i = 0; i < apples.size(); ++i) {
  fruit.boxGivenApple[static_cast<Eigen::Index>(i)] = apples[i] / appleCount;
}

// <variant likelihood_of_the_apple> caught by: boxes, bayes-elsewhere
// mistake: P(apple | box) in place of P(box | apple).
// ask: Is it P(apple | box)?
// <solution fruitBoxes>
// in place of: joint /= fruit.apple;
joint *= static_cast<double>(boxes);

// <variant joint_with_the_apple> caught by: boxes, bayes-elsewhere
// mistake: Does not divide by P(apple).
// ask: Is it P(box, apple), not yet divided by P(apple)?
// <solution fruitBoxes>
// in place of: joint /= fruit.apple;

// <variant swapping_makes_no_difference> caught by: boxes, bayes-elsewhere
// mistake: All boxes that are still closed are taken to be equally likely, whatever the host knows.
// ask: Does each closed box get the same chance? The host never opens yours.
// <solution montyHall>
return {1. / (boxes - opened), 1. / (boxes - opened)};

// <variant one_door_has_it_all> caught by: bayes-elsewhere
// mistake: What your box lacks is the chance of each other closed box.
// <solution montyHall>
return {1. / boxes, 1 - 1. / boxes};

// <variant columns_not_normalised> caught by: table, bayes-elsewhere
// mistake: Forgets to divide by P(Y), so this is the joint and not the conditional.
// ask: Is it P(X, Y), not yet divided by P(Y)?
// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = P_XY;
answers.independent = (P_XY - answers.PX * answers.PY.transpose()).cwiseAbs().maxCoeff() < 1e-9;

// <variant marginals_exchanged> caught by: table, bayes-elsewhere
// mistake: P(X) and P(Y) are exchanged.
// ask: Is it P(Y)? The rows of the table belong to X.
// <solution jointTable>
answers.PX = P_XY.colwise().sum();
answers.PY = P_XY.rowwise().sum();
answers.XGivenY = P_XY * answers.PX.cwiseInverse().asDiagonal();
answers.independent = (P_XY - answers.PY * answers.PX.transpose()).cwiseAbs().maxCoeff() < 1e-9;

// <variant rows_normalised> caught by: table, bayes-elsewhere
// mistake: Divides by P(X), so this is the other conditional.
// ask: Is it P(Y | X)? Wanted are columns whose sum is 1.
// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = answers.PX.cwiseInverse().asDiagonal() * P_XY;
answers.independent = (P_XY - answers.PX * answers.PY.transpose()).cwiseAbs().maxCoeff() < 1e-9;

// <variant first_entry_only> caught by: table, bayes-elsewhere
// mistake: Independence is tested for the first entry only, which is enough for tables of 2 x 2.
// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = P_XY * answers.PY.cwiseInverse().asDiagonal();
answers.independent = std::abs(P_XY(0, 0) - answers.PX(0) * answers.PY(0)) <= 1e-9;

// <variant independent_to_the_last_bit> caught by: table, bayes-elsewhere
// mistake: Compares rounded numbers for equality.
// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = P_XY * answers.PY.cwiseInverse().asDiagonal();
answers.independent = P_XY == answers.PX * answers.PY.transpose();

// <variant roughly_independent> caught by: table, bayes-elsewhere
// mistake: The tolerance of isApprox is a thousandth of the whole table.
// <solution jointTable>
answers.PX = P_XY.rowwise().sum();
answers.PY = P_XY.colwise().sum();
answers.XGivenY = P_XY * answers.PY.cwiseInverse().asDiagonal();
const Eigen::MatrixXd expected = answers.PX * answers.PY.transpose();
answers.independent = expected.isApprox(P_XY, 1e-3);

// <variant covariances_added> caught by: product, beliefs-elsewhere
// shown by: product
// mistake: Adds covariances instead of precisions: two sources of knowledge would say less than one.
// ask: Are the covariances added? Precisions add.
// <solution product>
const Eigen::MatrixXd precisionP = inverse(p.cov), precisionQ = inverse(q.cov);
return {inverse(precisionP + precisionQ) * (precisionP * p.mean + precisionQ * q.mean), p.cov + q.cov};

// <variant covariances_added_for_the_mean> caught by: product, beliefs-elsewhere
// mistake: Adds covariances, and computes the mean with their sum.
// ask: Are the covariances added? Precisions add.
// <solution product>
const Eigen::MatrixXd cov = p.cov + q.cov;
return {cov * (inverse(p.cov) * p.mean + inverse(q.cov) * q.mean), cov};

// <variant precision_returned> caught by: product, beliefs-elsewhere
// mistake: Adds precisions, and returns their sum.
// ask: Is it the precision, the inverse of the covariance?
// <solution product>
// in place of: return {cov * (precisionP * p.mean + precisionQ * q.mean), cov};
return {cov * (precisionP * p.mean + precisionQ * q.mean), precisionP + precisionQ};

// <variant means_averaged> caught by: product, beliefs-elsewhere
// mistake: Both means count the same.
// ask: Is it the mean of both means, without weights?
// <solution product>
// in place of: return {cov * (precisionP * p.mean + precisionQ * q.mean), cov};
return {(p.mean + q.mean) / 2, cov};

// <variant weighted_by_covariance> caught by: product, beliefs-elsewhere
// mistake: Weights the means by covariances, so the less certain belief has more say.
// ask: Is each mean weighted by its own covariance? A small covariance should count more.
// <solution product>
return {inverse(p.cov + q.cov) * (p.cov * p.mean + q.cov * q.mean), inverse(inverse(p.cov) + inverse(q.cov))};

// <variant noise_forgotten> caught by: propagation, beliefs-elsewhere
// shown by: propagation
// mistake: The noise of the dynamics adds nothing to the covariance.
// ask: Is the covariance A of the noise left out?
// <solution propagated>
return {a + F * y.mean, F* y.cov* F.transpose()};

// <variant only_noise> caught by: propagation, beliefs-elsewhere
// mistake: What is uncertain about y adds nothing to the covariance.
// ask: Is the covariance of y left out?
// <solution propagated>
return {a + F * y.mean, A};

// <variant offset_forgotten> caught by: propagation, beliefs-elsewhere
// mistake: Leaves out a.
// ask: Is a left out?
// <solution propagated>
return {F * y.mean, A + F* y.cov* F.transpose()};

// <variant heads_for_tails> caught by: conjugate, beliefs-elsewhere
// shown by: conjugate
// mistake: Counts the ones where the zeros belong.
// ask: Are ones and zeros exchanged? a counts the ones.
// <solution betaPosterior>
for (const int x : data) (x == 1 ? belief.b : belief.a) += 1;

// <variant exponents_for_parameters> caught by: conjugate, beliefs-elsewhere
// mistake: Returns the exponents of mu, which are the parameters less one.
// ask: Are these the exponents of mu? The parameters are larger by 1.
// <solution betaPosterior>
belief.a -= 1;
belief.b -= 1;
for (const int x : data) (x == 1 ? belief.a : belief.b) += 1;
// <solution dirichletPosterior>
for (const int x : data) posterior[x - 1] += 1;
posterior.array() -= 1;

// <variant prior_left_out> caught by: conjugate, beliefs-elsewhere
// mistake: Counts the data, and forgets what was known before.
// ask: Is the prior left out?
// <solution betaPosterior>
belief = {0, 0};
for (const int x : data) (x == 1 ? belief.a : belief.b) += 1;
// <solution dirichletPosterior>
posterior.setZero();
for (const int x : data) posterior[x - 1] += 1;

// <variant prior_uniform> caught by: conjugate, beliefs-elsewhere
// mistake: Begins with ones, whatever the prior is.
// ask: Is the prior taken to be uniform?
// <solution betaPosterior>
belief = {1, 1};
for (const int x : data) (x == 1 ? belief.a : belief.b) += 1;
// <solution dirichletPosterior>
posterior.setOnes();
for (const int x : data) posterior[x - 1] += 1;

// <variant most_likely_instead_of_mean> caught by: conjugate, beliefs-elsewhere
// mistake: Predicts with the most likely mu, which ignores how uncertain mu is.
// ask: Is it the most likely mu? Wanted is the mean of mu.
// <solution nextOutcome>
return (alpha.array() - 1) / (alpha.sum() - static_cast<double>(alpha.size()));
