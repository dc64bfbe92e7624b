#include "geometry/facet_hull.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "geometry/convex_hull_internal.h"

namespace rex {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFlatFacet = 1e-9, kSame = 1e-9, kClosed = 1e-7;
constexpr int kMostDimensions = 9;

void requirePoints(const MatrixArg& points) {
  if (points.rows() < 1 || points.rows() > kMostDimensions)
    throw Error({.what = "hull: dimension of the points",
                 .found = fmt::format("{}", points.rows()),
                 .wanted = fmt::format("1 to {}", kMostDimensions)});
  if (points.cols() > kMostFacetHullPoints)
    throw Error({.what = "hull",
                 .found = fmt::format("{} points", points.cols()),
                 .wanted = fmt::format("at most {}", kMostFacetHullPoints)});
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    requireFinite(fmt::format("hull: point {}", k), VectorXd(points.col(k)));
}

// qhull needs at least two dimensions; on a line, the hull consists of the two ends.
FacetHull lineHull(const MatrixXd& points) {
  FacetHull hull{.dimension = 1, .normals = MatrixXd(1, 2), .offsets = VectorXd(2)};
  hull.normals << 1, -1;
  hull.offsets << points.maxCoeff(), -points.minCoeff();
  hull.volume = hull.offsets.sum();
  return hull;
}

// The points without duplicates.
MatrixXd apart(const MatrixXd& points) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(points.cols())), kept;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return points(0, a) < points(0, b); });
  for (const Eigen::Index k : order) {
    bool isNew = true;
    for (auto near = kept.rbegin(); isNew && near != kept.rend(); ++near) {
      if (points(0, k) - points(0, *near) > kSame) break;
      isNew = (points.col(k) - points.col(*near)).squaredNorm() > kSame * kSame;
    }
    if (isNew) kept.push_back(k);
  }
  return points(Eigen::all, kept);
}

// Whether qhull has all facets: areas times normals of a closed surface add up to zero (Minkowski). If
// points almost coincide, merging can lose facets that matter.
bool isClosed(internal::Qhull& qhull) {
  qhT* qh = &qhull.state();  // the name that qhull's macros expect
  qh_getarea(qh, qh->facet_list);
  VectorXd sum = VectorXd::Zero(qh->hull_dim);
  facetT* facet;
  FORALLfacets sum += facet->f.area * Eigen::Map<const VectorXd>(facet->normal, qh->hull_dim);
  return sum.norm() <= kClosed * qh->totarea;
}

// The facets of the hull from those of map^T centred.
void addFacets(internal::Qhull& qhull, const MatrixXd& centred, const MatrixXd& map, FacetHull& hull) {
  const qhT* qh = &qhull.state();  // the name that qhull's macros expect
  hull.volume = qh->totvol / map.colwise().norm().prod();
  std::vector<VectorXd> normals;
  facetT* facet;
  FORALLfacets normals.emplace_back(map * Eigen::Map<const VectorXd>(facet->normal, map.cols()));
  hull.normals.resize(map.rows(), static_cast<Eigen::Index>(normals.size()));
  for (std::size_t f = 0; f < normals.size(); ++f)
    hull.normals.col(static_cast<Eigen::Index>(f)) = normals[f].normalized();
  hull.offsets.resize(hull.normals.cols());
  for (Eigen::Index f = 0; f < hull.normals.cols(); ++f)
    hull.offsets[f] = (hull.normals.col(f).transpose() * centred).maxCoeff();
}

}  // namespace

FacetHull facetHull(const MatrixArg& points) {
  requirePoints(points);
  FacetHull hull{.dimension = -1};
  if (points.cols() == 0) return hull;
  const VectorXd middle = points.rowwise().mean();
  const MatrixXd centred = points.colwise() - middle;
  const Eigen::JacobiSVD<MatrixXd> svd(centred.transpose(), Eigen::ComputeThinV);
  const VectorXd singular = svd.singularValues();
  const double smallest = std::max(kFlatFacet * singular[0], 1e-14 * points.cwiseAbs().maxCoeff());
  hull.dimension = static_cast<int>((singular.array() > smallest).count());
  if (hull.dimension < points.rows()) return hull;
  if (points.rows() == 1) return lineHull(points);
  // With equal widths along all axes, qhull can tell the facets of thin hulls from rounding.
  const VectorXd width = singular / std::sqrt(static_cast<double>(points.cols()));
  const MatrixXd map = svd.matrixV() * width.cwiseInverse().asDiagonal();
  MatrixXd round = apart(map.transpose() * centred);
  // Triangulated facets give the volume exactly; if rounding defeats qhull, it may shift the points by
  // ulps.
  for (const char* options : {"qhull Qt Q12 Pp", "qhull Qt Qx Q12 Pp", "qhull QJ Pp"}) {
    internal::Qhull qhull;
    if (!qhull.run(static_cast<int>(round.rows()), static_cast<int>(round.cols()), round.data(), options) ||
        !isClosed(qhull))
      continue;
    addFacets(qhull, centred, map, hull);
    hull.offsets += hull.normals.transpose() * middle;
    return hull;
  }
  assert(false && "points that fill space have a hull");
  return hull;
}

}  // namespace rex
