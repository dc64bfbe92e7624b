#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

Eigen::Vector4d rateOf(const PoleCart& cart, const Eigen::Vector4d& x, double u) {
  // <solution rateOf>
  const double c1 = 1 / (cart.poleMass + cart.cartMass), c2 = cart.l * cart.poleMass * c1;
  const double s = std::sin(x[2]), c = std::cos(x[2]), swing = c2 * x[3] * x[3] * s;
  const double turn = (cart.g * s - c * (c1 * u + swing)) / (4 * cart.l / 3 - c2 * c * c);
  return {x[1], c1 * u + swing - c2 * turn * c, x[3], turn};
  // <todo>
  //| // TODO: eq. (13), then eq. (14), which needs the result.
  //| return Eigen::Vector4d::Zero();
  // </solution>
}

Plant linearised(const PoleCart& cart) {
  // <solution linearised>
  const double c1 = 1 / (cart.poleMass + cart.cartMass), c2 = cart.l * cart.poleMass * c1;
  const double D = 4 * cart.l / 3 - c2;
  Plant plant{Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1)};
  plant.A(0, 1) = plant.A(2, 3) = 1;
  plant.A(1, 2) = -c2 * cart.g / D;
  plant.A(3, 2) = cart.g / D;
  plant.B << 0, c1 + c1 * c2 / D, 0, -c1 / D;
  return plant;
  // <todo>
  //| // TODO: which entries of A and B are not zero? The rows are in the order of x.
  //| return {Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1)};
  // </solution>
}

std::optional<Eigen::MatrixXd> iterated(const Plant& plant, const Costs& costs, double epsilon,
                                        double tolerance, int most) {
  // <solution iterated>
  const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
  Eigen::MatrixXd P = costs.Q;
  for (int k = 0; k <= most; ++k) {
    const Eigen::MatrixXd PA = P * plant.A, PS = P * S, PSP = PS * P;
    const Eigen::MatrixXd bracket = PA + PA.transpose() - PSP + costs.Q;
    if (bracket.cwiseAbs().maxCoeff() <= tolerance) return P;
    P += epsilon * bracket;
  }
  return {};
  // <todo>
  //| // TODO: the bracket of P, and from it the next P.
  //| return {};
  // </solution>
}

Eigen::MatrixXd viaHamiltonian(const Plant& plant, const Costs& costs) {
  // <solution viaHamiltonian>
  const Eigen::Index n = plant.A.rows();
  const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
  Eigen::MatrixXd Z(2 * n, 2 * n);
  Z << plant.A, -S, -costs.Q, -plant.A.transpose();
  // The sign of Z, by Newton: its stable eigenvalues become -1, the others 1.
  for (int k = 0; k < 60; ++k) Z = .5 * (Z + inverse(Z));
  // (Z + I) (I; P) = 0, a tall system for P, column by column.
  Z.diagonal().array() += 1;
  const Eigen::MatrixXd right = Z.rightCols(n);
  Eigen::MatrixXd P(n, n);
  for (Eigen::Index i = 0; i < n; ++i) P.col(i) = leastSquares(right, -Z.col(i));
  return .5 * (P + P.transpose());
  // <todo>
  //| // TODO: the Hamiltonian matrix (2 n x 2 n), its stable half, P.
  //| return Eigen::MatrixXd::Zero(plant.A.rows(), plant.A.rows());
  // </solution>
}

Eigen::MatrixXd gainOf(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& P) {
  // <solution gainOf>
  const Eigen::MatrixXd transposed = plant.B.transpose();
  return -solveMatrix(costs.R, transposed * P);
  // <todo>
  //| // TODO: 12.11.1 b. Mind the sign.
  //| return Eigen::MatrixXd::Zero(plant.B.cols(), plant.A.rows());
  // </solution>
}

Eigen::Vector4d stepped(const PoleCart& cart, const Eigen::Vector4d& x, double u, double tau, double noise,
                        Rng& rng) {
  // <solution stepped>
  Eigen::Vector4d next = x + tau * rateOf(cart, x, u);
  next[1] += noise * rng.normal();
  next[3] += noise * rng.normal();
  return next;
  // <todo>
  //| // TODO: a step of Euler, then the noise.
  //| return x;
  // </solution>
}

Eigen::MatrixXd balanced(const PoleCart& cart, const Eigen::MatrixXd& K, const Eigen::Vector4d& start,
                         const Outing& outing, Rng& rng) {
  // <solution balanced>
  Eigen::MatrixXd states(4, outing.steps + 1);
  states.col(0) = start;
  int t = 0;
  while (t < outing.steps && std::abs(states(2, t)) <= std::numbers::pi / 2) {
    const Eigen::Vector4d before = states.col(t);
    states.col(++t) = stepped(cart, before, K.row(0).dot(before), outing.tau, outing.noise, rng);
  }
  return states.leftCols(t + 1);
  // <todo>
  //| // TODO: control and step, until the time is over or the pole has fallen.
  //| return start;
  // </solution>
}

