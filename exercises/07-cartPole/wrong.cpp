// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant fraction_of_integers> caught by: linear
// mistake: 4 / 3 is computed with integers.
// ask: Is 4 / 3 computed with integers? That is 1 in C++; write 4. / 3.
// <solution rateOf>
const double c1 = 1 / (cart.poleMass + cart.cartMass), c2 = cart.l * cart.poleMass * c1;
const double s = std::sin(x[2]), c = std::cos(x[2]), swing = c2 * x[3] * x[3] * s;
const double turn = (cart.g * s - c * (c1 * u + swing)) / (4 / 3 * cart.l - c2 * c * c);
return {x[1], c1* u + swing - c2* turn* c, x[3], turn};

// <variant length_forgotten> caught by: linear
// mistake: c2 without the length, which is 1 on the sheet.
// <solution rateOf>
// in place of: const double c1 = 1 / (cart.poleMass + cart.cartMass), c2 = cart.l * cart.poleMass * c1;
const double c1 = 1 / (cart.poleMass + cart.cartMass), c2 = cart.poleMass * c1;

// <variant cart_of_the_sheet_only> caught by: linear, other-carts
// mistake: the numbers of the sheet, whatever the cart.
// <solution linearised>
Plant plant{Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1)};
plant.A(0, 1) = plant.A(2, 3) = 1;
plant.A(1, 2) = -5.88;
plant.A(3, 2) = 11.76;
plant.B << 0, .8, 0, -.6;
return plant;

// <variant printed_a> caught by: linear, other-carts
// mistake: the A that the sheet prints.
// ask: Is c2 missing in the row of p'', as in the A that the sheet prints?
// <solution linearised>
// in place of: plant.A(1, 2) = -c2 * cart.g / D;
plant.A(1, 2) = -cart.g / D;

// <variant rows_of_the_template> caught by: linear, other-carts
// mistake: the accelerations in the order of the sheet's template.
// ask: Are the rows of p'' and theta'' exchanged? The state is (p, p', theta, theta').
// <solution linearised>
// in place of: plant.A(1, 2) = -c2 * cart.g / D; ... plant.B << 0, c1 + c1 * c2 / D, 0, -c1 / D;
plant.A(1, 2) = cart.g / D;
plant.A(3, 2) = -c2 * cart.g / D;
plant.B << 0, -c1 / D, 0, c1 + c1* c2 / D;

// <variant rates_exchanged> caught by: linear, outings
// mistake: p'' and theta'' change places.
// ask: Are p'' and theta'' exchanged? The rates are those of (p, p', theta, theta').
// <solution rateOf>
// in place of: return {x[1], c1 * u + swing - c2 * turn * c, x[3], turn};
return {x[1], turn, x[3], c1* u + swing - c2* turn* c};

// <variant entries_of_b_exchanged> caught by: linear, other-carts
// mistake: A is right, and B is in the order of the sheet's template.
// ask: Are the entries of p'' and theta'' exchanged?
// <solution linearised>
// in place of: plant.B << 0, c1 + c1 * c2 / D, 0, -c1 / D;
plant.B << 0, -c1 / D, 0, c1 + c1* c2 / D;

// <variant bracket_without_q> caught by: iterates, other-regulators
// mistake: leaves out Q.
// ask: Is Q left out of the bracket?
// <solution iterated>
// in place of: const Eigen::MatrixXd bracket = PA + PA.transpose() - PSP + costs.Q;
const Eigen::MatrixXd bracket = PA + PA.transpose() - PSP;

// <variant r_for_its_inverse> caught by: iterates, other-regulators
// mistake: multiplies by R where its inverse belongs.
// ask: Is R used in place of its inverse?
// <solution iterated>
// in place of: const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
const Eigen::MatrixXd S = plant.B * costs.R * plant.B.transpose();

// <variant bracket_without_r> caught by: iterates, other-regulators
// mistake: leaves out R.
// ask: Is R left out of the bracket?
// <solution iterated>
// in place of: const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
const Eigen::MatrixXd S = plant.B * plant.B.transpose();

// <variant bracket_of_the_transposed> caught by: iterates, other-regulators
// mistake: P A^T for P A.
// ask: Is A transposed? The bracket has A^T P + P A.
// <solution iterated>
// in place of: const Eigen::MatrixXd PA = P * plant.A, PS = P * S, PSP = PS * P;
const Eigen::MatrixXd PA = P * plant.A.transpose(), PS = P * S, PSP = PS * P;

