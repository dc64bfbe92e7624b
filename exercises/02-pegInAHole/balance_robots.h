#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "interface.h"
#include "scene/model.h"

// Part 5: robots in postures for the three maps.

/// A robot in a posture, and what the three maps are asked about.
struct Standing {
  rex::Simulator S;
  std::vector<BodyMass> masses;
  double margin = 0.2;
  std::string body, frame;
  Eigen::Vector3d inBody, inFrame;
};

inline std::string numbers(const Eigen::VectorXd& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + std::to_string(value);
  return text;
}

inline std::string randomPose(rex::Rng& rng) {
  return "<T t(" + numbers(rng.uniformVector(3, -0.4, 0.4)) + ") d(" +
         numbers(rng.uniformVector(1, -180, 180)) + " " + numbers(rng.normalVector(3)) + ")>";
}

inline std::string randomMass(rex::Rng& rng) {
  return "mass=" + numbers(rng.uniformVector(1, 0.2, 3)) + " com=[" +
         numbers(rng.uniformVector(3, -0.3, 0.3)) + "]";
}

/// Every fourth joint has no limits.
inline std::string randomLimits(rex::Rng& rng) {
  const double low = rng.uniform(-1, -0.4), high = rng.uniform(0.4, 1);
  return rng.index(4) == 0 ? "" : "limits=[" + numbers(Eigen::Vector2d(low, high)) + "]";
}

/// A tree of joints that turn or slide, with random frames, limits and masses.
inline rex::Simulator randomTree(rex::Rng& rng, int joints) {
  const char* const types[] = {"hingeX", "hingeY", "hingeZ", "transX", "transY", "transZ"};
  std::string text = "body b0 { X=" + randomPose(rng) + " " + randomMass(rng) + " }\n";
  for (int i = 1; i <= joints; ++i) {
    const std::string name = "b" + std::to_string(i), parent = "b" + std::to_string(rng.index(i));
    text += "body " + name + " { type=ST_box size=[0.15 0.1 0.05] " + randomMass(rng) + " }\n";
    text += "joint (" + parent + " " + name + ") { type=" + types[rng.index(6)] + " A=" + randomPose(rng) +
            " B=" + randomPose(rng) + " " + randomLimits(rng) + " }\n";
  }
  return rex::Simulator(rex::SimulatorDescription{.sceneName = "tree.ors", .sceneText = text, .q = {}});
}

/// man.ors with random limits, and masses whose centres are not the origins of their bodies.
inline rex::Simulator limitedMan(rex::Rng& rng) {
  rex::SimulatorDescription man = rex::Simulator("man.ors").description();
  man.sceneText.resize(man.sceneText.find("# where the hands shall reach"));  // without the red balls
  const auto replaceEach = [&](const std::string& what, const std::function<std::string()>& by) {
    for (std::size_t place = man.sceneText.find(what); place != std::string::npos;) {
      const std::string one = by();
      man.sceneText.replace(place, what.size(), one);
      place = man.sceneText.find(what, place + one.size());
    }
  };
  replaceEach("mass=", [&] { return "com=[" + numbers(rng.uniformVector(3, -0.1, 0.1)) + "] mass="; });
  replaceEach("{ A=", [&] { return "{ " + randomLimits(rng) + " A="; });
  return rex::Simulator(man);
}

/// The masses of the scene.
inline std::vector<BodyMass> massesOf(const rex::Simulator& S) {
  std::vector<BodyMass> masses;
  for (const rex::Body& one : std::span(S.model().bodies()).subspan(1))
    masses.push_back({one.name, one.mass, one.p_BBcm});
  return masses;
}

/// A posture with some joints near or beyond their limits, but none where the cost has a kink, and random
/// questions about it.
inline Standing inRandomPosture(rex::Rng& rng, rex::Simulator S) {
  const Eigen::VectorXd low = S.getLowerLimits(), high = S.getUpperLimits();
  const double margin = std::round(rng.uniform(10, 30)) / 100;
  Eigen::VectorXd q(low.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) do {
      q[i] = std::round(100 * rng.uniform(-1.1, 1.1)) / 100;
    } while (std::min({std::abs(margin - q[i] + low[i]), std::abs(margin + q[i] - high[i]),
                       std::abs(q[i] - low[i]), std::abs(q[i] - high[i])}) < 0.01);
  S.setJointAngles(q);
  const std::vector<BodyMass> masses = massesOf(S);
  const int body = rng.index(static_cast<int>(masses.size())),
            other =
                (body + 1 + rng.index(static_cast<int>(masses.size()) - 1)) % static_cast<int>(masses.size());
  return {.S = S,
          .masses = masses,
          .margin = margin,
          .body = masses[static_cast<std::size_t>(body)].body,
          .frame = masses[static_cast<std::size_t>(other)].body,
          .inBody = rng.uniformVector(3, -0.3, 0.3),
          .inFrame = rng.uniformVector(3, -0.3, 0.3)};
}
