#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace rex::cli {

/// The options of `rex filter`.
struct FilterOptions {
  std::string filter = "ekf";
  int landmarks = 5;
  int steps = 300;
  double dynamicsNoise = 0.03, observationNoise = 0.5;
  bool rangeBearing = false;
  std::optional<double> bearingNoise{}, maxRange{}, fieldOfView{};
  double assumeDynamics = 1,
         assumeObservation = 1;  ///< factors on the standard deviations that the filter assumes
  std::optional<int> particles{};
  std::uint64_t seed = 0;
  int seeds = 1;  ///< runs, each with the next seed
  bool noFilm = false;
  bool json = false;
  std::filesystem::path out{};  ///< a folder; empty: nothing is written
};

}  // namespace rex::cli
