// The statement `pin` of .ors, and what becomes of pins elsewhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "formats/ors_writer.h"
#include "formats/urdf_writer.h"
#include "scene/model.h"
#include "support/expect_error.h"

namespace rex::ors_pins_test {

using Eigen::Vector3d;

const std::string kBodies = "body a {} body b {} joint (world a) {} joint (world b) {}\n";

SceneSpec read(const std::string& text) { return parseOrs(kBodies + text, "s.ors").spec; }

TEST(OrsPins, AreReadWrittenAndReadAgain) {
  const SceneSpec spec = read("pin (a b) { A=[1 2 3] B=[0 0 .5] }\npin (b world) { B=[4 5 6] }");
  const std::string text = writeOrs(spec);
  EXPECT_THAT(text, testing::HasSubstr("\npin (a b)     { A=[1 2 3] B=[0 0 0.5] }\n"
                                       "pin (b world) { A=[0 0 0] B=[4 5 6] }\n"));
  for (const SceneSpec& one : {spec, parseOrs(text, "again.ors").spec}) {
    const Model model = compile(one);
    ASSERT_EQ(model.pins().size(), 2u);
    EXPECT_EQ(model.pins()[0].a, model.body("a"));
    EXPECT_EQ(model.pins()[0].b, model.body("b"));
    EXPECT_EQ(model.pins()[0].p_AP, Vector3d(1, 2, 3));
    EXPECT_EQ(model.pins()[0].p_BQ, Vector3d(0, 0, .5));
    EXPECT_EQ(model.pins()[1].b, kWorld);
    EXPECT_EQ(model.pins()[1].p_BQ, Vector3d(4, 5, 6));
  }
}

TEST(OrsPins, AreALossInUrdf) {
  const Diagnostics notes = writeUrdf(read("pin (a b) {}")).notes;
  ASSERT_FALSE(notes.empty());
  EXPECT_THAT(toString(notes.back()),
              testing::HasSubstr("pins are left out: the loops that they close are open"));
}

TEST(OrsPins, RefuseWithThePlace) {
  EXPECT_REX_ERROR(read("pin (a) {}"), "s.ors:2:1: pin: found 1 body, wanted two: pin (A B) {...}");
  EXPECT_REX_ERROR(read("pin top (a b) {}"),
                   "s.ors:2:5: pin: found 'top', wanted 'pin (A B) { ... }': it has no name");
  EXPECT_REX_ERROR(read("pin (a a) {}"), "s.ors:2:8: pin (a a): found one body, wanted two different bodies");
  EXPECT_REX_ERROR(read("pin (a bb) {}"), "s.ors:2:8: pin (a bb): unknown body: found 'bb'");
  EXPECT_REX_ERROR(read("pin (a b) { A=[1 2] }"), "pin (a b): attribute 'A': found an array of 2");
  std::string many;
  for (int i = 0; i <= 1000; ++i) many += "pin (a b) {}\n";
  EXPECT_REX_ERROR(read(many), "s.ors:1002:1: too many pins: wanted at most 1000");
}

TEST(Pins, MustNameTwoBodies) {
  const auto compiled = [](const PinSpec& pin) {
    SceneSpec spec = read("");
    spec.pins.push_back(pin);
    static_cast<void>(compile(spec));
  };
  EXPECT_REX_ERROR(compiled({.a = "a", .b = "c"}), "pin: unknown body: found 'c', wanted the name of a body");
  EXPECT_REX_ERROR(compiled({.a = "a", .b = "a"}), "pin: found 'a' twice, wanted two bodies");
  EXPECT_REX_ERROR(compiled({.a = "a", .b = "b", .p_BQ = Vector3d(0, NAN, 0)}),
                   "pin: point: found a number that is not finite, wanted finite numbers");
}

}  // namespace rex::ors_pins_test