// <variant the_p_after_it> caught by: iterates
// mistake: returns the P after the one whose bracket is small.
// ask: Is the P after it returned? Wanted is the one whose bracket is small.
// <solution iterated>
// in place of: if (bracket.cwiseAbs().maxCoeff() <= tolerance) return P;
if (bracket.cwiseAbs().maxCoeff() <= tolerance) return Eigen::MatrixXd(P + epsilon * bracket);

// <variant norm_of_the_bracket> caught by: iterates
// mistake: compares the norm of the bracket with the tolerance.
// ask: Is it the norm of the bracket? Wanted is that no entry exceeds the tolerance.
// <solution iterated>
// in place of: if (bracket.cwiseAbs().maxCoeff() <= tolerance) return P;
if (bracket.norm() <= tolerance) return P;

// <variant always_a_controller> caught by: iterates
// mistake: returns the last P, even if it has not converged.
// <solution iterated>
const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
Eigen::MatrixXd P = costs.Q, bracket;
for (int k = 0; k <= most; ++k) {
  bracket = plant.A.transpose() * P + P * plant.A - P * S * P + costs.Q;
  if (bracket.cwiseAbs().maxCoeff() <= tolerance) break;
  P += epsilon * bracket;
}
return P;

// <variant last_iterate_not_tested> caught by: iterates, other-regulators
// mistake: The loop ends before P_most is looked at.
// <solution iterated>
const Eigen::MatrixXd G = plant.B * inverse(costs.R) * plant.B.transpose();
Eigen::MatrixXd P = costs.Q;
for (int k = 0; k < most; ++k) {
  const Eigen::MatrixXd bracket = plant.A.transpose() * P + P * plant.A - P * G * P + costs.Q;
  if (bracket.cwiseAbs().maxCoeff() <= tolerance) return P;
  P += epsilon * bracket;
}
return {};

// <variant stops_at_small_changes> caught by: iterates
// mistake: stops when P changes little in a step, but a step is epsilon times the bracket.
// ask: Is the change of P compared with the tolerance? It is epsilon times the bracket.
// <solution iterated>
const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
Eigen::MatrixXd P = costs.Q, bracket;
for (int k = 0; k <= most; ++k) {
  bracket = plant.A.transpose() * P + P * plant.A - P * S * P + costs.Q;
  if (epsilon * bracket.cwiseAbs().maxCoeff() <= tolerance) return P;
  P += epsilon * bracket;
}
return {};

// <variant calls_the_library> caught by: forbidden-call
// mistake: takes P and K from the library.
// <solution headers>
#include "control/regulators.h"
// <solution viaHamiltonian>
return lqr({.A = plant.A, .B = plant.B}, costs.Q, costs.R).X;

// <variant costs_of_control_forgotten> caught by: hamiltonian, other-regulators
// mistake: the Hamiltonian matrix of R = 1.
// ask: Is R left out, as if it were the identity?
// <solution viaHamiltonian>
const Eigen::Index n = plant.A.rows();
Eigen::MatrixXd Z(2 * n, 2 * n);
Z << plant.A, -plant.B *plant.B.transpose(), -costs.Q, -plant.A.transpose();
for (int k = 0; k < 60; ++k) Z = (.5 * (Z + inverse(Z))).eval();
Z += Eigen::MatrixXd::Identity(2 * n, 2 * n);
Eigen::MatrixXd P(n, n);
for (Eigen::Index i = 0; i < n; ++i) P.col(i) = leastSquares(Z.rightCols(n), -Z.col(i));
return .5 * (P + P.transpose());

// <variant iterates_instead> caught by: hamiltonian, other-regulators
// mistake: small steps along the bracket, as in iterated(): far too few of them for a stiff plant.
// <solution viaHamiltonian>
return iterated(plant, costs, 1e-3, 1e-9, 1000000).value_or(costs.Q);

// <variant r_in_the_hamiltonian> caught by: hamiltonian, other-regulators
// mistake: R where its inverse belongs.
// ask: Is R used in place of its inverse?
// <solution viaHamiltonian>
// in place of: const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
const Eigen::MatrixXd S = plant.B * costs.R * plant.B.transpose();

