// Numbers recorded from an independent implementation: mass matrix, bias forces, energies, a step of Runge
// and Kutta.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/stepper.h"
#include "formats/ors_reader.h"
#include "support/paths.h"

namespace rex::golden_test {

constexpr double kTolerance = 1e-9;

Eigen::VectorXd vectorFrom(const nlohmann::json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void expectNear(const Eigen::VectorXd& got, const Eigen::VectorXd& wanted, const std::string& what) {
  ASSERT_EQ(got.size(), wanted.size()) << what;
  for (Eigen::Index i = 0; i < got.size(); ++i)
    EXPECT_NEAR(got[i], wanted[i], kTolerance * std::max(1., std::abs(wanted[i]))) << what << " " << i;
}

void compareConfiguration(const Model& model, const nlohmann::json& configuration) {
  const Eigen::VectorXd q = vectorFrom(configuration.at("q")), v = vectorFrom(configuration.at("qdot"));
  const nlohmann::json& golden = configuration.at("dynamics");
  const EquationOfMotion motion = equationOfMotion(model, q, v);
  for (int i = 0; i < model.nv(); ++i)
    expectNear(motion.M.col(i), vectorFrom(golden.at("M").at(static_cast<std::size_t>(i))), "M");
  expectNear(motion.F, vectorFrom(golden.at("F")), "F");
  expectNear(biasForces(model, q, v, Eigen::Vector3d::Zero()), vectorFrom(golden.at("F_nogravity")),
             "F without gravity");
  EXPECT_NEAR(energy(model, q, v).kinetic, golden.at("Ekin").get<double>(), kTolerance);
  EXPECT_NEAR(energy(model, q, v).potential, golden.at("Epot").get<double>(), kTolerance);

  State state{q, v};
  Stepper stepper(model);
  stepper.step(state, 0.1 * Eigen::VectorXd::LinSpaced(model.nv(), 1, model.nv()), 0.01);
  const nlohmann::json& step = golden.at("rk4step");
  expectNear(state.q, vectorFrom(step.at("q1")), "q after a step");
  expectNear(state.v, vectorFrom(step.at("qdot1")), "v after a step");
}

class GoldenDynamics : public testing::TestWithParam<const char*> {};

TEST_P(GoldenDynamics, Agree) {
  const std::string name = GetParam();
  std::ifstream file(sourcePath("tests/golden") / (name + ".json"));
  ASSERT_TRUE(file) << name;
  const nlohmann::json golden = nlohmann::json::parse(file);
  const Model model = compile(readOrs(sourcePath("data/robots") / (name + ".ors")).spec);
  ASSERT_EQ(golden.at("configs").size(), 6u);
  for (const nlohmann::json& configuration : golden["configs"]) compareConfiguration(model, configuration);
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenDynamics, testing::Values("man", "pegArm", "arm3", "pegInAHole"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace rex::golden_test
