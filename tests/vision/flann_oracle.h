#pragma once

// FLANN's k-d trees, as an oracle of recall. Its headers cannot be read together
// with OpenCV's, so only plain types pass.

#include <cstdint>
#include <vector>

namespace lararium::test {

// For each of the queries (rows of dimension bytes) the index of the nearest row
// that FLANN finds with these numbers of trees and checks.
std::vector<int> FlannNearest(const std::vector<uint8_t>& rows,
                              const std::vector<uint8_t>& queries,
                              int dimension,
                              int trees,
                              int checks);

}  // namespace lararium::test
