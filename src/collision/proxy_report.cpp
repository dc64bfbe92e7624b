#include "collision/proxy_report.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace rex {
namespace {

std::string pointText(const Eigen::Vector3d& p) {
  // Numbers that round to zero lose their sign.
  const auto rounded = [](double x) { return std::abs(x) < 5e-5 ? 0. : x; };
  return fmt::format("{:9.4f} {:8.4f} {:8.4f}", rounded(p.x()), rounded(p.y()), rounded(p.z()));
}

}  // namespace

std::string shapeLabel(const Model& model, int shape) {
  const auto until = std::span(model.shapes()).first(static_cast<std::size_t>(shape) + 1);
  const ModelShape& chosen = until.back();
  const bool isNamed = !chosen.name.empty();
  // Shapes that are only visual are not counted among shapes in contact, although they may have the same
  // name.
  const auto isAlike = [&](const ModelShape& one) {
    return one.body == chosen.body && one.name == chosen.name && (!isNamed || one.contact == chosen.contact);
  };
  if (isNamed && std::ranges::count_if(model.shapes(), isAlike) == 1) return chosen.name;
  return fmt::format("{}#{}", isNamed ? chosen.name : model[chosen.body].name,
                     std::ranges::count_if(until, isAlike));
}

std::string proxyReport(const Model& model, std::span<const Proxy> proxies) {
  std::vector<Proxy> sorted(proxies.begin(), proxies.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const Proxy& one, const Proxy& other) {
    const double d = one.proximity.distance, e = other.proximity.distance;
    return d < e || (std::isnan(d) && !std::isnan(e));
  });
  std::vector<std::string> names = {"pair"};
  for (const Proxy& one : sorted)
    names.push_back(shapeLabel(model, one.pair.a) + " - " + shapeLabel(model, one.pair.b));
  std::size_t width = 0;
  for (const std::string& name : names) width = std::max(width, name.size());

  std::string text = fmt::format("{:{}} {:>9} {:>27} {:>27}\n", names[0], width, "distance",
                                 "point of the first", "point of the second");
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Proximity& near = sorted[i].proximity;
    text += fmt::format("{:{}} {:>9.4f} {} {}\n", names[i + 1], width, near.distance, pointText(near.p_WA),
                        pointText(near.p_WB));
  }
  return text;
}

}  // namespace rex
