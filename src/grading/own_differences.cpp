#include "grading/own_differences.h"

#include <optional>
#include <utility>

#include "base/derivative_check.h"

namespace rex::grading {

std::vector<Eigen::VectorXd> placesOfDifferences(const Eigen::VectorXd& x) {
  std::vector<Eigen::VectorXd> places;
  static_cast<void>(numericJacobian(
      [&](const Eigen::VectorXd& place) -> Eigen::VectorXd {
        places.push_back(place);
        return Eigen::VectorXd::Zero(1);
      },
      x));
  return places;
}

Eigen::MatrixXd finiteDifferences(std::span<const Eigen::VectorXd> values, const Eigen::VectorXd& x) {
  std::size_t next = 0;
  return numericJacobian([&](const Eigen::VectorXd&) { return values[next++]; }, x);
}

std::vector<Eigen::VectorXd> valuesInAnyOrder(Check& check, const std::string& property,
                                              std::span<const Eigen::VectorXd> places,
                                              const Eigen::VectorXd& first, const ValueAt& valueAt) {
  constexpr int kRepetitions = 4;  // of the first place, and as many of others
  Rng rng = check.rng().split(places.size());
  const int count = static_cast<int>(places.size());
  std::vector<int> order;
  for (int k = 0; k < count; ++k) order.push_back(k);
  for (int k = 0; k < kRepetitions; ++k) order.insert(order.end(), {0, rng.index(count)});
  for (int k = static_cast<int>(order.size()); k > 1; --k)
    std::swap(order[static_cast<std::size_t>(k) - 1], order[static_cast<std::size_t>(rng.index(k))]);
  std::vector<std::optional<Eigen::VectorXd>> values(places.size());
  check.askFreshWorker([&](remote::Caller& caller) {
    for (const int k : order) {
      const auto place = static_cast<std::size_t>(k);
      const Eigen::VectorXd value = valueAt(caller, places[place]);
      std::optional<Eigen::VectorXd>& known = values[place];
      if (k == 0 && !known) known = first;
      if (known) check.that(property + " is the same whenever it is asked for", *known == value);
      known = value;
    }
  });
  std::vector<Eigen::VectorXd> all;
  for (const auto& value : values) all.push_back(*value);
  return all;
}

namespace {

// Value and derivative as one column, for valuesInAnyOrder().
Eigen::VectorXd packed(const ValueAndDerivative& one) {
  Eigen::VectorXd all(one.value.size() + one.derivative.size());
  all << one.value, one.derivative.reshaped();
  return all;
}

}  // namespace

void requireIntegral(Check& check, const std::string& property, const Eigen::VectorXd& from,
                     const Eigen::VectorXd& to, const ValueAndDerivative& start,
                     const DerivativeAt& derivativeAt) {
  constexpr int kSteps = 50;
  constexpr double kMostShare = .1, kSmallestRange = 1e-9;
  std::vector<Eigen::VectorXd> places = {from, to};
  for (int k = 0; k < kSteps; ++k) places.emplace_back(from + (k + .5) / kSteps * (to - from));
  const Eigen::Index rows = start.value.size();
  const std::vector<Eigen::VectorXd> answers =
      valuesInAnyOrder(check, property + " and its derivative", places, packed(start),
                       [&](remote::Caller& caller, const Eigen::VectorXd& place) {
                         const ValueAndDerivative there = derivativeAt(caller, place);
                         check.shape(property, there.value, rows, 1);
                         check.shape("derivative of " + property, there.derivative, rows, from.size());
                         return packed(there);
                       });
  Eigen::VectorXd lowest = answers[0].head(rows), highest = lowest, integral = Eigen::VectorXd::Zero(rows);
  for (std::size_t k = 1; k < answers.size(); ++k) {
    lowest = lowest.cwiseMin(answers[k].head(rows));
    highest = highest.cwiseMax(answers[k].head(rows));
    if (k > 1)
      integral += answers[k].tail(rows * from.size()).reshaped(rows, from.size()) * (to - from) / kSteps;
  }
  const Eigen::ArrayXd change = (answers[1] - answers[0]).head(rows).array();
  const auto jumps = check.ask("Does it jump on the way, or is its derivative another one?");
  check.atMost(
      "change of " + property +
          " along a path, beside the integral of its derivative: their "
          "difference as a share of the range of the values",
      ((change - integral.array()).abs() / (highest - lowest).array().max(kSmallestRange)).maxCoeff(),
      kMostShare);
}

}  // namespace rex::grading
