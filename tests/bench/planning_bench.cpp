#include <string>
#include <vector>

#include "bench/arm_plans.h"
#include "bench/row.h"

namespace rex::bench {
namespace {

// A seed is soon done or takes long: medians need many.
Row connectRow(const std::string& name, const ArmPlan& plan, const ContactScene& scene, double target,
               int seeds) {
  return {name, ourConnect(plan), "OMPL+FCL", omplConnect(scene, plan), target, "ms", seeds, true};
}

}  // namespace

std::vector<Row> planningRows() {
  const ContactScene scene;
  return {connectRow("rrt-connect-tip", tipInHole(scene), scene, 0.1, 201),
          connectRow("rrt-connect-peg", pegInHole(scene), scene, 0.25, 41)};
}

}  // namespace rex::bench
