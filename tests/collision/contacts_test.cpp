#include "collision/contacts.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "formats/ors_reader.h"
#include "geometry/rotation.h"
#include "scene/state.h"
#include "support/convex_solid.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::contacts_test {

Model pegInAHole() { return compile(readOrs(sourcePath("data/robots/pegInAHole.ors")).spec); }

Eigen::VectorXd vectorFrom(const nlohmann::json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Our place of each recorded shape: recorded in file order, which is that of a body's shapes for us as well.
std::vector<int> placesOf(const nlohmann::json& recorded, const Model& model) {
  std::vector<int> places;
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const std::string body = recorded[i].at("body");
    const auto before = std::count_if(recorded.begin(), recorded.begin() + static_cast<long>(i),
                                      [&](const nlohmann::json& shape) { return shape.at("body") == body; });
    int place = -1;
    for (long seen = -1; seen < before;)
      seen += model[model.shapes()[static_cast<std::size_t>(++place)].body].name == body;
    places.push_back(place);
  }
  return places;
}

// Of a pair of a capsule and a box.
double radiusOf(const Model& model, const ShapePair& pair) {
  const auto radius = [&](int i) { return model.shapes()[static_cast<std::size_t>(i)].shape.radius; };
  return std::max(radius(pair.a), radius(pair.b));
}

// Numbers recorded from an independent implementation. It knows no depth of a capsule's core, and counts
// overlap as distance zero in its cost.
TEST(Contacts, AreThoseRecordedOfPegInAHole) {
  std::ifstream file(sourcePath("tests/golden/pegInAHole.json"));
  const nlohmann::json golden = nlohmann::json::parse(file);
  const Model model = pegInAHole();
  const ContactModel contacts(model);
  const std::vector<int> places = placesOf(golden.at("shapes"), model);
  ASSERT_GE(golden.at("contacts_exact").size(), 20u);
  for (const nlohmann::json& posture : golden["contacts_exact"]) {
    std::map<std::pair<int, int>, double> wanted;
    for (const nlohmann::json& pair : posture.at("pairs"))
      wanted[std::minmax(places.at(pair.at("a")), places.at(pair.at("b")))] = pair.at("d");
    const BodyPoses poses = forwardKinematics(model, vectorFrom(posture.at("q")));
    const std::vector<Proxy> near = proxies(contacts, poses);
    const double margin = posture.at("margin");
    ASSERT_EQ(near.size(), wanted.size());
    double clampedCost = 0, cost = 0;
    for (const auto& [pair, proximity] : near) {
      ASSERT_TRUE(wanted.contains(std::pair(pair.a, pair.b)));
      EXPECT_NEAR(std::max(proximity.distance, -radiusOf(model, pair)), wanted.at(std::pair(pair.a, pair.b)),
                  1e-9);
      clampedCost += std::clamp(1 - proximity.distance / margin, 0., 1.);
      cost += std::max(0., 1 - proximity.distance / margin);
    }
    EXPECT_NEAR(clampedCost, posture.at("cost_slide").get<double>(), 1e-9);
    EXPECT_NEAR(contactCost(contacts, poses, margin), cost, 1e-12);
  }
}

TEST(Contacts, AreThoseOfAllPairsNearerThanTheCutoff) {
  Rng rng(61);
  const Model model = pegInAHole();
  const ContactModel contacts(model);
  for (int i = 0; i < 50; ++i) {
    const BodyPoses poses = forwardKinematics(model, rng.uniformVector(model.nq(), -2, 2));
    std::vector<Proxy> all;
    for (const ShapePair& pair : contacts.pairs()) {
      const ModelShape& a = model.shapes()[static_cast<std::size_t>(pair.a)];
      const ModelShape& b = model.shapes()[static_cast<std::size_t>(pair.b)];
      all.push_back({pair, proximity(a.shape, poses[a.body] * a.X_BS, b.shape, poses[b.body] * b.X_BS)});
    }
    for (const double cutoff : {-0.05, 0.02, 0.3, 2.}) {
      std::vector<Proxy> wanted;
      for (const Proxy& proxy : all)
        if (proxy.proximity.distance < cutoff) wanted.push_back(proxy);
      const std::vector<Proxy> found = proxies(contacts, poses, cutoff);
      ASSERT_EQ(found.size(), wanted.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k].pair, wanted[k].pair);
        EXPECT_EQ(found[k].proximity.distance, wanted[k].proximity.distance);
        EXPECT_EQ(found[k].proximity.p_WA, wanted[k].proximity.p_WA);
        EXPECT_EQ(found[k].proximity.normal_W, wanted[k].proximity.normal_W);
      }
    }
  }
}

// Two bodies that move freely, each of one shape that is not in the middle.
Model twoFreeBodies(const Shape& a, const Shape& b, Rng& rng) {
  SceneSpec spec;
  for (const Shape* shape : {&a, &b}) {
    BodySpec body{.name = shape == &a ? "a" : "b", .X_WB = {}};
    body.shapes.push_back({.name = "",
                           .X_BS = {expSO3(rng.normalVector(3)), rng.uniformVector(3, -0.1, 0.1)},
                           .shape = *shape,
                           .contact = true});
    spec.joints.push_back({.name = body.name,
                           .parent = "world",
                           .child = body.name,
                           .type = JointType::kFree,
                           .X_PF = {},
                           .X_MC = {}});
    spec.bodies.push_back(body);
  }
  return compile(spec);
}

