#include "geometry/mesh_mass.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "geometry/welded_mesh_internal.h"

namespace rex {

InertiaFault inertiaFault(const Eigen::Matrix3d& I) {
  constexpr double kForgiven = 1e-6;
  const Eigen::Vector3d moments = principalMoments(I);
  const double slack = kForgiven * moments.cwiseAbs().sum();
  if (moments[0] < -slack) return InertiaFault::kNegative;
  if (moments[2] > moments[0] + moments[1] + slack) return InertiaFault::kTriangle;
  return InertiaFault::kNone;
}

Eigen::Vector3d principalMoments(const Eigen::Matrix3d& I) {
  return I.selfadjointView<Eigen::Lower>().eigenvalues();
}

Eigen::Matrix3d nearestWithoutNegativeMoments(const Eigen::Matrix3d& I) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(I);
  const Eigen::Matrix3d& R = principal.eigenvectors();
  const Eigen::Matrix3d nearest = R * principal.eigenvalues().cwiseMax(0).asDiagonal() * R.transpose();
  return (nearest + nearest.transpose()) / 2;
}

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The integrals of 1, x and x x^T over what weighs, x from a tip.
struct Integrals {
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
};

Integrals integralsFrom(const Vector3d& tip, const TriangleMesh& mesh, MeshMassRule rule) {
  const bool isShell = rule == MeshMassRule::kShell;
  Integrals all;
  for (const TriangleMesh::Triangle& corners : mesh.triangles()) {
    Matrix3d T;
    for (int k = 0; k < 3; ++k)
      T.col(k) = mesh.positions()[corners[static_cast<std::size_t>(k)]].cast<double>() - tip;
    const Vector3d sum = T.rowwise().sum();
    double volume =
        isShell ? (T.col(1) - T.col(0)).cross(T.col(2) - T.col(0)).norm() / 2 : T.determinant() / 6;
    if (rule == MeshMassRule::kUnsigned) volume = std::abs(volume);
    all.volume += volume;
    all.first += volume / (isShell ? 3 : 4) * sum;
    all.second += volume / (isShell ? 12 : 20) * (T * T.transpose() + sum * sum.transpose());
  }
  return all;
}

// Directed edges between places.
struct MeshEdge {
  std::uint32_t from, to;
};

// What is left of the edges of all triangles after each has cancelled one in the other direction, in the
// order of their beginnings. At each place as many begin as end.
std::vector<MeshEdge> rims(const TriangleMesh& mesh, std::span<const std::uint32_t> placeOf) {
  std::vector<std::pair<std::uint64_t, bool>> edges;  // the two places, smaller first; whether that way
  edges.reserve(3 * mesh.triangles().size());
  for (const TriangleMesh::Triangle& corners : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = placeOf[corners[k]], b = placeOf[corners[(k + 1) % 3]];
      if (a != b) edges.emplace_back(std::min(a, b) << 32 | std::max(a, b), a < b);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<MeshEdge> left;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    const std::uint64_t key = edges[begin].first;
    std::ptrdiff_t forward = 0;
    for (; end < edges.size() && edges[end].first == key; ++end) forward += edges[end].second ? 1 : -1;
    const auto low = static_cast<std::uint32_t>(key >> 32), high = static_cast<std::uint32_t>(key);
    left.insert(left.end(), static_cast<std::size_t>(std::abs(forward)),
                forward > 0 ? MeshEdge{low, high} : MeshEdge{high, low});
  }
  std::stable_sort(left.begin(), left.end(),
                   [](const MeshEdge& a, const MeshEdge& b) { return a.from < b.from; });
  return left;
}

// The volume of the cone from the origin to a cap: triangles from a rim, which goes round the surface as its
// triangles do, to the middle of the rim.
double coneToCap(std::span<const Vector3d> rim) {
  Vector3d middle = Vector3d::Zero();
  double length = 0, six = 0;
  const auto next = [&](std::size_t i) -> const Vector3d& { return rim[(i + 1) % rim.size()]; };
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const double step = (next(i) - rim[i]).norm();
    middle += step * (rim[i] + next(i)) / 2;
    length += step;
  }
  middle /= length;
  for (std::size_t i = 0; i < rim.size(); ++i) six += next(i).dot(rim[i].cross(middle));
  return six / 6;
}

// Walks along edges, and cuts off a rim whenever it comes to a place again.
double conesToCaps(std::span<const MeshEdge> edges, std::span<const Vector3d> places) {
  constexpr std::size_t kNot = static_cast<std::size_t>(-1);
  std::vector<std::size_t> nextEdge(places.size() + 1, 0);  // the first unused one of each place
  for (const MeshEdge& edge : edges) ++nextEdge[edge.from + 1];
  std::partial_sum(nextEdge.begin(), nextEdge.end(), nextEdge.begin());
  std::vector<std::size_t> atStep(places.size(), kNot);
  std::vector<std::uint32_t> way;
  std::vector<Vector3d> rim;
  double volume = 0;
  const auto isUsed = [&](std::uint32_t place) {
    return nextEdge[place] == edges.size() || edges[nextEdge[place]].from != place;
  };
  for (const MeshEdge& start : edges) {
    if (isUsed(start.from)) continue;
    way.assign(1, start.from);
    atStep[start.from] = 0;
    while (!way.empty() && !isUsed(way.back())) {
      const std::uint32_t to = edges[nextEdge[way.back()]++].to;
      if (atStep[to] == kNot) {
        atStep[to] = way.size();
        way.push_back(to);
        continue;
      }
      rim.clear();
      for (std::size_t i = atStep[to]; i < way.size(); ++i) rim.push_back(places[way[i]]);
      volume += coneToCap(rim);
      for (; way.back() != to; way.pop_back()) atStep[way.back()] = kNot;
    }
    for (const std::uint32_t place : way) atStep[place] = kNot;
  }
  return volume;
}

}  // namespace

MassProperties meshMass(const TriangleMesh& mesh, MeshMassRule rule) {
  constexpr double kLeast = 1e-15;
  const Integrals surface = integralsFrom(Vector3d::Zero(), mesh, MeshMassRule::kShell);
  if (!(surface.volume > kLeast)) return {};
  MassProperties all;
  all.p_BBcm = surface.first / surface.volume;
  if (rule != MeshMassRule::kShell) {
    const Integrals solid = integralsFrom(all.p_BBcm, mesh, rule);
    if (!(solid.volume > kLeast)) return {};
    all.p_BBcm += solid.first / solid.volume;
  }
  const Integrals about = integralsFrom(all.p_BBcm, mesh, rule);
  if (!(about.volume > kLeast)) return {};
  all.mass = about.volume;
  all.I_BBcm_B = about.second.trace() * Matrix3d::Identity() - about.second;
  return all;
}

std::optional<double> volumeWithoutHoles(const TriangleMesh& mesh) {
  const MeshPlaces found = findPlaces(mesh.positions());
  const std::vector<MeshEdge> edges = rims(mesh, found.placeOf);
  if (edges.empty()) return {};
  const Vector3d origin = found.positions[edges.front().from].cast<double>();
  std::vector<Vector3d> places;
  places.reserve(found.positions.size());
  for (const Eigen::Vector3f& position : found.positions) places.push_back(position.cast<double>() - origin);
  return integralsFrom(origin, mesh, MeshMassRule::kEnclosed).volume + conesToCaps(edges, places);
}

}  // namespace rex
