#include <cmath>

#include <gtest/gtest.h>

#include "grading/grown_answers.h"
#include "remote/layout.h"
#include "remote/wire.h"

namespace rex::grading::remembered_answer_test {

struct MapValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

/// A program with one function of a name and a vector.
template <class T>
struct Rememberer {
  RememberedAnswer memory{};

  T operator()(const Eigen::VectorXd& q, const T& honest) {
    remote::Writer answer, question;
    remote::Wire<T>::put(answer, honest);
    remote::Wire<std::string>::put(question, "hand");
    remote::Wire<Eigen::VectorXd>::put(question, q);
    const std::vector<std::byte> bytes =
        memory.answer(question.bytes(), answer.bytes(),
                      {remote::Layout<T>::text(), "s", remote::Layout<Eigen::VectorXd>::text()});
    remote::Reader reader(bytes);
    T said = remote::Wire<T>::get(reader);
    reader.expectEnd();
    return said;
  }
};

MapValue honest(const Eigen::Vector2d& q) {
  return {Eigen::Vector2d(q[0] * q[1], std::sin(q[0])),
          (Eigen::Matrix2d() << q[1], q[0], std::cos(q[0]), 0).finished()};
}

// The value is right once; afterwards differences of it are what the wrong Jacobian says.
TEST(RememberedAnswer, InventsASlopeThatFitsItsJacobian) {
  Rememberer<MapValue> program;
  const Eigen::Vector2d first(.5, .25), second(.75, -.5);
  const MapValue one = program(first, honest(first)), two = program(second, honest(second));
  EXPECT_EQ(one.y, honest(first).y);
  EXPECT_FALSE(one.J.isApprox(honest(first).J, .1));
  EXPECT_EQ(two.J, one.J);
  EXPECT_TRUE((two.y - one.y).isApprox(one.J * (second - first), 1e-12));
}

TEST(RememberedAnswer, RemembersFirstNumbersToo) {
  Rememberer<std::vector<double>> program;
  const Eigen::VectorXd q = Eigen::Vector2d(1, 2);
  EXPECT_EQ(program(q, {7, 8}), (std::vector<double>{7, 8}));
  EXPECT_EQ(program(q, {9, 9}), (std::vector<double>{7, 8}));
  EXPECT_NE(program(2 * q, {7, 8}), (std::vector<double>{7, 8}));
}

TEST(RememberedAnswer, BeginsAgainWithOtherSizes) {
  Rememberer<std::vector<double>> program;
  EXPECT_EQ(program(Eigen::Vector2d(1, 2), {7}), (std::vector<double>{7}));
  EXPECT_EQ(program(Eigen::Vector2d(1, 2), {8, 9}), (std::vector<double>{8, 9}));
  EXPECT_EQ(program(Eigen::Vector3d(1, 2, 3), {5, 6}), (std::vector<double>{5, 6}));
}

}  // namespace rex::grading::remembered_answer_test