Eigen::MatrixXd reachMatrix(const Plant& plant) {
  // <solution reachMatrix>
  const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
  Eigen::MatrixXd C(n, n * m), block = plant.B;
  for (Eigen::Index k = 0; k < n; ++k) {
    C.middleCols(k * m, m) = block;
    block = plant.A * block;
  }
  return C;
  // <todo>
  //| // TODO: n blocks side by side. Each follows from the one before.
  //| return Eigen::MatrixXd::Zero(plant.A.rows(), plant.A.rows() * plant.B.cols());
  // </solution>
}

int reachable(const Plant& plant) {
  // <solution reachable>
  const Eigen::VectorXd sizes = svd(reachMatrix(plant)).s;
  int rank = 0;
  for (const double size : sizes) rank += size > 1e-9 * sizes[0];
  return rank;
  // <todo>
  //| // TODO: the rank of reachMatrix(). svd() gives singular values.
  //| return 0;
  // </solution>
}

double slowestPole(const Plant& plant, const Eigen::MatrixXd& K) {
  // <solution slowestPole>
  const Eigen::MatrixXd BK = plant.B * K;
  double slowest = -INFINITY;
  for (const std::complex<double>& pole : eigenvalues(plant.A + BK)) slowest = std::max(slowest, pole.real());
  return slowest;
  // <todo>
  //| // TODO: which matrix moves x if u = K x? eigenvalues() gives its poles.
  //| return 0;
  // </solution>
}

Fate fateOf(const Eigen::MatrixXd& A) {
  // <solution fateOf>
  const Eigen::VectorXcd poles = eigenvalues(A);
  const Eigen::MatrixXd AA = A * A;
  Fate fate = Fate::dies;
  for (const std::complex<double>& pole : poles) {
    if (pole.real() > 1e-5) return Fate::grows;
    if (pole.real() < -1e-5) continue;
    if (fate == Fate::dies) fate = Fate::stays;
    // Eigenvectors of i w and of -i w span the kernel of A^2 + w^2.
    const double w = std::abs(pole.imag());
    Eigen::MatrixXd M = w > 1e-4 ? AA : A;
    if (w > 1e-4) M.diagonal().array() += w * w;
    int times = 0, vectors = 0;
    for (const std::complex<double>& other : poles)
      times += std::abs(other.real()) < 1e-5 && std::abs(std::abs(other.imag()) - w) < 1e-4;
    for (const double size : svd(M).s) vectors += size < 1e-5;
    if (vectors < times) fate = Fate::grows;
  }
  return fate;
  // <todo>
  //| // TODO: 8:36 is not the whole truth on the imaginary axis.
  //| return Fate::dies;
  // </solution>
}

Eigen::MatrixXd quickGains(const std::function<double(const Eigen::MatrixXd&)>& slowest,
                           const Eigen::MatrixXd& start, double bound, Rng& rng) {
  // <solution quickGains>
  Eigen::MatrixXd best = start;
  double rate = slowest(start), size = bound / 10;
  int failures = 0;
  for (int asked = 1; asked < 3000; ++asked) {
    Eigen::MatrixXd K = best;
    for (double& k : K.reshaped()) k = std::clamp(k + size * rng.normal(), -bound, bound);
    const double found = slowest(K);
    if (found < rate) {
      best = K, rate = found, failures = 0, size *= 1.3;
    } else if (++failures > 50) {
      failures = 0, size /= 2;
      if (size < 1e-6 * bound) size = bound / 10;
    }
  }
  return best;
  // <todo>
  //| // TODO: a search. The best rate lies on an edge, where no step along one axis helps.
  //| return start;
  // </solution>
}

Eigen::MatrixXd unseen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C) {
  // <solution unseen>
  const Plant dual{A.transpose(), C.transpose()};
  const Eigen::MatrixXd U = svd(reachMatrix(dual)).U;
  return U.rightCols(A.rows() - reachable(dual));
  // <todo>
  //| // TODO: which plant reaches what y shows? The rest is orthogonal to it.
  //| return Eigen::MatrixXd::Zero(A.rows(), 0);
  // </solution>
}

Eigen::MatrixXd observerGain(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Noise& noise) {
  // <solution observerGain>
  const Plant dual{A.transpose(), C.transpose()};
  const Costs costs{noise.W, noise.V};
  return -gainOf(dual, costs, viaHamiltonian(dual, costs)).transpose();
  // <todo>
  //| // TODO: the problem of part 2 for another plant. Mind the sign.
  //| return Eigen::MatrixXd::Zero(A.rows(), C.rows());
  // </solution>
}

