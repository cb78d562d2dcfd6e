#pragma once

// FLANN's k-d trees, as a reference for recall. FLANN's headers cannot be included together with
// OpenCV's, so the interface uses plain types only.

#include <cstdint>
#include <vector>

namespace lararium::test {

// For each of the queries (rows of `dimension` bytes), the index of the nearest row that FLANN
// finds with these numbers of trees and checks.
std::vector<int> FlannNearest(const std::vector<uint8_t>& rows,
                              const std::vector<uint8_t>& queries,
                              int dimension,
                              int trees,
                              int checks);

}  // namespace lararium::test
