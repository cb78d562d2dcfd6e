#pragma once

// Lists the connected cameras.

#include <string>
#include <vector>

namespace lararium::capture {

struct ConnectedCamera {
  int number = 0;  // number for OpenCamera()
  // Name from the driver in printable ASCII; empty if the camera cannot be queried.
  std::string name;
  // Why the camera cannot be queried, for example without permission; otherwise empty.
  std::string problem;
};

// Returns the Video4Linux devices that stream video, in the order of their numbers. Device nodes
// that give no images are left out. Cameras in use by another program are listed too.
std::vector<ConnectedCamera> ConnectedCameras();

}  // namespace lararium::capture
