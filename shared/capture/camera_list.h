#pragma once

// Which cameras are connected.

#include <string>
#include <vector>

namespace lararium::capture {

struct ConnectedCamera {
  int number = 0;       // of OpenCamera()
  std::string name;     // as its driver calls it, printable ASCII; empty where it cannot be asked
  std::string problem;  // why it cannot be asked, as where somebody may not open it; else empty
};

// Those of Video4Linux that stream video, by their numbers. Nodes of a camera that give no images
// are left out. One that another program has is listed all the same.
std::vector<ConnectedCamera> ConnectedCameras();

}  // namespace lararium::capture
