#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/ors_graph_internal.h"

namespace rex::ors {

/// The files of a scene: finds the ones it includes, within the limits, and keeps those that are open.
class Files {
 public:
  /// For the scene in `file`, whose own text has `bytes`; `assets` as in parseGraph(). Throws Error if it is
  /// too large.
  Files(const Assets* assets, const std::string& file, std::size_t bytes);

  /// The name and the text of a file to include, and its folder as seen from that of the scene. It counts as
  /// open until close(). Throws Error at `where`: no files may be read, none found, a file within itself,
  /// files nested too deep or too large in all.
  struct Opened {
    std::string name;
    std::string text;
    std::filesystem::path folder;
  };
  [[nodiscard]] Opened open(const FileName& file, const Place& where);
  void close() { open_.pop_back(); }
  /// Whether a folder that ChDir names is there; always so of a scene that was given as text.
  [[nodiscard]] bool hasFolder(const std::string& folder) const;

 private:
  const Assets* assets_;
  std::size_t bytes_;
  std::vector<std::filesystem::path> open_;
};

/// Whether it is package://PACKAGE/PATH or alike, no path.
[[nodiscard]] bool isAddress(const std::string& name);

/// `name` as seen from the folder of the scene when it is meant from `folder`; an address or an absolute path
/// stays as it is.
[[nodiscard]] std::string inFolder(const std::string& folder, const std::string& name);

}  // namespace rex::ors
