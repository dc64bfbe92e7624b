#include "course/search_cma.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

int orUsual(int number) { return number == -1 ? 0 : number; }

}  // namespace

void SearchCma::init(int D, int mu, int lambda, double lo, double hi) {
  requireCount("init: D", D, 1);
  if (!(hi > lo))
    throw Error({.what = "init: lo and hi",
                 .found = fmt::format("{:g} and {:g}", lo, hi),
                 .wanted = "the lower one first"});
  init(rng_.uniformVector(D, lo, hi), mu, lambda, hi - lo);
}

void SearchCma::init(const Eigen::VectorXd& start, int mu, int lambda, double deviation) {
  init(start, mu, lambda, Eigen::VectorXd::Constant(start.size(), deviation));
}

void SearchCma::init(const Eigen::VectorXd& start, int mu, int lambda, const Eigen::VectorXd& deviations) {
  strategy_.emplace(start, deviations, CmaOptions{.lambda = orUsual(lambda), .mu = orUsual(mu)});
  hasSampled_ = false;
}

const CmaEs& SearchCma::strategy() const {
  if (!strategy_) throw Error({.what = "SearchCma", .found = "no earlier init()", .wanted = "init(D)"});
  return *strategy_;
}

void SearchCma::step(Eigen::MatrixXd& samples, Eigen::VectorXd& values) {
  if (hasSampled_) {
    requireSize("step: rows of samples", samples.rows(), strategy().lambda());
    requireSize("step: columns of samples", samples.cols(), strategy().dimension());
    requireSize("step: values", values.size(), strategy().lambda());
    columns_ = samples.transpose();
  } else {
    (void)strategy();  // throws without one
    values.resize(0);  // those of an earlier search
  }
  strategy_->step(columns_, values, rng_);
  hasSampled_ = true;
  samples = columns_.transpose();
}

Eigen::VectorXd SearchCma::getBestSample() const { return strategy().result().x; }

Eigen::VectorXd SearchCma::getMean() const { return strategy().mean(); }

}  // namespace rex
