#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"

using namespace rex;

Eigen::Vector4d rateOf(const PoleCart& cart, const Eigen::Vector4d& x, double u) {
  // TODO: eq. (13), then eq. (14), which needs the result.
  return Eigen::Vector4d::Zero();
}

Plant linearised(const PoleCart& cart) {
  // TODO: which entries of A and B are not zero? The rows are in the order of x.
  return {Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1)};
}

std::optional<Eigen::MatrixXd> iterated(const Plant& plant, const Costs& costs, double epsilon,
                                        double tolerance, int most) {
  // TODO: the bracket of P, and from it the next P.
  return {};
}

Eigen::MatrixXd viaHamiltonian(const Plant& plant, const Costs& costs) {
  // TODO: the Hamiltonian matrix (2 n x 2 n), its stable half, P.
  return Eigen::MatrixXd::Zero(plant.A.rows(), plant.A.rows());
}

Eigen::MatrixXd gainOf(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& P) {
  // TODO: 12.11.1 b. Mind the sign.
  return Eigen::MatrixXd::Zero(plant.B.cols(), plant.A.rows());
}

Eigen::Vector4d stepped(const PoleCart& cart, const Eigen::Vector4d& x, double u, double tau, double noise,
                        Rng& rng) {
  // TODO: a step of Euler, then the noise.
  return x;
}

Eigen::MatrixXd balanced(const PoleCart& cart, const Eigen::MatrixXd& K, const Eigen::Vector4d& start,
                         const Outing& outing, Rng& rng) {
  // TODO: control and step, until the time is over or the pole has fallen.
  return start;
}

Eigen::MatrixXd reachMatrix(const Plant& plant) {
  // TODO: n blocks side by side. Each follows from the one before.
  return Eigen::MatrixXd::Zero(plant.A.rows(), plant.A.rows() * plant.B.cols());
}

int reachable(const Plant& plant) {
  // TODO: the rank of reachMatrix(). svd() gives singular values.
  return 0;
}

double slowestPole(const Plant& plant, const Eigen::MatrixXd& K) {
  // TODO: which matrix moves x if u = K x? eigenvalues() gives its poles.
  return 0;
}

Fate fateOf(const Eigen::MatrixXd& A) {
  // TODO: 8:36 is not the whole truth on the imaginary axis.
  return Fate::dies;
}

Eigen::MatrixXd quickGains(const std::function<double(const Eigen::MatrixXd&)>& slowest,
                           const Eigen::MatrixXd& start, double bound, Rng& rng) {
  // TODO: a search. The best rate lies on an edge, where no step along one axis helps.
  return start;
}

Eigen::MatrixXd unseen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C) {
  // TODO: which plant reaches what y shows? The rest is orthogonal to it.
  return Eigen::MatrixXd::Zero(A.rows(), 0);
}

Eigen::MatrixXd observerGain(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Noise& noise) {
  // TODO: the problem of part 2 for another plant. Mind the sign.
  return Eigen::MatrixXd::Zero(A.rows(), C.rows());
}

Eigen::MatrixXd observedLoop(const Plant& real, const Plant& model, const Eigen::MatrixXd& C,
                             const Eigen::MatrixXd& K, const Eigen::MatrixXd& L) {
  // TODO: four blocks. What moves x, and what moves x^?
  return Eigen::MatrixXd::Zero(2 * real.A.rows(), 2 * real.A.rows());
}

Eigen::MatrixXd responseAt(const Plant& plant, const Eigen::MatrixXd& C, const Eigen::VectorXd& frequencies) {
  // TODO: a linear system for each frequency. Its solution is complex.
  return Eigen::MatrixXd::Zero(2, frequencies.size());
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
