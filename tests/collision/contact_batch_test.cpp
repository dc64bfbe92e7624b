#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/contacts.h"
#include "formats/ors_reader.h"
#include "support/paths.h"

namespace rex::contact_batch_test {

// The arm and the frame of pegInAHole, and a box, a ball, a rounded box and a cylinder at its links.
Model crowdedArm() {
  SceneSpec spec = readOrs(sourcePath("data/robots/pegInAHole.ors")).spec;
  constexpr ShapeType kTypes[] = {ShapeType::kBox, ShapeType::kSphere, ShapeType::kRoundedBox,
                                  ShapeType::kCylinder};
  std::size_t next = 0;
  for (BodySpec& body : spec.bodies) {
    for (ShapeSpec& shape : body.shapes) shape.contact = shape.shape.type != ShapeType::kMarker;
    if (!body.name.starts_with("arm")) continue;
    body.shapes.push_back({.name = "",
                           .X_BS = translation(0.1, 0.05, 0.1),
                           .shape = {.type = kTypes[next++ % 4], .extent = {0.2, 0.3, 0.25}, .radius = 0.1},
                           .contact = true});
  }
  return compile(spec);
}

class ContactBatch : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    Rng rng(81);
    Q.resize(model.nq(), GetParam());
    for (auto q : Q.colwise()) q = rng.uniformVector(model.nq(), -1.5, 1.5);
    forwardKinematicsBatch(model, Q, poses);
  }

  // Of configuration k, by one query for each.
  [[nodiscard]] std::vector<Proxy> single(int k) const {
    return proxies(contacts, forwardKinematics(model, Q.col(k)), 1e3);
  }

  const Model model = crowdedArm();
  const ContactModel contacts{model};
  Eigen::MatrixXd Q;
  PoseBatch poses;
};

TEST_P(ContactBatch, MeasuresAsSingleQueriesDo) {
  Eigen::MatrixXd distances;
  contactDistancesBatch(contacts, poses, distances);
  ASSERT_EQ(distances.rows(), static_cast<Eigen::Index>(contacts.pairs().size()));
  ASSERT_EQ(distances.cols(), GetParam());
  for (int k = 0; k < GetParam(); ++k) {
    const std::vector<Proxy> wanted = single(k);
    ASSERT_EQ(wanted.size(), contacts.pairs().size());
    for (std::size_t row = 0; row < wanted.size(); ++row)
      EXPECT_NEAR(distances(static_cast<Eigen::Index>(row), k), wanted[row].proximity.distance, 1e-14);
  }
}

