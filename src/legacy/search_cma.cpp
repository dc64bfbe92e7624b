#include "legacy/search_cma.h"

namespace rex::legacy {

void SearchCMA::init(uint dimensions, int mu, int lambda, double low, double high) {
  search_.init(static_cast<int>(dimensions), mu, lambda, low, high);
}

void SearchCMA::init(const arr& start, int mu, int lambda, double deviation) {
  search_.init(start.vector(), mu, lambda, deviation);
}

void SearchCMA::step(arr& samples, arr& values) {
  Eigen::MatrixXd rows;
  Eigen::VectorXd costs;
  if (samples.nd != 0) rows = samples.matrix();
  if (values.nd != 0) costs = values.vector();
  search_.step(rows, costs);
  samples = arr(rows);
  values = arr(costs);
}

}  // namespace rex::legacy
