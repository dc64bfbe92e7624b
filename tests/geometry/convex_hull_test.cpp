#include "geometry/convex_hull.h"

#include <set>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"
#include "support/mesh_samples.h"

namespace rex::convex_hull_test {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Key = std::array<float, 3>;

Key keyOf(const Vector3f& p) { return {p.x(), p.y(), p.z()}; }

std::vector<Vector3f> randomPoints(Rng& rng, int count, const Vector3d& size = Vector3d::Ones(),
                                   const Vector3d& offset = Vector3d::Zero()) {
  std::vector<Vector3f> points;
  for (int i = 0; i < count; ++i)
    points.push_back((offset + size.cwiseProduct(Vector3d(rng.normalVector(3)))).cast<float>());
  return points;
}

// Of a square with diagonals of 1 m, and a point that far above its middle.
std::size_t trianglesAbove(float height) {
  constexpr float h = 0.5F;
  return convexHull(std::vector<Vector3f>{{h, 0, 0}, {-h, 0, 0}, {0, h, 0}, {0, -h, 0}, {0, 0, height}})
      .triangles()
      .size();
}

TEST(ConvexHull, IsFlatBelowATenMillionthOfTheSize) {
  EXPECT_EQ(trianglesAbove(0.9e-7F), 4u) << "two triangles, from both sides";
  EXPECT_EQ(trianglesAbove(1.1e-7F), 6u) << "a pyramid on two triangles";
}

// How far a point stands out of a hull, in parts of the size of it.
double outside(const TriangleMesh& hull, std::span<const Vector3f> points) {
  double size = 0, most = 0;
  for (const Vector3f& p : hull.positions())
    size = std::max(size, (p - hull.positions()[0]).cast<double>().norm());
  for (const auto& [a, b, c] : hull.triangles()) {
    const Vector3d origin = hull.positions()[a].cast<double>();
    const Vector3d normal =
        (hull.positions()[b].cast<double>() - origin).cross(hull.positions()[c].cast<double>() - origin);
    // The plane of a needle says nothing.
    if (normal.norm() < 1e-9 * size * size) continue;
    for (const Vector3f& p : points)
      most = std::max(most, normal.normalized().dot(p.cast<double>() - origin));
  }
  return most / size;
}

// Closed and of one piece like a sphere, of input points, and around all of them.
void expectHull(const TriangleMesh& hull, std::span<const Vector3f> points) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> used;
  for (const auto& triangle : hull.triangles())
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(edges.emplace(triangle[k], triangle[(k + 1) % 3]).second)
          << "an edge twice in one direction";
      used.insert(triangle[k]);
    }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a})) << "an open edge";
  const long V = static_cast<long>(hull.positions().size()), E = static_cast<long>(edges.size()) / 2,
             F = static_cast<long>(hull.triangles().size());
  EXPECT_EQ(V - E + F, 2);
  EXPECT_EQ(static_cast<long>(used.size()), V);
  std::set<Key> known, once;
  for (const Vector3f& p : points) known.insert(keyOf(p));
  for (const Vector3f& p : hull.positions()) {
    EXPECT_TRUE(known.contains(keyOf(p))) << "a vertex that is not an input";
    EXPECT_TRUE(once.insert(keyOf(p)).second) << "a vertex twice";
  }
  for (const Vector3f& n : hull.normals()) EXPECT_NEAR(n.norm(), 1, 1e-5);
  EXPECT_LT(outside(hull, points), 1e-6);
}

TEST(ConvexHull, HoldsAllPointsAndIsMadeOfSome) {
  Rng rng(31);
  for (int i = 0; i < 40; ++i) {
    const Vector3d size(1, i % 3 == 0 ? 1e-3 : 1, i % 5 == 0 ? 100 : 1);
    const auto points =
        randomPoints(rng, 4 + 10 * i, size, i % 2 == 0 ? Vector3d(0, 0, 0) : Vector3d(300, 0, -5));
    const TriangleMesh hull = convexHull(points);
    expectHull(hull, points);
    EXPECT_GT(volumeOf(hull), 0);
  }
}

// A triple of points is a face when all others lie on one side of it.
TEST(ConvexHull, AgreesWithTryingAllTriples) {
  Rng rng(32);
  for (int round = 0; round < 10; ++round) {
    const auto points = randomPoints(rng, 4 + 4 * round);
    std::set<std::set<Key>> wanted, found;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j)
        for (std::size_t k = j + 1; k < points.size(); ++k) {
          const Vector3d a = points[i].cast<double>(),
                         normal = (points[j].cast<double>() - a).cross(points[k].cast<double>() - a);
          int above = 0, below = 0;
          for (std::size_t m = 0; m < points.size(); ++m)
            if (m != i && m != j && m != k) (normal.dot(points[m].cast<double>() - a) > 0 ? above : below)++;
          if (above == 0 || below == 0) wanted.insert({keyOf(points[i]), keyOf(points[j]), keyOf(points[k])});
        }
    const TriangleMesh hull = convexHull(points);
    for (const auto& [a, b, c] : hull.triangles())
      found.insert({keyOf(hull.positions()[a]), keyOf(hull.positions()[b]), keyOf(hull.positions()[c])});
    EXPECT_EQ(found, wanted);
  }
}

