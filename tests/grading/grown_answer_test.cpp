#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grading/grown_answers.h"
#include "remote/layout.h"
#include "remote/wire.h"

namespace rex::grading::grown_answer_test {

struct MapValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

const Eigen::Vector2d kQuestion(.25, .5);

template <class T>
T grownTo(const T& honest, Growth growth, bool isPlain = false, double place = 0,
          const Eigen::VectorXd& q = kQuestion) {
  remote::Writer answer, question;
  remote::Wire<T>::put(answer, honest);
  remote::Wire<Eigen::VectorXd>::put(question, q);
  const std::vector<std::string> layouts = {remote::Layout<T>::text(),
                                            remote::Layout<Eigen::VectorXd>::text()};
  const std::vector<std::byte> bytes =
      grown(answer.bytes(), question.bytes(), layouts, {growth, isPlain, place});
  remote::Reader reader(bytes);
  T said = remote::Wire<T>::get(reader);
  reader.expectEnd();
  return said;
}

TEST(Grown, MakesNumbersHugeOrTiny) {
  const std::vector<double> honest{1, -2, 0};
  using ::testing::ElementsAre;
  EXPECT_THAT(grownTo(honest, Growth::kHuge), ElementsAre(1e9, -2e9, 0));
  EXPECT_THAT(grownTo(honest, Growth::kHuge, true), ElementsAre(3, -6, 0));
  EXPECT_THAT(grownTo(honest, Growth::kTiny), ElementsAre(1e-9, -2e-9, 0));
  EXPECT_THAT(grownTo(honest, Growth::kTiny, true), ElementsAre(1. / 3, -2. / 3, 0));
  EXPECT_THAT(grownTo(honest, Growth::kOneHuge, false, .5), ElementsAre(1, -2e9, 0));
  EXPECT_THAT(grownTo(honest, Growth::kOneHuge, false, 1), ElementsAre(1, -2, 1e9));
  EXPECT_THAT(grownTo(honest, Growth::kOneHuge, true, 1), ElementsAre(1, -2, 3));
  EXPECT_THAT(grownTo(std::vector<int>{3}, Growth::kHuge), ElementsAre(3));
}

// The new component is a function of the question, and its row of J is that function's derivative. The other
// rows are wrong.
TEST(Grown, AddsASteepComponent) {
  const MapValue honest{Eigen::Vector2d(1, 2), (Eigen::Matrix2d() << 1, 2, 3, 4).finished()};
  const MapValue said = grownTo(honest, Growth::kSteep);
  ASSERT_EQ(said.y.size(), 3);
  EXPECT_EQ(said.y.head<2>(), honest.y);
  ASSERT_EQ(said.J.rows(), 3);
  EXPECT_EQ(said.J.row(2), Eigen::RowVector2d(1e9, 1e9));
  EXPECT_NEAR(said.J(0, 1), 2 + .01 * 3, 1e-12);
  const Eigen::Vector2d step(1e-3, 0);
  const MapValue ahead = grownTo(honest, Growth::kSteep, false, 0, kQuestion + step);
  EXPECT_NEAR(ahead.y[2] - said.y[2], said.J.row(2) * step, 1e-3);
  const MapValue plain = grownTo(honest, Growth::kSteep, true);
  EXPECT_EQ(plain.y, honest.y);
  EXPECT_EQ(plain.J, said.J.topRows(2));
}

TEST(Grown, AddsEntriesRowsAndElements) {
  EXPECT_EQ(grownTo(std::vector<double>{1}, Growth::kSteep).size(), 2u);
  EXPECT_EQ(grownTo(std::vector<double>{1}, Growth::kSteep, true).size(), 1u);
  EXPECT_EQ(grownTo(Eigen::MatrixXd(Eigen::MatrixXd::Ones(2, 3)), Growth::kSteep).rows(), 3);
  const Eigen::Matrix3d fixed = grownTo(Eigen::Matrix3d(Eigen::Matrix3d::Ones()), Growth::kSteep);
  EXPECT_NEAR(fixed(1, 1), 1.02, 1e-12);
  EXPECT_TRUE(grownTo(std::vector<double>{}, Growth::kSteep).empty());
}

}  // namespace rex::grading::grown_answer_test
