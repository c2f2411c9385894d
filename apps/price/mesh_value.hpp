// What was measured on a mesh.
#pragma once

namespace splashdown::apps {

struct MeshValue {
  double h;  ///< element size, relative
  double value;
};

}  // namespace splashdown::apps