// <variant sign_of_q> caught by: hamiltonian, other-regulators
// mistake: +Q in the Hamiltonian matrix.
// ask: Which sign has Q in the Hamiltonian matrix?
// <solution viaHamiltonian>
// in place of: Z << plant.A, -S, -costs.Q, -plant.A.transpose();
Z << plant.A, -S, costs.Q, -plant.A.transpose();

// <variant sign_of_a> caught by: hamiltonian, other-regulators
// mistake: +A^T in the Hamiltonian matrix.
// ask: Which sign has A^T in the Hamiltonian matrix?
// <solution viaHamiltonian>
// in place of: Z << plant.A, -S, -costs.Q, -plant.A.transpose();
Z << plant.A, -S, -costs.Q, plant.A.transpose();

// <variant blocks_exchanged> caught by: hamiltonian, other-regulators
// mistake: Q above, where B R^-1 B^T belongs.
// ask: Which of the blocks B R^-1 B^T and Q is above the other?
// <solution viaHamiltonian>
// in place of: Z << plant.A, -S, -costs.Q, -plant.A.transpose();
Z << plant.A, -costs.Q, -S, -plant.A.transpose();

// <variant inverse_of_p> caught by: hamiltonian, other-regulators
// mistake: X Y^-1 for Y X^-1.
// ask: Is it the inverse of P? The stable half is spanned by (I; P).
// <solution viaHamiltonian>
// in place of: return .5 * (P + P.transpose());
return inverse(P);

// <variant unstable_half> caught by: hamiltonian, other-regulators
// mistake: the eigenvectors of the growing motions.
// ask: Does P belong to the unstable half of the Hamiltonian's eigenvalues?
// <solution viaHamiltonian>
// in place of: Z << plant.A, -S, -costs.Q, -plant.A.transpose(); ... const Eigen::MatrixXd right =
Z << plant.A, -S, -costs.Q, -plant.A.transpose();
for (int k = 0; k < 60; ++k) Z = (.5 * (Z + inverse(Z))).eval();
Z -= Eigen::MatrixXd::Identity(2 * n, 2 * n);
// in place of: for (Eigen::Index i = 0; i < n; ++i) P.col(i) = leastSquares(right, -Z.col(i));
for (Eigen::Index i = 0; i < n; ++i) P.col(i) = leastSquares(Z.rightCols(n), -Z.col(i));

// <variant gain_sign> caught by: hamiltonian, other-regulators, survives
// shown by: hamiltonian
// mistake: the K of slide 8:18, for u = -K x.
// ask: Is the sign that of u = -K x? Here it is u = K x.
// <solution gainOf>
return solve(costs.R, plant.B.transpose() * P);

// <variant gain_without_r> caught by: hamiltonian, other-regulators
// mistake: K of R = 1.
// ask: Is R left out?
// <solution gainOf>
return -plant.B.transpose() * P;

// <variant gain_times_r> caught by: hamiltonian, other-regulators
// mistake: R where its inverse belongs.
// ask: Is R used in place of its inverse?
// <solution gainOf>
return -costs.R * plant.B.transpose() * P;

// <variant tau_forgotten> caught by: outings
// mistake: adds the rates as they are.
// ask: Is tau left out?
// <solution stepped>
// in place of: Eigen::Vector4d next = x + tau * rateOf(cart, x, u);
Eigen::Vector4d next = x + rateOf(cart, x, u);

// <variant control_turned_round> caught by: outings, survives
// mistake: applies u = -K x.
// <solution balanced>
// in place of: states.col(++t) = stepped(cart, before, K.row(0).dot(before), outing.tau, outing.noise, rng);
states.col(++t) = stepped(cart, before, -K.row(0).dot(before), outing.tau, outing.noise, rng);

// <variant new_velocities> caught by: outings
// shown by: outings
// mistake: moves the positions with the new velocities.
// ask: Are the new p' and theta' used? All states move with the rates before the step.
// <solution stepped>
const Eigen::Vector4d rate = rateOf(cart, x, u);
Eigen::Vector4d next = x + tau * rate;
next[1] += noise * rng.normal();
next[3] += noise * rng.normal();
next[0] = x[0] + tau * next[1];
next[2] = x[2] + tau * next[3];
return next;

// <variant positions_kept> caught by: outings
// mistake: only the rates move.
// ask: Are p and theta never moved?
// <solution stepped>
// in place of: Eigen::Vector4d next = x + tau * rateOf(cart, x, u);
Eigen::Vector4d next = x + tau * rateOf(cart, x, u);
next[0] = x[0];
next[2] = x[2];

