#include <filesystem>
#include <fstream>

#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  std::filesystem::create_directories("a/b");
  std::ofstream("a/b/c") << "left behind";
  std::filesystem::permissions("a/b", std::filesystem::perms::none);
  return target;
}
