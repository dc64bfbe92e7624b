#include <cmath>
#include <limits>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grading/answer_value.h"
#include "grading/hostile_answers.h"
#include "remote/layout.h"
#include "remote/wire.h"
#include "support/expect_error.h"

namespace rex::grading::spoilt_answer_test {

struct Sample {
  std::vector<double> list;
  Eigen::MatrixXd matrix;
  Eigen::Vector3d place;
  std::optional<int> chosen;
  bool yes = true;
  std::string text;
};

const Sample kHonest = {.list = {1, 2, 3, 4},
                        .matrix = Eigen::MatrixXd::Constant(2, 3, 5),
                        .place = {1, 2, 3},
                        .chosen = 4,
                        .text = "t"};

Sample spoiltBy(Hostility hostility) {
  remote::Writer writer;
  remote::Wire<Sample>::put(writer, kHonest);
  Rng rng(3);
  const std::vector<std::byte> bytes =
      corrupted(writer.bytes(), remote::Layout<Sample>::text(), hostility, rng);
  remote::Reader reader(bytes);
  Sample sample = remote::Wire<Sample>::get(reader);
  reader.expectEnd();
  return sample;
}

TEST(Spoilt, IsOfTheSameType) {
  for (int k = 0; k < static_cast<int>(Hostility::kCount); ++k)
    EXPECT_NO_THROW(spoiltBy(static_cast<Hostility>(k))) << toString(static_cast<Hostility>(k));
  EXPECT_TRUE(spoiltBy(Hostility::kEmpty).list.empty());
  EXPECT_EQ(spoiltBy(Hostility::kEmpty).matrix.size(), 0);
  EXPECT_FALSE(spoiltBy(Hostility::kEmpty).chosen);
  EXPECT_EQ(spoiltBy(Hostility::kHuge).list.size(), 20000u);
  EXPECT_EQ(spoiltBy(Hostility::kHuge).matrix.rows(), 300);
  EXPECT_TRUE(std::isnan(spoiltBy(Hostility::kNotANumber).place[2]));
  EXPECT_TRUE(std::isinf(spoiltBy(Hostility::kInfinite).matrix(1, 2)));
  EXPECT_GE(std::abs(spoiltBy(Hostility::kOverflowing).list[0]), 1e199);
  EXPECT_EQ(spoiltBy(Hostility::kDenormal).list[3], std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(spoiltBy(Hostility::kZero).place, Eigen::Vector3d::Zero());
  EXPECT_FALSE(spoiltBy(Hostility::kZero).yes);
  EXPECT_EQ(spoiltBy(Hostility::kConstant).list, std::vector<double>(4, 1.5));
  EXPECT_EQ(spoiltBy(Hostility::kShifted).chosen, 5);
  EXPECT_THAT(spoiltBy(Hostility::kPermuted).list, ::testing::UnorderedElementsAre(1, 2, 3, 4));
  EXPECT_NE(spoiltBy(Hostility::kPermuted).list, kHonest.list);
  EXPECT_NE(spoiltBy(Hostility::kRagged).list.size(), 0u);
}

TEST(Spoilt, RefusesBytesOfAnotherLayout) {
  Rng rng;
  const std::vector<std::byte> bytes(9);
  for (const char* layout : {"d", "[d]", "(dd)", "M-1,1,d", "i4", "x", "s", "r", "?d", "i"})
    EXPECT_REX_ERROR(corrupted(bytes, layout, Hostility::kZero, rng), "an answer does not match its layout");
}

TEST(SizeOfValue, EndsWhereTheNextBegins) {
  remote::Writer writer;
  remote::Wire<Sample>::put(writer, kHonest);
  const std::size_t size = writer.bytes().size();
  remote::Wire<double>::put(writer, 1);
  EXPECT_EQ(sizeOfValue(writer.bytes(), remote::Layout<Sample>::text()), size);
  EXPECT_REX_ERROR(sizeOfValue(writer.bytes().first(3), "d"), "an answer does not match its layout");
}

}  // namespace rex::grading::spoilt_answer_test