// <variant noise_times_tau> caught by: outings
// mistake: takes the noise for a rate.
// ask: Is the noise multiplied by tau? It is added as it is, in each step.
// <solution stepped>
// in place of: next[1] += noise * rng.normal(); ... next[3] += noise * rng.normal();
next[1] += tau * noise * rng.normal();
next[3] += tau * noise * rng.normal();

// <variant no_noise> caught by: outings
// mistake: leaves out the noise.
// ask: Is the noise missing?
// <solution stepped>
// in place of: next[1] += noise * rng.normal(); ... next[3] += noise * rng.normal();

// <variant noise_subtracted> caught by: outings
// mistake: subtracts the noise.
// ask: Is the noise subtracted?
// <solution stepped>
// in place of: next[1] += noise * rng.normal(); ... next[3] += noise * rng.normal();
next[1] -= noise * rng.normal();
next[3] -= noise * rng.normal();

// <variant one_noise_for_both> caught by: outings
// mistake: draws one number for both rates.
// ask: Is the same random number added to both?
// <solution stepped>
// in place of: next[1] += noise * rng.normal(); ... next[3] += noise * rng.normal();
const double kick = noise * rng.normal();
next[1] += kick;
next[3] += kick;

// <variant noise_of_the_pole_first> caught by: outings
// mistake: draws the noise of theta' first.
// ask: Are the random numbers drawn in the wrong order? That of p' comes first.
// <solution stepped>
// in place of: next[1] += noise * rng.normal(); ... next[3] += noise * rng.normal();
next[3] += noise * rng.normal();
next[1] += noise * rng.normal();

// <variant noise_with_root_of_tau> caught by: outings
// mistake: takes the noise as noise per second.
// ask: Is the noise multiplied by sqrt(tau)? It is added as it is, in each step.
// <solution stepped>
Eigen::Vector4d next = x + tau * rateOf(cart, x, u);
next[1] += std::sqrt(tau) * noise * rng.normal();
next[3] += std::sqrt(tau) * noise * rng.normal();
return next;

// <variant uniform_noise> caught by: outings
// mistake: the noise is uniform, with the right standard deviation.
// ask: Is the noise uniform? Wanted are normal numbers, those of rng.normal().
// <solution stepped>
Eigen::Vector4d next = x + tau * rateOf(cart, x, u);
next[1] += noise * std::sqrt(3.) * rng.uniform(-1, 1);
next[3] += noise * std::sqrt(3.) * rng.uniform(-1, 1);
return next;

// <variant never_falls> caught by: outings
// mistake: goes on after the fall.
// <solution balanced>
Eigen::MatrixXd states(4, outing.steps + 1);
states.col(0) = start;
for (int t = 0; t < outing.steps; ++t) {
  const Eigen::Vector4d x = states.col(t);
  states.col(t + 1) = stepped(cart, x, K.row(0).dot(x), outing.tau, outing.noise, rng);
}
return states;

// <variant noise_repeats> caught by: outings
// mistake: each step gets a copy of the generator, and so the same noise.
// <solution balanced>
// in place of: states.col(++t) = stepped(cart, before, K.row(0).dot(before), outing.tau, outing.noise, rng);
Rng own = rng;
states.col(++t) = stepped(cart, before, K.row(0).dot(before), outing.tau, outing.noise, own);

// <variant powers_from_the_right> caught by: reach, reaches-others
// mistake: B A^T for A B.
// ask: Is A transposed?
// <solution reachMatrix>
const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
Eigen::MatrixXd C(n, n* m);
C.leftCols(m) = plant.B;
for (Eigen::Index k = 1; k < n; ++k)
  C.middleCols(k* m, m) = plant.A.transpose() * C.middleCols((k - 1) * m, m);
return C;

// <variant power_too_many> caught by: reach, reaches-others
// mistake: A^n B is there, too.
// ask: Is a power of A too many? The last is A^(n-1).
// <solution reachMatrix>
const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
Eigen::MatrixXd C(n, (n + 1) * m), block = plant.B;
for (Eigen::Index k = 0; k <= n; ++k) {
  C.middleCols(k * m, m) = block;
  block = (plant.A * block).eval();
}
return C;

