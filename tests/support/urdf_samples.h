#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "support/paths.h"

namespace rex {

/// A robot with what is easy to get wrong: axes of any length, turned frames and inertias, a mimic.
inline constexpr const char* kTrickyRobot = R"(<robot name="tricky">
  <link name="base"/>
  <link name="turret">
    <inertial>
      <origin xyz="0.1 -0.2 0.3" rpy="0.4 0.5 -0.6"/>
      <mass value="2.5"/>
      <inertia ixx="0.04" iyy="0.05" izz="0.06" ixy="0.001" ixz="-0.002" iyz="0.003"/>
    </inertial>
  </link>
  <link name="boom"/>
  <link name="hook"/>
  <link name="tip"/>
  <joint name="turn" type="continuous">
    <origin xyz="0.1 0.2 0.3" rpy="0.1 1.5707963 -2"/>
    <parent link="base"/>
    <child link="turret"/>
    <axis xyz="1 2 -2"/>
  </joint>
  <joint name="reach" type="prismatic">
    <origin rpy="-3 0.2 1.1" xyz="1 0 0"/>
    <parent link="turret"/>
    <child link="boom"/>
    <axis xyz="0 -0.5 0.5"/>
    <limit lower="-1" upper="1" velocity="1" effort="10"/>
  </joint>
  <joint name="swing" type="revolute">
    <parent link="boom"/>
    <child link="hook"/>
    <limit lower="-1" upper="1" velocity="1" effort="10"/>
    <mimic joint="turn" multiplier="-1.5" offset="0.25"/>
  </joint>
  <joint name="end" type="fixed">
    <origin xyz="0 0 -0.4" rpy="3.14159 -1.5707963267948966 0.3"/>
    <parent link="hook"/>
    <child link="tip"/>
  </joint>
</robot>
)";

/// All .urdf files of the project and of the sample data beside it, sorted.
inline std::vector<std::filesystem::path> urdfFiles() {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& folder : {sourcePath("data"), sharedPath("data/urdf")}) {
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".urdf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace rex
