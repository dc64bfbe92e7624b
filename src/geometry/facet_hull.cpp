#include "geometry/facet_hull.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require_finite.h"
#include "geometry/qhull_internal.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFlat = 1e-9;
constexpr int kMostDimensions = 9;

void requirePoints(const MatrixArg& points) {
  if (points.rows() < 1 || points.rows() > kMostDimensions)
    throw Error({.what = "hull: size of the points",
                 .found = fmt::format("{}", points.rows()),
                 .wanted = fmt::format("1 to {}", kMostDimensions)});
  if (points.cols() > kMostFacetHullPoints)
    throw Error({.what = "hull",
                 .found = fmt::format("{} points", points.cols()),
                 .wanted = fmt::format("at most {}", kMostFacetHullPoints)});
  for (Index k = 0; k < points.cols(); ++k)
    requireFinite(fmt::format("hull: point {}", k), VectorXd(points.col(k)));
}

// qhull wants two dimensions or more; a line has its ends.
FacetHull lineHull(const MatrixXd& points) {
  FacetHull hull{.dimension = 1, .normals = MatrixXd(1, 2), .offsets = VectorXd(2)};
  hull.normals << 1, -1;
  hull.offsets << points.maxCoeff(), -points.minCoeff();
  hull.volume = hull.offsets.sum();
  return hull;
}

void addFacets(internal::Qhull& qhull, const MatrixXd& points, FacetHull& hull) {
  qhT* qh = &qhull.state();  // the name that qhull's macros expect
  qh_getarea(qh, qh->facet_list);
  hull.volume = qh->totvol;
  std::vector<VectorXd> normals;
  facetT* facet;
  FORALLfacets normals.emplace_back(Eigen::Map<const VectorXd>(facet->normal, points.rows()));
  hull.normals.resize(points.rows(), static_cast<Index>(normals.size()));
  for (std::size_t f = 0; f < normals.size(); ++f) hull.normals.col(static_cast<Index>(f)) = normals[f];
  hull.offsets.resize(hull.normals.cols());
  for (Index f = 0; f < hull.normals.cols(); ++f)
    hull.offsets[f] = (hull.normals.col(f).transpose() * points).maxCoeff();
}

}  // namespace

FacetHull facetHull(const MatrixArg& points) {
  requirePoints(points);
  FacetHull hull{.dimension = -1};
  if (points.cols() == 0) return hull;
  const VectorXd middle = points.rowwise().mean();
  MatrixXd centred = points.colwise() - middle;
  const VectorXd singular = Eigen::JacobiSVD<MatrixXd>(centred.transpose()).singularValues();
  const double smallest = std::max(kFlat * singular[0], 1e-14 * points.cwiseAbs().maxCoeff());
  hull.dimension = static_cast<int>((singular.array() > smallest).count());
  if (hull.dimension < points.rows()) return hull;
  if (points.rows() == 1) return lineHull(points);
  // Triangulated facets give the volume exactly; where rounding defeats qhull, it may shift points by ulps.
  for (const char* options : {"qhull Qt Q12 Pp", "qhull Qt Qx Q12 Pp", "qhull QJ Pp"}) {
    internal::Qhull qhull;
    if (!qhull.run(static_cast<int>(points.rows()), static_cast<int>(points.cols()), centred.data(), options))
      continue;
    addFacets(qhull, centred, hull);
    hull.offsets += hull.normals.transpose() * middle;
    return hull;
  }
  assert(false && "points that fill space have a hull");
  return hull;
}

}  // namespace rex