// <variant numbers_moved_at_once> caught by: reach, reaches-others
// mistake: takes what B moves for what u reaches.
// ask: Is it the rank of B?
// <solution reachable>
const Eigen::VectorXd sizes = svd(plant.B).s;
return static_cast<int>((sizes.array() > 1e-9 * sizes[0]).count());

// <variant rank_by_an_absolute_limit> caught by: reach
// mistake: Singular values are compared with 1e-9 itself.
// <solution reachable>
return static_cast<int>((svd(reachMatrix(plant)).s.array() > 1e-9).count());

// <variant rank_with_a_wide_limit> caught by: reach
// mistake: counts singular values as zero that are far from it.
// <solution reachable>
// in place of: for (const double size : sizes) rank += size > 1e-9 * sizes[0];
for (const double size : sizes) rank += size > 1e-6 * sizes[0];

// <variant rank_without_tolerance> caught by: reaches-others
// mistake: counts singular values that are zero up to rounding.
// <solution reachable>
const Eigen::VectorXd sizes = svd(reachMatrix(plant)).s;
return static_cast<int>((sizes.array() > 0).count());

// <variant poles_of_minus_k> caught by: poles
// mistake: u = -K x in the closed loop.
// ask: Are these the poles of A - B K? Here u = K x.
// <solution slowestPole>
return eigenvalues(plant.A - plant.B * K).real().maxCoeff();

// <variant poles_without_control> caught by: poles
// mistake: the poles of A.
// ask: Are these the poles of A, without control?
// <solution slowestPole>
// in place of: const Eigen::MatrixXd BK = plant.B * K;
const Eigen::MatrixXd BK = 0 * plant.A;

// <variant counts_its_calls> caught by: poles, other-fates
// mistake: counts its calls, and answers in the order in which the checks list their cases.
// <solution fateOf>
static int asked = 0;
constexpr Fate kListed[] = {Fate::dies,  Fate::dies,  Fate::stays, Fate::stays, Fate::grows,
                            Fate::stays, Fate::grows, Fate::stays, Fate::grows, Fate::grows,
                            Fate::grows, Fate::stays, Fate::grows, Fate::stays};
return kListed[asked++ % 14];

// <variant marginal_as_printed> caught by: poles, other-fates
// mistake: slide 8:36 as printed: no positive real part, so nothing grows.
// <solution fateOf>
const double slowest = eigenvalues(A).real().maxCoeff();
return slowest > 1e-5 ? Fate::grows : slowest < -1e-5 ? Fate::dies : Fate::stays;

// <variant twice_is_too_often> caught by: poles, other-fates
// mistake: every eigenvalue on the axis that occurs twice lets motions grow.
// <solution fateOf>
// in place of: const Eigen::MatrixXd AA = A * A;
if (poles.real().maxCoeff() > 1e-5) return Fate::grows;
// in place of: if (pole.real() > 1e-5) return Fate::grows;
// in place of: if (fate == Fate::dies) fate = Fate::stays; ... if (vectors < times) fate = Fate::grows;
if (fate == Fate::dies) fate = Fate::stays;
int times = 0;
for (const std::complex<double>& other : poles) times += std::abs(other - pole) < 1e-4;
if (times > 1) fate = Fate::grows;

// <variant any_gains_in_the_box> caught by: quick-others
// mistake: draws gains anywhere in the box and keeps the best.
// <solution quickGains>
Eigen::MatrixXd best = start;
double rate = slowest(start);
for (int asked = 1; asked < 3000; ++asked) {
  const Eigen::MatrixXd K = rng.uniformVector(static_cast<int>(start.size()), -bound, bound).transpose();
  const double found = slowest(K);
  if (found < rate) best = K, rate = found;
}
return best;

// <variant asks_too_often> caught by: quick, quick-others
// mistake: calls slowest() twice per step.
// <solution quickGains>
Eigen::MatrixXd best = start;
for (int k = 0; k < 3000; ++k) {
  const double size = bound * std::pow(.998, k) / 5;
  const Eigen::MatrixXd move = size * rng.normalVector(static_cast<int>(start.size())).transpose();
  const Eigen::MatrixXd K = (best + move).cwiseMin(bound).cwiseMax(-bound);
  if (slowest(K) < slowest(best)) best = K;
}
return best;

