#include "planning/validity.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {

AllValid eachColumn(std::function<bool(const VectorArg& q)> isValid) {
  return [isValid = std::move(isValid)](const MatrixArg& Q) {
    for (Eigen::Index k = 0; k < Q.cols(); ++k)
      if (!isValid(Q.col(k))) return false;
    return true;
  };
}

AllValid whereClear(std::function<double(const VectorArg& q)> clearance) {
  return eachColumn([clearance = std::move(clearance)](const VectorArg& q) {
    const double gap = clearance(q);
    if (std::isnan(gap)) {
      throw Error({.what = fmt::format("clearance at ({:.4g})", fmt::join(q.begin(), q.end(), ", ")),
                   .found = "not a number",
                   .wanted = "metres, positive where the configuration is valid"});
    }
    return gap > 0;
  });
}

}  // namespace rex
