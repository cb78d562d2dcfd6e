#include "tests/vision/flann_oracle.h"

#include <flann/flann.hpp>

namespace lararium::test {

std::vector<int> FlannNearest(const std::vector<uint8_t>& rows,
                              const std::vector<uint8_t>& queries,
                              int dimension,
                              int trees,
                              int checks) {
  const auto matrix = [dimension](const std::vector<uint8_t>& bytes) {
    return flann::Matrix<uint8_t>(const_cast<uint8_t*>(bytes.data()), bytes.size() / dimension,
                                  dimension);
  };
  flann::seed_random(1);
  flann::Index<flann::L2<uint8_t>> index(matrix(rows), flann::KDTreeIndexParams(trees));
  index.buildIndex();
  std::vector<int> found(queries.size() / dimension);
  std::vector<float> distances(found.size());
  flann::Matrix<int> indices(found.data(), found.size(), 1);
  flann::Matrix<float> distance_matrix(distances.data(), found.size(), 1);
  index.knnSearch(matrix(queries), indices, distance_matrix, 1, flann::SearchParams(checks));
  return found;
}

}  // namespace lararium::test