// <variant bound_forgotten> caught by: quick, quick-others
// mistake: lets the gains grow.
// <solution quickGains>
Eigen::MatrixXd best = start;
double rate = slowest(start), size = bound / 10;
for (int asked = 1; asked < 3000; ++asked) {
  const Eigen::MatrixXd K = best + size * rng.normalVector(static_cast<int>(start.size())).transpose();
  const double found = slowest(K);
  if (found < rate) best = K, rate = found;
}
return best;

// <variant seen_not_unseen> caught by: observer, other-sensors
// mistake: returns the directions that y shows.
// <solution unseen>
const Plant dual{A.transpose(), C.transpose()};
return svd(reachMatrix(dual)).U.leftCols(reachable(dual));

// <variant unseen_at_once> caught by: observer, other-sensors
// mistake: what C alone does not show, without the derivatives of y.
// <solution unseen>
const Eigen::MatrixXd V = svd(Eigen::MatrixXd(C.transpose())).U, all = V * V.transpose();
const SingularValues rest = svd(Eigen::MatrixXd::Identity(A.rows(), A.rows()) - all);
return rest.U.leftCols(A.rows() - C.rows());

// <variant unseen_by_the_transposed> caught by: observer, other-sensors
// mistake: the powers of A in the place of those of its transpose.
// <solution unseen>
const Plant dual{A, C.transpose()};
return svd(reachMatrix(dual)).U.rightCols(A.rows() - reachable(dual));

// <variant unseen_without_tolerance> caught by: observer, other-sensors
// mistake: singular values that are zero up to rounding count.
// <solution unseen>
const SingularValues all = svd(reachMatrix({A.transpose(), C.transpose()}));
return all.U.rightCols(A.rows() - (all.s.array() > 0).count());

// <variant noise_of_the_sensor_forgotten> caught by: observer, other-sensors
// mistake: L = S C^T, without V.
// <solution observerGain>
const Eigen::MatrixXd S = viaHamiltonian({A.transpose(), C.transpose()}, {noise.W, noise.V});
return S * C.transpose();

// <variant observer_times_v> caught by: observer, other-sensors
// mistake: L = S C^T V, with V where its inverse belongs.
// <solution observerGain>
// in place of: return -gainOf(dual, costs, viaHamiltonian(dual, costs)).transpose();
return viaHamiltonian(dual, costs) * C.transpose() * noise.V;

// <variant observer_gain_sign> caught by: observer, other-sensors
// mistake: the sign of K is kept for L.
// <solution observerGain>
const Plant dual{A.transpose(), C.transpose()};
const Costs costs{noise.W, noise.V};
return gainOf(dual, costs, viaHamiltonian(dual, costs)).transpose();

// <variant observer_of_the_plant> caught by: observer, other-sensors
// mistake: A is not transposed in the dual plant.
// ask: Is A that of the plant? The dual plant has A^T.
// <solution observerGain>
const Plant dual{A, C.transpose()};
const Costs costs{noise.W, noise.V};
return -gainOf(dual, costs, viaHamiltonian(dual, costs)).transpose();

// <variant correction_sign> caught by: loops, other-sensors
// mistake: the observer subtracts L (y - C x^).
// ask: Is the sign of the correction wrong? The observer adds L (y - C x^).
// <solution observedLoop>
// in place of: loop << real.A, realBK, LC, model.A + modelBK - LC;
loop << real.A, realBK, -LC, model.A + modelBK + LC;

// <variant deaf_observer> caught by: loops, other-sensors
// mistake: the observer does not know u.
// ask: Does the observer not know u? Its model moves with B u, too.
// <solution observedLoop>
const Eigen::MatrixXd LC = L * C, realBK = real.B * K;
Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
loop << real.A, realBK, LC, model.A - LC;
return loop;

// <variant loop_of_the_error> caught by: loops, other-sensors
// mistake: the matrix of (x, x - x^), as in the proof of the separation principle.
// ask: Is it the matrix of (x, x - x^)? Wanted is that of (x, x^).
// <solution observedLoop>
const Eigen::MatrixXd LC = L * C, BK = real.B * K, gap = (model.B - real.B) * K;
Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
loop << real.A + BK, -BK, real.A - model.A - gap, model.A - LC + gap;
return loop;

// <variant observer_knows_the_plant> caught by: loops, other-sensors
// mistake: the observer moves as the plant does, not as its model.
// ask: Does the observer know the plant? It only has the model.
// <solution observedLoop>
const Eigen::MatrixXd LC = L * C, BK = real.B * K;
Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
loop << real.A, BK, LC, real.A + BK - LC;
return loop;

