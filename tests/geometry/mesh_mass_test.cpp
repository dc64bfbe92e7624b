#include "geometry/mesh_mass.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/convex_hull.h"
#include "geometry/welded_mesh.h"
#include "support/block_surface.h"

namespace rex::mesh_mass_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TriangleMesh meshOf(const BareMesh& bare) { return weldedMesh(bare.positions, bare.triangles); }
TriangleMesh meshOf(const std::vector<BlockFace>& faces) { return meshOf(trianglesOf(faces)); }

void expectNear(const MassProperties& all, const MassProperties& wanted, double tolerance) {
  EXPECT_NEAR(all.mass, wanted.mass, tolerance * wanted.mass);
  EXPECT_LT((all.p_BBcm - wanted.p_BBcm).norm(), tolerance);
  EXPECT_LT((all.I_BBcm_B - wanted.I_BBcm_B).norm(), tolerance * wanted.I_BBcm_B.norm())
      << all.I_BBcm_B << "\n\n"
      << wanted.I_BBcm_B;
}

TEST(MeshMass, OfABox) {
  const TriangleMesh mesh = meshOf(facesOf({{0, 0, 0}}, {{{1, 3}, {0, 4}, {0, 6}}}));
  const Vector3d center(2, 2, 3);
  for (const MeshMassRule rule : {MeshMassRule::kEnclosed, MeshMassRule::kUnsigned})
    expectNear(meshMass(mesh, rule), {48, center, Vector3d(208, 160, 80).asDiagonal()}, 1e-12);
  // Faces of 24, 12 and 8 m^2; x x^T of each pair is its distance, or as a plate.
  const Vector3d seconds(48 + 24. / 3 + 16. / 3, 4 * (48. / 3 + 24 + 16. / 3), 9 * (48. / 3 + 24. / 3 + 16));
  expectNear(meshMass(mesh, MeshMassRule::kShell),
             {88, center, (Vector3d::Constant(seconds.sum()) - seconds).asDiagonal()}, 1e-12);
}

TEST(MeshMass, OfASphere) {
  const TriangleMesh mesh = meshOf(sphereSample(.5, 6));
  const double ball = std::numbers::pi / 6, sphere = std::numbers::pi;
  for (const MeshMassRule rule : {MeshMassRule::kEnclosed, MeshMassRule::kUnsigned})
    expectNear(meshMass(mesh, rule), {ball, Vector3d::Zero(), ball * .1 * Matrix3d::Identity()}, 1e-3);
  expectNear(meshMass(mesh, MeshMassRule::kShell),
             {sphere, Vector3d::Zero(), sphere / 6 * Matrix3d::Identity()}, 1e-3);
}

// The pyramids over whole faces from a tip.
struct Pyramids {
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
};
Pyramids pyramidsFrom(const Vector3d& tip, const std::vector<BlockFace>& faces, bool isUnsigned) {
  Pyramids all;
  for (const BlockFace& face : faces) {
    const Vector3d c = face.center - tip;
    double volume = face.normal().dot(c) * face.area() / 3;
    if (isUnsigned) volume = std::abs(volume);
    all.volume += volume;
    all.first += .75 * volume * c;
    all.second +=
        .6 * volume * (c * c.transpose() + (face.u * face.u.transpose() + face.v * face.v.transpose()) / 3);
  }
  return all;
}
MassProperties byPyramids(const std::vector<BlockFace>& faces, bool isUnsigned) {
  Vector3d middle = Vector3d::Zero();
  double area = 0;
  for (const BlockFace& face : faces) {
    middle += face.area() * face.center;
    area += face.area();
  }
  middle /= area;
  const Pyramids one = pyramidsFrom(middle, faces, isUnsigned);
  const Vector3d center = middle + one.first / one.volume;
  const Pyramids other = pyramidsFrom(center, faces, isUnsigned);
  return {other.volume, center, other.second.trace() * Matrix3d::Identity() - other.second};
}

TEST(MeshMass, AgreesWithPyramidsOverFaces) {
  const std::array<std::vector<double>, 3> lines = {{{0, 1, 2.5, 3}, {0, .5, 2, 3}, {-1, 1, 2, 4}}};
  Rng rng(3);
  for (int i = 0; i < 20; ++i) {
    std::vector<std::array<int, 3>> blocks;
    for (int k = 0; k < 27; ++k)
      if (rng.uniform() < .6) blocks.push_back({k % 3, k / 3 % 3, k / 9});
    std::vector<BlockFace> faces = facesOf(blocks, lines);
    for (const bool open : {false, true}) {
      if (open) std::erase_if(faces, [](const BlockFace& face) { return face.normal().x() < -.5; });
      const TriangleMesh mesh = meshOf(faces);
      expectNear(meshMass(mesh, MeshMassRule::kEnclosed), byPyramids(faces, false), 1e-12);
      expectNear(meshMass(mesh, MeshMassRule::kUnsigned), byPyramids(faces, true), 1e-12);
    }
  }
}

TEST(MeshMass, CountsTooMuchWithoutSigns) {
  const TriangleMesh mesh = meshOf(profileSample(false));
  EXPECT_NEAR(meshMass(mesh, MeshMassRule::kEnclosed).mass, 4, 1e-12);
  EXPECT_NEAR(meshMass(mesh, MeshMassRule::kUnsigned).mass, 4.161340544083906, 1e-12) << "MuJoCo 3.3.8";
}

