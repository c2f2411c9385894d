// A run's frames as a picture that moves: WebGL by three.js, in one HTML fragment that needs no network.
//
// Bodies have one mesh each and its places at every frame; water has its triangles at every frame, in space those of the free surface.
// Places are whole numbers, 16 bits on each axis of the box of all frames: a part in 65 535 of it. Pressures are 8 bits. All is one
// zlib stream in base64, which the browser unpacks (Compression Streams).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

struct Replay {
  std::string html;                   ///< empty: there are no frames, or no three.js
  std::vector<std::string> warnings;  ///< why, where somebody may wonder
};

/// Of the frames that the run's folder holds, sixty at most, evenly spread. Cost: reading them, 5 ms for 1000 nodes.
Replay replay_of(const std::filesystem::path& run);

}  // namespace splashdown::apps