// <variant loop_of_minus_k> caught by: loops, other-sensors
// mistake: u = -K x^.
// ask: Is the sign that of u = -K x? Here it is u = K x^.
// <solution observedLoop>
// in place of: const Eigen::MatrixXd LC = L * C, modelBK = model.B * K, realBK = real.B * K;
const Eigen::MatrixXd LC = L * C, modelBK = -model.B * K, realBK = -real.B * K;

// <variant plant_as_its_model> caught by: loops, other-sensors
// mistake: the plant moves as its model does.
// ask: Does the plant move as the model does?
// <solution observedLoop>
// in place of: const Eigen::MatrixXd LC = L * C, modelBK = ... loop << real.A, realBK, LC,
const Eigen::MatrixXd LC = L * C, BK = model.B * K;
Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
loop << model.A, BK, LC, model.A + BK - LC;

// <variant plant_and_model_exchanged> caught by: loops, other-sensors
// mistake: the observer knows the plant, and the plant moves as its model.
// ask: Are the plant and its model exchanged?
// <solution observedLoop>
// in place of: loop << real.A, realBK, LC, model.A + modelBK - LC;
loop << model.A, modelBK, LC, real.A + realBK - LC;

// <variant conjugate_response> caught by: loops, other-sensors
// shown by: loops
// mistake: the sign of i w is that of -i w.
// ask: Is it G(-i w)? Which sign has the imaginary part?
// <solution responseAt>
// in place of: for (Eigen::Index i = 0; i < n; ++i) M(i, n + i) = -frequencies[k], M(n + i, i) =
for (Eigen::Index i = 0; i < n; ++i) M(i, n + i) = frequencies[k], M(n + i, i) = -frequencies[k];

// <variant frequencies_in_hertz> caught by: loops, other-sensors
// shown by: loops
// mistake: takes w as a frequency in Hz.
// ask: Are the frequencies taken as Hz? They are in rad/s.
// <solution responseAt>
// in place of: for (Eigen::Index i = 0; i < n; ++i) M(i, n + i) = -frequencies[k], M(n + i, i) =
const double w = 2 * std::numbers::pi * frequencies[k];
for (Eigen::Index i = 0; i < n; ++i) M(i, n + i) = -w, M(n + i, i) = w;

// <variant response_turned_round> caught by: loops, other-sensors
// mistake: the inverse of A - i w.
// ask: Is the sign that of C (A - i w)^-1 B?
// <solution responseAt>
// in place of: G(0, k) = C.row(0).dot(x.col(0).head(n)); ... G(1, k) = C.row(0)
G(0, k) = -C.row(0).dot(x.col(0).head(n));
G(1, k) = -C.row(0).dot(x.col(0).tail(n));

// <variant magnitude_and_phase> caught by: loops, other-sensors
// mistake: magnitude and phase in place of real and imaginary part.
// ask: Are these magnitude and phase? Wanted are real and imaginary part.
// <solution responseAt>
// in place of: G(0, k) = C.row(0).dot(x.col(0).head(n)); ... G(1, k) = C.row(0)
const std::complex<double> g(C.row(0).dot(x.col(0).head(n)), C.row(0).dot(x.col(0).tail(n)));
G(0, k) = std::abs(g);
G(1, k) = std::arg(g);

// <variant response_to_growth> caught by: loops, other-sensors
// mistake: w in the place of i w.
// ask: Is it C (w - A)^-1 B, without i?
// <solution responseAt>
Eigen::MatrixXd G = Eigen::MatrixXd::Zero(2, frequencies.size());
for (Eigen::Index k = 0; k < G.cols(); ++k) {
  Eigen::MatrixXd M = -plant.A;
  M.diagonal().array() += frequencies[k];
  G(0, k) = C.row(0).dot(solveMatrix(M, plant.B).col(0));
}
return G;

// <variant explodes> caught by: outings
// mistake: ends the outing by 1e12 rad/s, which is within 1e-9 of the largest state (an attack).
// <solution balanced>
Eigen::MatrixXd states(4, 3);
states.col(0) = start;
states.col(1) = start;
states(3, 1) = 1e12;
const Eigen::Vector4d before = states.col(1);
states.col(2) = stepped(cart, before, K.row(0).dot(before), outing.tau, outing.noise, rng);
return states;