TEST_P(ContactBatch, IsFreeWhereAllDistancesAre) {
  Eigen::MatrixXd distances;
  contactDistancesBatch(contacts, poses, distances);
  int freeOnes = 0;
  std::vector<int> order;
  for (const double margin : {-0.3, -0.22, -0.1, 0., 0.1, 0.2}) {
    Eigen::Array<bool, Eigen::Dynamic, 1> free;
    contactFreeBatch(contacts, poses, margin, free);
    ASSERT_EQ(free.size(), GetParam());
    for (int k = 0; k < GetParam(); ++k) {
      EXPECT_EQ(free[k], (distances.col(k).array() >= margin).all()) << k;
      freeOnes += free[k];
    }
    EXPECT_EQ(allContactFree(contacts, poses, margin), free.all());
    for (int again = 0; again < 3; ++again)
      EXPECT_EQ(allContactFree(contacts, poses, margin, order), free.all());
  }
  if (GetParam() < 64) return;
  EXPECT_GT(freeOnes, GetParam());
  EXPECT_LT(freeOnes, 6 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(OfAllSizes, ContactBatch, testing::Values(0, 1, 7, 8, 9, 100));

TEST(ContactBatchOfNoNumbers, IsNotFree) {
  const Model model = compile(readOrs(sourcePath("data/robots/pegInAHole.ors")).spec);
  const ContactModel contacts(model);
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(model.nq(), 10);
  Q(2, 9) = std::nan("");
  PoseBatch poses;
  forwardKinematicsBatch(model, Q, poses);
  Eigen::Array<bool, Eigen::Dynamic, 1> free;
  contactFreeBatch(contacts, poses, 0, free);
  EXPECT_TRUE(free.head(9).all());
  EXPECT_FALSE(free[9]);
}

// A solid that slides along x, and one that stands.
Model sliding(const Shape& slider, const Shape& stand) {
  SceneSpec spec;
  spec.bodies.push_back(
      {.name = "slider",
       .X_WB = {},
       .shapes = {{.name = "", .X_BS = translation(0, 0.01, 0.02), .shape = slider, .contact = true}}});
  spec.worldShapes.push_back({.name = "", .X_BS = {}, .shape = stand, .contact = true});
  spec.joints.push_back({.name = "slide",
                         .parent = "world",
                         .child = "slider",
                         .type = JointType::kSlider,
                         .X_PF = {},
                         .X_MC = {},
                         .axis = Eigen::Vector3d::UnitX()});
  return compile(spec);
}

Shape shapeOf(ShapeType type, double radius) {
  Shape shape{.type = type, .extent = {0.6, 0.5, 0.4}, .radius = radius};
  if (usesMesh(type))
    shape.mesh = TriangleMesh({{0.3f, 0, 0}, {-0.2f, 0.2f, 0}, {-0.2f, -0.2f, 0}, {0, 0, 0.4f}}, {}, {});
  return shape;
}

class ContactBatchPair : public testing::TestWithParam<std::tuple<ShapeType, ShapeType>> {
 protected:
  [[nodiscard]] Model model(double radius) const {
    const auto [slider, stand] = GetParam();
    return sliding(shapeOf(slider, radius), shapeOf(stand, 0.1));
  }
  [[nodiscard]] static ContactModel contacts(const Model& model) {
    const ShapePair pair{0, 1};
    return ContactModel(model, std::span(&pair, 1));
  }
};

// Also of points, and at margins that leave only points of a ball.
TEST_P(ContactBatchPair, IsFreeWhereItsDistanceIs) {
  for (const double radius : {0., 0.1}) {
    const Model model = this->model(radius);
    const ContactModel contacts = this->contacts(model);
    PoseBatch poses;
    forwardKinematicsBatch(model, Eigen::RowVectorXd::LinSpaced(101, -2, 2), poses);
    Eigen::MatrixXd distances;
    contactDistancesBatch(contacts, poses, distances);
    EXPECT_LT(distances.minCoeff(), 0);
    EXPECT_GT(distances.maxCoeff(), 0.5);
    Eigen::Array<bool, Eigen::Dynamic, 1> free;
    for (const double margin : {-0.3, -0.2, -0.1, 0., 0.1, 0.3, distances(0, 3), distances(0, 60)}) {
      contactFreeBatch(contacts, poses, margin, free);
      for (int k = 0; k < poses.count(); ++k)
        EXPECT_EQ(free[k], distances(0, k) >= margin) << margin << ' ' << distances(0, k);
    }
  }
}

TEST_P(ContactBatchPair, IsNotFreeWhereItIsNoNumber) {
  const Model model = this->model(0.1);
  const ContactModel contacts = this->contacts(model);
  PoseBatch poses;
  Eigen::RowVectorXd Q = Eigen::RowVectorXd::Constant(10, 5);
  Q[3] = std::nan("");
  forwardKinematicsBatch(model, Q, poses);
  Eigen::MatrixXd distances;
  contactDistancesBatch(contacts, poses, distances);
  for (const double margin : {-1., 0., 1.}) {
    Eigen::Array<bool, Eigen::Dynamic, 1> free;
    contactFreeBatch(contacts, poses, margin, free);
    for (int k = 0; k < 10; ++k) {
      EXPECT_EQ(std::isnan(distances(0, k)), k == 3);
      EXPECT_EQ(free[k], k != 3);
    }
    EXPECT_FALSE(allContactFree(contacts, poses, margin));
  }
  const std::vector<Proxy> near = proxies(contacts, forwardKinematics(model, Q.col(3)));
  ASSERT_EQ(near.size(), 1u);
  EXPECT_TRUE(std::isnan(near[0].proximity.distance));
}

constexpr ShapeType kSolidTypes[] = {ShapeType::kBox,        ShapeType::kSphere,   ShapeType::kCapsule,
                                     ShapeType::kRoundedBox, ShapeType::kCylinder, ShapeType::kMesh};
INSTANTIATE_TEST_SUITE_P(OfAllTypes, ContactBatchPair,
                         testing::Combine(testing::ValuesIn(kSolidTypes), testing::ValuesIn(kSolidTypes)),
                         [](const auto& i) {
                           std::string name = std::string(toString(std::get<0>(i.param))) + "And" +
                                              std::string(toString(std::get<1>(i.param)));
                           std::erase(name, ' ');
                           return name;
                         });

TEST(ContactBatchOfNone, TakesModelsWithoutPairs) {
  const Model model = compile(readOrs(sourcePath("data/robots/man.ors")).spec);
  const ContactModel contacts(model);
  PoseBatch poses;
  forwardKinematicsBatch(model, Eigen::MatrixXd::Zero(model.nq(), 3), poses);
  Eigen::MatrixXd distances;
  contactDistancesBatch(contacts, poses, distances);
  EXPECT_EQ(distances.rows(), 0);
  EXPECT_EQ(distances.cols(), 3);
  EXPECT_TRUE(allContactFree(contacts, poses, 1));
}

}  // namespace rex::contact_batch_test
