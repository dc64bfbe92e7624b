#include "grading/rewound_generators.h"

#include <gtest/gtest.h>

#include "base/rng.h"
#include "grading/check.h"
#include "remote/wire.h"
#include "support/expect_error.h"

namespace rex::grading::rewound_generators_test {

TEST(SeedBehind, IsFoundAfterAnyNumberOfDraws) {
  Rng rng(16910726684744908173u);
  for (int draws = 0; draws < 50; ++draws) {
    EXPECT_EQ(seedBehind(rng.state(), draws), 16910726684744908173u) << draws;
    if (draws > 0) {
      EXPECT_EQ(seedBehind(rng.state(), draws - 1), std::nullopt) << draws;
    }
    rng.next();
  }
}

TEST(SeedBehind, IsFoundForEachGeneratorOfACheck) {
  Check check({.id = "tour"}, 1);
  EXPECT_EQ(seedBehind(check.rng().state(), 0), 16910726684744908173u);
  check.rng().normalVector(1000);
  EXPECT_EQ(seedBehind(check.rng().state(), 4000), 16910726684744908173u);
  EXPECT_TRUE(seedBehind(check.rng().split(7).state(), 0));
}

TEST(SeedBehind, IsNotFoundForSplitGenerators) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Check check({.id = "tour"}, seed);
    remote::SplitRng split = check.split(seed % 3);
    split.normalVector(100);
    EXPECT_EQ(seedBehind(split.state(), 5000), std::nullopt) << seed;
  }
}

template <class Generator>
remote::Writer argumentsWith(const Generator& rng) {
  remote::Writer writer;
  remote::Wire<double>::put(writer, 1.5);
  remote::Wire<std::array<std::uint64_t, 4>>::put(writer, rng.state());
  return writer;
}

TEST(NoSeedBehind, IsRequiredOfEveryGenerator) {
  Check check({.id = "tour"}, 1);
  const std::vector<std::string> layouts = {"d", "d", "r"};
  const remote::Writer split = argumentsWith(check.split(7));
  EXPECT_NO_THROW(requireNoSeedBehind("tour", "mapped", split.bytes(), layouts));
  check.rng().next();
  const remote::Writer own = argumentsWith(check.rng());
  EXPECT_REX_ERROR(requireNoSeedBehind("tour", "mapped", own.bytes(), layouts),
                   "tour: the generator handed to mapped gives the seed of the case when run backwards");
}

TEST(SplitGenerator, DependsOnStateAndLabel) {
  Check one({.id = "tour"}, 1), again({.id = "tour"}, 1), other({.id = "tour"}, 2);
  const auto state = one.split(7).state();
  EXPECT_EQ(state, again.split(7).state());
  EXPECT_NE(state, one.split(8).state());
  EXPECT_NE(state, other.split(7).state());
  EXPECT_EQ(one.rng().state(), again.rng().state()) << "a split draws nothing";
  one.rng().next();
  EXPECT_NE(state, one.split(7).state());
}

}  // namespace rex::grading::rewound_generators_test
