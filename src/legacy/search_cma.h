#pragma once

#include "course/search_cma.h"
#include "legacy/array.h"

namespace rex::legacy {

/// course/search_cma.h with arrays: a sample in each row of `samples`.
class SearchCMA {
 public:
  void init(uint dimensions, int mu = -1, int lambda = -1, double low = -1, double high = 1);
  void init(const arr& start, int mu, int lambda, double deviation);
  void step(arr& samples, arr& values);
  void getBestSample(arr& x) const { x = arr(search_.getBestSample()); }
  void getMean(arr& x) const { x = arr(search_.getMean()); }

 private:
  SearchCma search_;
};

}  // namespace rex::legacy