Eigen::MatrixXd observedLoop(const Plant& real, const Plant& model, const Eigen::MatrixXd& C,
                             const Eigen::MatrixXd& K, const Eigen::MatrixXd& L) {
  // <solution observedLoop>
  const Eigen::MatrixXd LC = L * C, modelBK = model.B * K, realBK = real.B * K;
  Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
  loop << real.A, realBK, LC, model.A + modelBK - LC;
  return loop;
  // <todo>
  //| // TODO: four blocks. What moves x, and what moves x^?
  //| return Eigen::MatrixXd::Zero(2 * real.A.rows(), 2 * real.A.rows());
  // </solution>
}

Eigen::MatrixXd responseAt(const Plant& plant, const Eigen::MatrixXd& C, const Eigen::VectorXd& frequencies) {
  // <solution responseAt>
  const Eigen::Index n = plant.A.rows();
  // (i w - A) (a + i b) = B, real and imaginary parts as unknowns of a system twice as large.
  Eigen::MatrixXd M(2 * n, 2 * n), right = Eigen::MatrixXd::Zero(2 * n, 1);
  M << -plant.A, Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), -plant.A;
  right.topRows(n) = plant.B;
  Eigen::MatrixXd G(2, frequencies.size());
  for (Eigen::Index k = 0; k < G.cols(); ++k) {
    for (Eigen::Index i = 0; i < n; ++i) M(i, n + i) = -frequencies[k], M(n + i, i) = frequencies[k];
    const Eigen::MatrixXd x = solveMatrix(M, right);
    G(0, k) = C.row(0).dot(x.col(0).head(n));
    G(1, k) = C.row(0).dot(x.col(0).tail(n));
  }
  return G;
  // <todo>
  //| // TODO: a linear system for each frequency. Its solution is complex.
  //| return Eigen::MatrixXd::Zero(2, frequencies.size());
  // </solution>
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  // Part 1: A and B by hand, by differences of your rateOf(), and by the library, which is used from there
  // on.
  const PoleCart cart;
  const Plant mine = linearised(cart), real = plantOfTheLibrary();
  print("A", mine.A);
  print("A by differences", differencesByState(cart));
  print("A of the library", real.A);
  print("B", mine.B.transpose());
  print("B of the library", real.B.transpose());

  // Part 2: the gains of the costs c = rho = 1, in four ways.
  const Costs costs{Eigen::Vector4d(1, 0, 1, 0).asDiagonal(), Eigen::MatrixXd::Identity(1, 1)};
  const Eigen::MatrixXd K = gainOf(real, costs, viaHamiltonian(real, costs));
  const Eigen::MatrixXd optimal = gainsOfTheLibrary(real, costs);
  const Eigen::MatrixXd printed = Eigen::RowVector4d(1, 3.8271, 48.307, 17.6159);
  if (const std::optional<Eigen::MatrixXd> P = iterated(real, costs, 1e-3, 1e-6, 100000))
    print("K by the iteration", gainOf(real, costs, *P));
  print("K by the Hamiltonian", K);
  print("K of the library", optimal);
  print("K of the sheet", printed);

  // Part 3: outings without noise, with noise, and beside the library's simulation.
  showOutings(K);
  showSurvival(K, printed);
  showBalance(K);

  // Part 4
  print("directions that u reaches, which should be 4", reachable(real));

  // Part 5
  print("slowest pole with your K, which should be -0.506 [1/s]", slowestPole(real, K));
  showFates();

  // No gain may be larger than the largest optimal one. All optimal gains are positive.
  Rng rng(2);
  const auto slowest = [&](const Eigen::MatrixXd& gains) { return slowestPole(real, gains); };
  const Eigen::MatrixXd quick = quickGains(slowest, optimal, optimal.maxCoeff(), rng);
  print("slowest pole with your quick K [1/s]", slowestPole(real, quick));
  print("slowest pole with the library's [1/s]", slowestOfTheLibrary(real, optimal));
  showPoles(real, K, printed, quick);
  showQuick(K, quick);

  // Part 6: which sensors suffice; then little noise, and sensors with errors of 2 mm and 2 mrad.
  const Eigen::MatrixXd position = Eigen::RowVector4d(1, 0, 0, 0), angle = Eigen::RowVector4d(0, 0, 1, 0);
  Eigen::MatrixXd both(2, 4);
  both << position, angle;
  print("what p alone does not show, which should be nothing", unseen(real.A, position));
  print("what theta alone does not show, which should be p and p'", unseen(real.A, angle));
  const Sensor ofP{"only p is seen", position, observerGain(real.A, position, noiseOfSteps(.005, .002, 1))};
  const Sensor ofBoth{"p and theta are seen", both, observerGain(real.A, both, noiseOfSteps(.005, .002, 2))};
  print("L, if only p is seen", ofP.L.transpose());
  print("L of the library",
        observerGainOfTheLibrary(real.A, position, noiseOfSteps(.005, .002, 1)).transpose());
  showSeen(K, ofP);
  showLoops(real, K, {ofBoth, ofP});
  showMargins(real, K, {ofBoth, ofP});
}
