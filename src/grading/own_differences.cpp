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

}  // namespace rex::grading