Shape shapeOf(ShapeType type) {
  if (type == ShapeType::kMesh) {
    Rng rng(66);  // of many, one whose pairs lie farther than a step from where nearest points jump
    return randomConvexShape(rng, type);
  }
  const double radius = type == ShapeType::kCone ? 0.25 : 0.1;
  return {.type = type, .extent = {0.3, 0.4, 0.5}, .radius = radius};
}

// How differences are taken, and how far they may be off.
struct Precision {
  double step = 1e-5;  // small, because faces, edges and corners take turns at being nearest
  double tolerance = 1e-7;
};
// Where the curved side of a cylinder or a cone is nearest, the slack of the distance, 1e-10 m apart and 5e-7
// m in overlap, leaves its root in the direction.
Precision precisionOf(ShapeType a, ShapeType b, double distance) {
  const auto isCurved = [](ShapeType type) {
    return type == ShapeType::kCylinder || type == ShapeType::kCone;
  };
  if (!isCurved(a) && !isCurved(b)) return {};
  return distance > 0 ? Precision{1e-5, 5e-5} : Precision{1e-4, 1e-2};
}

class ContactDerivative : public testing::TestWithParam<std::tuple<ShapeType, ShapeType, double>> {
 protected:
  // Along v, which for quaternions is not the same as along q.
  void expectDerivative(const Model& model, const Eigen::VectorXd& q, const Eigen::MatrixXd& J,
                        const Precision& precision, const std::function<double(const BodyPoses&)>& f) {
    const VectorFunction alongV = [&](const Eigen::VectorXd& v) {
      return Eigen::VectorXd::Constant(1, f(forwardKinematics(model, integrate(model, q, v))));
    };
    const Eigen::MatrixXd differences =
        numericJacobian(alongV, Eigen::VectorXd::Zero(model.nv()), precision.step);
    EXPECT_LE((J - differences).cwiseAbs().maxCoeff(), precision.tolerance) << J << "\nand\n" << differences;
  }
};

TEST_P(ContactDerivative, AgreesWithDifferences) {
  const auto [typeA, typeB, size] = GetParam();
  Rng rng(62);
  int overlaps = 0;
  for (int i = 0; i < 30; ++i) {
    const Model model = twoFreeBodies(shapeOf(typeA), shapeOf(typeB), rng);
    const ContactModel contacts(model);
    const Eigen::VectorXd v = size * rng.normalVector(model.nv()) * (i % 2 == 0 ? 0.3 : 0.6);
    const Eigen::VectorXd q = integrate(model, model.initialPositions(), v);
    const BodyPoses poses = forwardKinematics(model, q);
    const Proxy proxy = proxies(contacts, poses, 1e3).at(0);
    overlaps += proxy.proximity.distance < 0;
    const Precision precision = precisionOf(typeA, typeB, proxy.proximity.distance);
    expectDerivative(
        model, q, distanceJacobian(model, poses, proxy, contacts), precision,
        [&](const BodyPoses& at) { return proxies(contacts, at, 1e3).at(0).proximity.distance; });
    TaskValue value;
    contactTask(contacts, 10)({model, q, poses}, value);
    EXPECT_EQ(value.y[0], contactCost(contacts, poses, 10));
    expectDerivative(model, q, value.J, precision,
                     [&](const BodyPoses& at) { return contactCost(contacts, at, 10); });
  }
  EXPECT_GT(overlaps, size < 1 ? 25 : 0);
}

constexpr ShapeType kTypes[] = {ShapeType::kBox,        ShapeType::kSphere,   ShapeType::kCapsule,
                                ShapeType::kRoundedBox, ShapeType::kCylinder, ShapeType::kCone,
                                ShapeType::kMesh};
INSTANTIATE_TEST_SUITE_P(AtZeroTinyAndRandom, ContactDerivative,
                         testing::Combine(testing::ValuesIn(kTypes), testing::ValuesIn(kTypes),
                                          testing::Values(0., 1e-8, 1.)));

TEST(ContactTask, IsZeroExactlyWhereAllAreApart) {
  const Model model = pegInAHole();
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
  const BodyPoses poses = forwardKinematics(model, q);
  const ContactModel contacts(model);
  TaskValue value;
  contactTask(contacts)({model, q, poses}, value);
  EXPECT_EQ(value.y, Eigen::VectorXd::Zero(1));
  EXPECT_EQ(value.J, Eigen::MatrixXd::Zero(1, model.nv()));
}

TEST(ContactCost, IsNoNumberWhereThePostureIsNone) {
  const Model model = pegInAHole();
  Eigen::VectorXd q = model.initialPositions();
  q[2] = std::nan("");
  EXPECT_TRUE(std::isnan(contactCost(ContactModel(model), forwardKinematics(model, q))));
}

TEST(ContactCost, NeedsAPositiveMargin) {
  const Model model = pegInAHole();
  const ContactModel contacts(model);
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  for (const double margin : {0., -1., std::nan(""), HUGE_VAL}) {
    EXPECT_REX_ERROR(contactCost(contacts, poses, margin), "margin of contact costs: found ");
    EXPECT_REX_ERROR(contactTask(contacts, margin), ", wanted a positive, finite number of metres");
  }
}

}  // namespace rex::contacts_test
