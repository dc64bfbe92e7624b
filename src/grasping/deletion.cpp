#include "grasping/deletion.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"
#include "grasping/centred_view_internal.h"

namespace rex {
namespace {

using Eigen::Index;

void requireOrder(std::span<const int> order, std::size_t contacts) {
  std::vector<int> sorted(order.begin(), order.end()), all(contacts);
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0);
  if (sorted != all)
    throw Error({.what = "deletion synthesis: order",
                 .found = fmt::format("{}", fmt::join(order, " ")),
                 .wanted = fmt::format("each contact from 0 to {} once", static_cast<long>(contacts) - 1)});
}

// The edges of the contacts that are kept.
Eigen::MatrixXd wrenchesOf(const WrenchSet& set, const std::vector<bool>& isKept) {
  std::vector<Index> columns;
  for (std::size_t j = 0; j < set.contact.size(); ++j)
    if (isKept[static_cast<std::size_t>(set.contact[j])]) columns.push_back(static_cast<Index>(j));
  return set.wrenches(Eigen::all, columns);
}

}  // namespace

DeletionSynthesis deleteRedundant(std::span<const WrenchCone> cones, std::span<const int> order, int edges) {
  requireOrder(order, cones.size());
  DeletionSynthesis result;
  const WrenchSet set = primitiveWrenches(cones, edges);
  if (cones.empty()) {
    result.status = ClosureStatus::kOpen;
    result.message = "there are no contacts";
    return result;
  }
  const internal::CentredView view = internal::centredView(cones);
  result.closure = internal::forceClosure(set.wrenches, view);
  result.status = result.closure.status;
  result.message = result.closure.message;
  if (result.status != ClosureStatus::kClosed) return result;
  std::vector<bool> isKept(cones.size(), true);
  for (const int contact : order) {
    isKept[static_cast<std::size_t>(contact)] = false;
    Closure rest = internal::forceClosure(wrenchesOf(set, isKept), view);
    if (rest.status == ClosureStatus::kClosed)
      result.closure = std::move(rest);
    else
      isKept[static_cast<std::size_t>(contact)] = true;
  }
  for (std::size_t i = 0; i < cones.size(); ++i)
    if (isKept[i]) result.kept.push_back(static_cast<int>(i));
  result.message = fmt::format("{} of {} contacts hold", result.kept.size(), cones.size());
  return result;
}

DeletionSynthesis deleteRedundant(std::span<const WrenchCone> cones, int edges) {
  std::vector<int> order(cones.size());
  std::iota(order.begin(), order.end(), 0);
  return deleteRedundant(cones, order, edges);
}

}  // namespace rex