TEST(ConvexHull, OfKnownSolids) {
  BareMesh cube = cubeSample(0.5f);
  for (float x = -0.5f; x <= 0.5f; x += 0.125f)  // on faces, on edges and inside
    for (float y = -0.5f; y <= 0.5f; y += 0.125f)
      cube.positions.insert(cube.positions.end(), {{x, y, 0.5f}, {x, 0, y}});
  const TriangleMesh box = convexHull(cube.positions);
  expectHull(box, cube.positions);
  EXPECT_NEAR(volumeOf(box), 1, 1e-12);
  EXPECT_EQ(box.positions().size(), 8u);
  EXPECT_EQ(box.triangles().size(), 12u);

  const BareMesh sphere = sphereSample(2, 4);
  const TriangleMesh ball = convexHull(sphere.positions);
  expectHull(ball, sphere.positions);
  EXPECT_EQ(ball.positions().size(), sphere.positions.size());
  EXPECT_NEAR(volumeOf(ball), 4 * std::numbers::pi / 3 * 8, 0.3);
  for (std::size_t i = 0; i < ball.normals().size(); ++i)
    EXPECT_GT(ball.normals()[i].dot(ball.positions()[i].normalized()), 0.99f);

  std::vector<Vector3f> cylinder;
  for (int i = 0; i < 360; ++i)
    for (const float z : {0.f, 1.f})
      cylinder.emplace_back(std::cos(i * std::numbers::pi / 180), std::sin(i * std::numbers::pi / 180), z);
  expectHull(convexHull(cylinder), cylinder);
  EXPECT_NEAR(volumeOf(convexHull(cylinder)), 180 * std::sin(std::numbers::pi / 180), 1e-5);
}

TEST(ConvexHull, OfALatticeIsABox) {
  std::vector<Vector3f> lattice;
  for (int i = 0; i < 1000; ++i)
    lattice.push_back(Eigen::Vector3i(i % 10, i / 10 % 10, i / 100).cast<float>() * 0.1f);
  const TriangleMesh hull = convexHull(lattice);
  expectHull(hull, lattice);
  EXPECT_NEAR(volumeOf(hull), 0.729, 1e-6);
}

TEST(ConvexHull, OfWhatFillsNoSpace) {
  EXPECT_TRUE(convexHull(TriangleMesh()).isEmpty());
  const std::vector<Vector3f> one(5, Vector3f(1, 2, 3));
  EXPECT_EQ(convexHull(one).positions().size(), 1u);
  std::vector<Vector3f> line, plane;
  Rng rng(33);
  for (int i = 0; i < 50; ++i) {
    line.push_back(Vector3f(1, 2, 3) + Vector3f(0.3f, -0.5f, 0.25f) * static_cast<float>(i % 7));
    plane.emplace_back(rng.uniform(-1, 1), rng.uniform(-1, 1), 4);
  }
  const TriangleMesh ends = convexHull(line);
  ASSERT_EQ(ends.positions().size(), 2u);
  EXPECT_NEAR((ends.positions()[0] - ends.positions()[1]).norm(), 6 * std::sqrt(0.09 + 0.25 + 0.0625), 1e-5);
  EXPECT_TRUE(ends.triangles().empty());
  plane.insert(plane.end(), {{-1, -1, 4}, {1, -1, 4}, {1, 1, 4}, {-1, 1, 4}, {0, -1, 4}});
  const TriangleMesh square = convexHull(plane);
  expectHull(square, plane);
  EXPECT_EQ(square.positions().size(), 4u);
  EXPECT_NEAR(areaOf(square), 8, 1e-6) << "both sides";
  EXPECT_EQ(volumeOf(square), 0);
}

TEST(ConvexHull, OfTinyAndThinOnes) {
  Rng rng(34);
  for (const double scale : {1e-30, 1e-6, 1e6})
    for (const double thin : {1e-9, 1e-7, 2e-7, 1e-5}) {
      const auto points = randomPoints(rng, 60, scale * Vector3d(1, 1, thin));
      expectHull(convexHull(points), points);
    }
}

TEST(ConvexHull, IsTheSameEachTime) {
  Rng rng(35);
  const auto points = randomPoints(rng, 500);
  const TriangleMesh a = convexHull(points), b = convexHull(points);
  EXPECT_TRUE(
      std::equal(a.positions().begin(), a.positions().end(), b.positions().begin(), b.positions().end()));
  EXPECT_TRUE(
      std::equal(a.triangles().begin(), a.triangles().end(), b.triangles().begin(), b.triangles().end()));
}

TEST(ConvexHull, RefusesWhatIsNotFinite) {
  const std::vector<Vector3f> points = {{0, 0, 0}, {0, NAN, 0}};
  EXPECT_REX_ERROR(convexHull(points), "mesh: found vertex 1 = (0, nan, 0), wanted finite numbers");
  std::vector<Vector3f> many(200'001);
  for (std::size_t k = 0; k < many.size(); ++k) many[k].setConstant(static_cast<float>(k / 2));
  EXPECT_REX_ERROR(convexHull(many), "convex hull: found 100001 different points, wanted at most 100000");
  many.pop_back();
  EXPECT_EQ(convexHull(many).positions().size(), 2u);
}

}  // namespace rex::convex_hull_test