TEST(MeshMass, IsNoneOfWhatEnclosesNothing) {
  const BareMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (const MeshMassRule rule : {MeshMassRule::kEnclosed, MeshMassRule::kUnsigned}) {
    EXPECT_EQ(meshMass({}, rule).mass, 0);
    EXPECT_EQ(meshMass(meshOf(flat), rule).mass, 0);
  }
  EXPECT_NEAR(meshMass(meshOf(flat), MeshMassRule::kShell).mass, .5, 1e-12);
  std::vector<BlockFace> inverted = profileSample(true);
  for (BlockFace& face : inverted) std::swap(face.u, face.v);
  EXPECT_EQ(meshMass(meshOf(inverted), MeshMassRule::kEnclosed).mass, 0);
}

TEST(MeshHoles, AreNoneInClosedSurfaces) {
  for (const BareMesh& mesh : {cubeSample(1), sphereSample(1, 3), trianglesOf(profileSample(false))})
    EXPECT_FALSE(volumeWithoutHoles(meshOf(mesh))) << mesh.triangles.size();
}

// Two triangles of the surface fewer, another one inverted, or cracks.
TEST(MeshHoles, AreClosedByCaps) {
  const Vector3d away(5, -3, 2);
  std::vector<BlockFace> faces = facesOf({{0, 0, 0}}, {{{0, 1}, {0, 2}, {0, 3}}});
  for (BlockFace& face : faces) face.center += away;
  const auto without = [&](const std::vector<std::size_t>& gone) {
    std::vector<BlockFace> rest;
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (std::find(gone.begin(), gone.end(), i) == gone.end()) rest.push_back(faces[i]);
    return trianglesOf(rest);
  };
  const auto expectSix = [](const BareMesh& mesh, const char* what) {
    const std::optional<double> volume = volumeWithoutHoles(meshOf(mesh));
    ASSERT_TRUE(volume) << what;
    EXPECT_NEAR(*volume, 6, 1e-6) << what;
  };
  expectSix(without({0}), "open at one end");
  expectSix(without({0, 1}), "open at both ends");
  EXPECT_NEAR(meshMass(meshOf(without({0, 1})), MeshMassRule::kUnsigned).mass, 4, 1e-12)
      << "a tube; all tips in it give the same";
  for (std::size_t i = 0; i < 12; ++i) {
    BareMesh mesh = without({});
    std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
    expectSix(mesh, "one triangle inverted");
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(i));
    expectSix(mesh, "one triangle missing");
  }
  // Two holes with one corner in common.
  const auto sharedCorners = [](const BareMesh& mesh, std::size_t i, std::size_t j) {
    int count = 0;
    for (const auto a : mesh.triangles[i])
      for (const auto b : mesh.triangles[j]) count += mesh.positions[a] == mesh.positions[b] ? 1 : 0;
    return count;
  };
  int touching = 0;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      BareMesh mesh = without({});
      if (sharedCorners(mesh, i, j) != 1) continue;
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(i));
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(j));
      expectSix(mesh, "two holes that touch");
      ++touching;
    }
  EXPECT_GT(touching, 10);
  // An edge from one open end to the other with vertices on one side only.
  BareMesh cracked = without({0, 1});
  const std::vector<BlockFace> tube = {faces.begin() + 2, faces.end()};
  cracked = trianglesOf({tube.begin() + 1, tube.end()});
  const BlockFace& cut = tube.front();
  const bool alongU = std::abs(cut.u.x()) > 0;
  for (const int part : {-2, -1, 0, 1, 2}) {
    BlockFace piece = cut;
    (alongU ? piece.u : piece.v) /= 5;
    piece.center += part * 2 * (alongU ? piece.u : piece.v);
    const BareMesh two = trianglesOf({piece});
    for (const auto& triangle : two.triangles) {
      TriangleMesh::Triangle shifted = triangle;
      for (std::uint32_t& corner : shifted) corner += static_cast<std::uint32_t>(cracked.positions.size());
      cracked.triangles.push_back(shifted);
    }
    cracked.positions.insert(cracked.positions.end(), two.positions.begin(), two.positions.end());
  }
  expectSix(cracked, "cracks from end to end");
}

// The mesh of a hull of random points, against the sum over a lattice.
TEST(MeshMass, AgreesWithALattice) {
  Rng rng(8);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 12; ++i) points.push_back(rng.normalVector(3).cast<float>() + Eigen::Vector3f(1, 2, 3));
  const TriangleMesh hull = convexHull(points);
  const MassProperties all = meshMass(hull, MeshMassRule::kEnclosed);
  const auto isInside = [&](const Eigen::Vector3d& p) {
    return std::all_of(hull.triangles().begin(), hull.triangles().end(),
                       [&](const TriangleMesh::Triangle& t) {
                         const Eigen::Vector3d a = hull.positions()[t[0]].cast<double>(),
                                               b = hull.positions()[t[1]].cast<double>(),
                                               c = hull.positions()[t[2]].cast<double>();
                         return (b - a).cross(c - a).dot(p - a) <= 0;
                       });
  };
  double mass = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  constexpr int kSteps = 80;
  constexpr double kStep = 8. / kSteps;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const Eigen::Vector3d p =
        kStep * Eigen::Vector3d(i % kSteps + .5, i / kSteps % kSteps + .5, i / kSteps / kSteps + .5) +
        Eigen::Vector3d(-3, -2, -1);
    if (!isInside(p)) continue;
    const double part = kStep * kStep * kStep;
    mass += part;
    first += part * p;
    second += part * p * p.transpose();
  }
  const Eigen::Vector3d center = first / mass;
  const Eigen::Matrix3d C = second - mass * center * center.transpose();
  EXPECT_NEAR(all.mass, mass, .02 * mass);
  EXPECT_LT((all.p_BBcm - center).norm(), .02);
  EXPECT_LT((all.I_BBcm_B - (C.trace() * Eigen::Matrix3d::Identity() - C)).norm(), .03 * all.I_BBcm_B.norm());
}

}  // namespace rex::mesh_mass_test
